//! A robot that restarts counts from one again; its messages are not mistaken for duplicates of those before the crash,
//! nor late copies of those for new ones.

use crate::harness::talker::{Talker, broadcast};
use crate::harness::{Wire, World};
use starl_core::Duration;
use starl_primitives::reliable::Options;
use std::collections::BTreeSet;

#[test]
fn a_restarted_sender_is_heard() {
    for in_order in [false, true] {
        for seed in 0..40 {
            let options = Options {
                first_in_first_out: in_order,
                ..Options::default()
            };
            let mut world = World::new(3, seed, Wire::bad(), None, Talker::boxed(options));
            let mut value = 0;
            for _life in 0..3 {
                for _ in 0..5 {
                    value += 1;
                    world.command(0, broadcast(value));
                    world.run_for(Duration::from_millis(30));
                }
                if value < 15 {
                    // With the same random stream as before: only the clock tells the lives apart.
                    world.crash(0);
                    world.start(0);
                }
            }
            world.run_for(Duration::from_seconds(60));
            let received = world.received();
            let distinct: BTreeSet<_> = received.iter().collect();
            assert_eq!(
                distinct.len(),
                received.len(),
                "seed {seed}: nothing comes twice"
            );
            for to in [1, 2] {
                for value in 11..=15 {
                    assert!(
                        received.contains(&(0, to, value)),
                        "seed {seed}: {value} to {to}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_restarted_receiver_accepts_messages_in_transit_and_later_ones() {
    for in_order in [false, true] {
        let options = Options {
            first_in_first_out: in_order,
            ..Options::default()
        };
        let mut world = World::new(2, 3, Wire::perfect(), None, Talker::boxed(options));
        world.command(0, broadcast(1));
        world.run_for(Duration::from_seconds(1));
        world.crash(1);
        world.command(0, broadcast(2));
        world.command(0, broadcast(3));
        world.run_for(Duration::from_seconds(2));
        world.start(1);
        world.run_for(Duration::from_seconds(5));
        world.command(0, broadcast(4));
        world.run_for(Duration::from_seconds(5));
        let mut received = world.received();
        if !in_order {
            received.sort_unstable();
        }
        assert_eq!(received, [(0, 1, 1), (0, 1, 2), (0, 1, 3), (0, 1, 4)]);
        assert_eq!(world.events("fail"), []);
    }
}

#[test]
fn a_restarted_receiver_does_not_wait_for_messages_of_its_earlier_life() {
    for in_order in [false, true] {
        let options = Options {
            first_in_first_out: in_order,
            ..Options::default()
        };
        let mut world = World::new(3, 3, Wire::perfect(), None, Talker::boxed(options));
        world.command(0, broadcast(1));
        world.run_for(Duration::from_seconds(1));
        // Messages stay on their way, since the second robot hears none.
        world.wire.part(0, 1);
        for value in 2..6 {
            world.command(0, broadcast(value));
            world.run_for(Duration::from_millis(100));
        }
        world.run_for(Duration::from_seconds(1));
        world.crash(2);
        world.run_for(Duration::from_millis(100));
        world.start(2);
        world.command(0, broadcast(6));
        world.run_for(Duration::from_seconds(2));
        let received = world.received().into_iter().filter(|got| got.1 == 2);
        let values: Vec<i64> = received.map(|got| got.2).collect();
        assert_eq!(values, [1, 2, 3, 4, 5, 6], "in order: {in_order}");
    }
}
