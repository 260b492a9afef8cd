//! Broadcasts of three robots with one crash and restart or one duplicate, or both: each message is delivered once, and in
//! the promised order. A lost datagram is one that never arrives.

use crate::support::speaker::Speaker;
use crate::support::{all_is_well, happens, seconds, setup, watched};
use starl_core::Duration;
use starl_explore::{Bounds, Setup};
use starl_primitives::broadcast::Order;
use starl_primitives::reliable::Options;

pub fn broadcasts(order: Order, messages: &[u8]) -> Setup {
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

pub const ONE: &[u8] = &[1, 0, 0];

#[test]
fn messages_are_delivered_in_the_explorations() {
    for order in [Order::Unordered, Order::Fifo, Order::Causal] {
        assert!(happens(broadcasts(order, ONE), 0, "deliver"), "{order:?}");
    }
}

#[test]
fn one_message_with_a_crash_and_a_duplicate() {
    let sizes = [
        (Order::Unordered, (7_123, 17_244, 13)),
        (Order::Fifo, (7_123, 17_244, 13)),
        (Order::Causal, (7_431, 17_800, 13)),
    ];
    for (order, expected) in sizes {
        let size = all_is_well(broadcasts(order, ONE), 0);
        assert_eq!(size, expected, "{order:?}");
    }
}

/// Ticks after which the robots have founded a group and have a leader.
pub const FOUNDED: u16 = 2;

pub fn total(messages: &[u8], bounds: Bounds) -> Setup {
    let options = Options {
        first_timeout: Duration::from_seconds(1),
        ..Options::default()
    };
    let bounds = Bounds {
        clocks: seconds(FOUNDED, 0, Some(0)),
        ..bounds
    };
    watched(setup(
        3,
        Speaker::new(messages, Order::Total, options),
        bounds,
    ))
}

#[test]
fn one_message_in_total_order_with_a_crash() {
    let bounds = Bounds {
        crashes: 1,
        ..Bounds::default()
    };
    assert!(happens(total(ONE, bounds), FOUNDED, "deliver"));
    let size = all_is_well(total(ONE, bounds), FOUNDED);
    assert_eq!(size, (520_859, 1_432_308, 29));
}

#[test]
fn two_messages_in_total_order_with_a_duplicate() {
    let bounds = Bounds {
        duplicates: 1,
        ..Bounds::default()
    };
    let size = all_is_well(total(&[1, 1, 0], bounds), FOUNDED);
    assert_eq!(size, (1_019_282, 2_871_103, 20));
}
