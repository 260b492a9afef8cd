//! No robot waits for ever for a crashed robot: a bounded number of copies, a bounded time, and then a failure that
//! names it. Live robots are served meanwhile.

use crate::harness::talker::{Talker, broadcast, geocast, unicast};
use crate::harness::{Wire, World, int};
use starl_core::event::Value;
use starl_core::{Duration, RobotId, Time};
use starl_primitives::reliable::Options;

#[test]
fn the_failure_is_reported_within_its_bound_and_names_the_crashed_robots() {
    for in_order in [false, true] {
        for seed in 0..20 {
            let options = Options {
                first_in_first_out: in_order,
                ..Options::default()
            };
            let mut world = World::new(4, seed, Wire::bad(), None, Talker::boxed(options));
            // Of the robots in an area, only those that have answered before are missed.
            world.command(0, geocast(100));
            world.run_for(options.failure_bound());
            assert_eq!(world.events("fail"), [], "seed {seed}");
            world.crash(3);
            for value in 0..10 {
                world.command(0, broadcast(value));
                world.command(0, geocast(value + 10));
                world.command(0, unicast(3, value + 20));
            }
            world.run_for(options.failure_bound());
            let failures = world.events("fail");
            assert_eq!(failures.len(), 30, "seed {seed}");
            for (_, robot, fields) in failures {
                assert_eq!(robot, RobotId(0));
                assert_eq!(fields["to"], Value::Robots(vec![RobotId(3)]), "seed {seed}");
            }
            assert_eq!(
                world.received().len(),
                43,
                "seed {seed}: two robots, twenty messages, and the first to all three"
            );
            assert_eq!(world.timers(0), 0);
        }
    }
}

#[test]
fn copies_are_bounded_and_spread_out() {
    for retries in [0, 1, 7, 15] {
        let options = Options {
            retries,
            jitter: 0.0,
            ..Options::default()
        };
        let mut world = World::new(2, 5, Wire::perfect(), None, Talker::boxed(options));
        world.crash(1);
        world.command(0, broadcast(1));
        world.run_for(options.failure_bound());
        assert_eq!(world.sent_count(), 1 + retries as usize);
        let failed_at = world.events("fail")[0].0;
        assert!(
            failed_at >= Time::ZERO + options.retry_span() / 2,
            "{failed_at}"
        );
        world.run_for(Duration::from_seconds(100));
        assert_eq!(world.sent_count(), 1 + retries as usize, "it stays quiet");
    }
}

#[test]
fn the_original_retries_take_half_a_minute() {
    let options = Options {
        jitter: 0.0,
        ..Options::default()
    };
    // 0.25 + 0.5 + 1 and twelve times 2 seconds lie between the sixteen copies, and 2 more after the last.
    assert_eq!(options.retry_span(), Duration::from_millis(27_750));
    assert_eq!(options.failure_bound(), Duration::from_millis(27_750));
    let delay = Duration::from_millis(100);
    assert_eq!(options.delivery_bound(delay), Duration::from_millis(27_850));
    assert_eq!(options.likely_delivery_bound(delay, 0.0, 1e-9), Some(delay));
    // Five copies are all lost once in 0.3^5 = 0.00243.
    let likely = Duration::from_millis(3_850);
    assert_eq!(
        options.likely_delivery_bound(delay, 0.3, 0.0025),
        Some(likely)
    );
    assert_eq!(options.likely_delivery_bound(delay, 0.9, 1e-9), None);
    assert_eq!(options.likely_delivery_bound(delay, 1.0, 0.5), None);
}

#[test]
fn too_many_messages_on_their_way_fail_the_oldest() {
    let options = Options {
        most_outstanding: 5,
        ..Options::default()
    };
    let mut world = World::new(2, 5, Wire::perfect(), None, Talker::boxed(options));
    world.crash(1);
    (1..=12).for_each(|value| world.command(0, broadcast(value)));
    let failed: Vec<i64> = world
        .events("fail")
        .iter()
        .map(|f| int(&f.2["number"]))
        .collect();
    assert_eq!(failed, [1, 2, 3, 4, 5, 6, 7]);
    assert_eq!(world.timers(0), 1);
}

#[test]
fn a_fleet_of_one_does_not_wait() {
    let options = Options::default();
    let mut world = World::new(1, 5, Wire::perfect(), None, Talker::boxed(options));
    world.command(0, broadcast(1));
    assert_eq!((world.sent_count(), world.timers(0)), (0, 0));
    assert_eq!(world.events("acknowledged").len(), 1);
}
