//! Broadcasts of three robots with one crash and restart and one duplicate: each message is delivered once, and in the
//! promised order. A lost datagram is one that never arrives.

use crate::support::speaker::Speaker;
use crate::support::{all_is_well, happens, setup, watched};
use starl_explore::{Bounds, Setup};
use starl_primitives::broadcast::Order;
use starl_primitives::reliable::Options;

fn broadcasts(order: Order, messages: &[u8]) -> Setup {
    let bounds = Bounds {
        duplicates: 1,
        crashes: 1,
        timers: 0,
        ..Bounds::default()
    };
    watched(setup(
        3,
        Speaker::new(messages, order, Options::default()),
        bounds,
    ))
}

const ONE: &[u8] = &[1, 0, 0];

#[test]
fn messages_are_delivered_in_the_explorations() {
    for order in [Order::Unordered, Order::Fifo, Order::Causal] {
        assert!(happens(broadcasts(order, ONE), 0, "deliver"), "{order:?}");
    }
}

#[test]
fn one_message_with_a_crash_and_a_duplicate() {
    let sizes = [
        (Order::Unordered, (10_021, 21_200, 14)),
        (Order::Fifo, (10_021, 21_200, 14)),
        (Order::Causal, (10_351, 21_774, 14)),
    ];
    for (order, expected) in sizes {
        let size = all_is_well(broadcasts(order, ONE), 0);
        assert_eq!(size, expected, "{order:?}");
    }
}
