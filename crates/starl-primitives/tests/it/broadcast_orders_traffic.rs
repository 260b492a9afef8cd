//! The number of datagrams of a broadcast in each order, compared with the need of its algorithm.

use crate::harness::teller::{Teller, tell};
use crate::harness::{Wire, World};
use starl_core::Duration;
use starl_primitives::broadcast::Order;

/// Datagrams for each of 20 messages, one after the other, those that are sent in quiet left out; a
/// datagram to all counts once.
fn datagrams(order: Order, robots: usize) -> f64 {
    let quiet = |messages: u32| {
        let make = Teller::boxed(order, 0, 0.0);
        let mut world = World::new(robots, 1, Wire::perfect(), None, make);
        // They hear of each other.
        world.command(robots - 1, tell(0));
        world.run_for(Duration::from_seconds(10));
        let before = world.sent_count();
        for value in 0..20 {
            if value < messages {
                world.command(robots - 1, tell(value));
            }
            world.run_for(Duration::from_millis(530));
        }
        world.sent_count() - before
    };
    (quiet(20) as f64 - quiet(0) as f64) / 20.0
}

#[test]
fn a_broadcast_needs_the_datagrams_of_its_algorithm() {
    for robots in [3, 5, 10, 30, 100] {
        let n = robots as f64;
        let count = |order| datagrams(order, robots);
        let all = [Order::Unordered, Order::Fifo, Order::Causal, Order::Total].map(count);
        println!("{robots}: {all:?}");
        // One to all, and each of the others acknowledges.
        for few in &all[..3] {
            assert!((few - n).abs() < 0.3, "{robots}: {all:?}");
        }
        // To the leader; from it to all; acknowledgements; and the decision to all. Beats bring
        // some of it along, or are sent besides.
        assert!((all[3] - (n + 2.0)).abs() < 0.2 * n, "{robots}: {all:?}");
    }
}
