//! In FIFO order a receiver delivers each sender's messages in the order of sending, and a message that never arrives
//! does not block those after it.

use crate::harness::talker::{Talker, broadcast, unicast};
use crate::harness::{self, Wire, World};
use starl_core::Duration;
use starl_primitives::reliable::Options;

const FIFO: Options = Options {
    first_timeout: Duration::from_millis(100),
    longest_timeout: Duration::from_millis(400),
    jitter: 0.25,
    retries: 15,
    first_in_first_out: true,
    most_outstanding: 1024,
    window: 64,
};

#[test]
fn each_senders_messages_are_delivered_in_order() {
    let mut unordered_runs = 0;
    for seed in 0..40 {
        for options in [
            FIFO,
            Options {
                first_in_first_out: false,
                ..FIFO
            },
        ] {
            let mut world = World::new(3, seed, Wire::bad(), None, Talker::boxed(options));
            for value in 0..30 {
                world.command(0, broadcast(value));
                world.command(1, unicast(2, value));
                world.run_for(Duration::from_millis(20));
            }
            world.run_for(Duration::from_seconds(30));
            let sequence = |from, to| -> Vec<i64> {
                let received = world.received().into_iter();
                received
                    .filter(|r| (r.0, r.1) == (from, to))
                    .map(|r| r.2)
                    .collect()
            };
            for (from, to) in [(0, 1), (0, 2), (1, 2)] {
                let values = sequence(from, to);
                assert_eq!(values.len(), 30, "seed {seed}");
                if options.first_in_first_out {
                    assert!(values.is_sorted(), "seed {seed}: {values:?}");
                } else {
                    unordered_runs += usize::from(!values.is_sorted());
                }
            }
        }
    }
    assert!(
        unordered_runs > 60,
        "the wire does reorder: {unordered_runs}"
    );
}

#[test]
fn a_message_that_is_given_up_releases_those_behind_it() {
    for seed in 0..60 {
        let options = Options { retries: 4, ..FIFO };
        let wire = Wire {
            longest: 1100,
            ..Wire::perfect()
        };
        let mut world = World::new(2, seed, wire, None, Talker::boxed(options));
        world.command(0, broadcast(1));
        world.command(0, broadcast(1_000_002)); // too long for the wire
        for value in 3..10 {
            world.run_for(Duration::from_millis(u64::from(value) * seed % 97));
            world.command(0, broadcast(value));
        }
        world.run_for(options.failure_bound() * 2);
        let values: Vec<i64> = world.received().iter().map(|r| r.2).collect();
        assert_eq!(values, [1, 3, 4, 5, 6, 7, 8, 9], "seed {seed}");
        let failures = world.events("fail");
        assert_eq!(failures.len(), 1, "seed {seed}: only the long one fails");
        assert_eq!(harness::int(&failures[0].2["number"]), 2);
    }
}

#[test]
fn messages_after_a_cut_are_taken_although_those_during_it_are_lost() {
    let options = Options { retries: 3, ..FIFO };
    let mut world = World::new(2, 1, Wire::perfect(), None, Talker::boxed(options));
    world.command(0, broadcast(1));
    world.run_for(Duration::from_seconds(1));
    world.wire.cut.insert((0, 1));
    world.command(0, broadcast(2));
    world.command(0, broadcast(3));
    world.run_for(options.failure_bound());
    world.wire.cut.clear();
    world.command(0, broadcast(4));
    world.run_for(Duration::from_seconds(1));
    assert_eq!(world.received(), [(0, 1, 1), (0, 1, 4)]);
    assert_eq!(world.events("fail").len(), 2);
}
