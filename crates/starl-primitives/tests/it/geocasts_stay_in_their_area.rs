//! A robot outside the area never delivers a geocast, wherever it is when the message is sent; one that
//! stays inside always does.

use crate::harness::talker::{Talker, geocast};
use crate::harness::{Wire, World};
use starl_core::{Duration, Point, Random};
use starl_primitives::reliable::Options;

const INSIDE: Point = Point::planar(0.9, 0.0);
const OUTSIDE: Point = Point::planar(1.1, 0.0);

#[test]
fn a_robot_always_inside_receives_and_one_always_outside_does_not() {
    for seed in 0..40 {
        let mut world = World::new(
            5,
            seed,
            Wire::bad(),
            None,
            Talker::boxed(Options::default()),
        );
        for (robot, position) in [OUTSIDE, INSIDE, OUTSIDE, INSIDE, OUTSIDE]
            .into_iter()
            .enumerate()
        {
            world.place(robot, position);
        }
        let messages = 10;
        (0..messages).for_each(|value| world.command(0, geocast(value)));
        world.run_for(Options::default().delivery_bound(world.wire.longest_delay()));
        let mut received = world.received();
        received.sort_unstable();
        let expected: Vec<_> = [1, 3]
            .iter()
            .flat_map(|&to| (0..10).map(move |value| (0, to, value)))
            .collect();
        assert_eq!(received, expected, "seed {seed}");
        assert_eq!(
            world.events("outside").len(),
            20,
            "seed {seed}: two robots, ten messages"
        );
        world.run_for(Duration::from_seconds(10));
        assert_eq!(
            world.events("fail"),
            [],
            "seed {seed}: robots outside acknowledge too"
        );
    }
}

#[test]
fn a_robot_that_leaves_before_the_delivery_does_not_receive() {
    let wire = Wire {
        delay_ms: (100, 100),
        ..Wire::perfect()
    };
    let mut world = World::new(3, 1, wire, None, Talker::boxed(Options::default()));
    world.place(1, INSIDE);
    world.place(2, OUTSIDE);
    world.command(0, geocast(1));
    world.run_for(Duration::from_millis(99));
    world.place(1, OUTSIDE);
    world.place(2, INSIDE);
    world.run_for(Duration::from_seconds(30));
    assert_eq!(world.received(), [(0, 2, 1)]);
}

#[test]
fn a_robot_that_was_outside_does_not_deliver_a_later_copy() {
    // Its acknowledgement is lost, so it is sent another copy, which finds it inside.
    let mut world = World::new(
        2,
        1,
        Wire::perfect(),
        None,
        Talker::boxed(Options::default()),
    );
    world.place(1, OUTSIDE);
    // They have heard of each other.
    world.command(0, geocast(0));
    world.run_for(Duration::from_seconds(1));
    let before = world.events("retransmit").len();
    world.wire.cut.insert((1, 0));
    world.command(0, geocast(1));
    world.run_for(Duration::from_millis(100));
    world.place(1, INSIDE);
    world.wire.cut.clear();
    world.run_for(Duration::from_seconds(30));
    assert_eq!(world.events("retransmit").len(), before + 1);
    assert_eq!(world.received(), []);
}

#[test]
fn robots_that_wander_never_deliver_outside() {
    let mut delivered = 0;
    for seed in 0..40 {
        let mut world = World::new(
            4,
            seed,
            Wire::bad(),
            None,
            Talker::boxed(Options::default()),
        );
        let mut random = Random::keyed(seed, &[9]);
        for value in 0..60 {
            for robot in 1..4 {
                world.place(robot, Point::planar(random.between(0.0, 2.0), 0.0));
            }
            let before = world.received().len();
            if value < 20 {
                world.command(0, geocast(value));
            }
            let inside: Vec<u32> = (1..4)
                .filter(|&to| world.position(to as usize).x <= 1.0)
                .collect();
            world.run_for(Duration::from_millis(100));
            for (_, to, _) in &world.received()[before..] {
                assert!(inside.contains(to), "seed {seed}: {to} was outside");
                delivered += 1;
            }
        }
    }
    assert!(delivered > 100, "{delivered}");
}
