//! All behaviours of the registration of three robots: lists of one name are equal, and of two robots that
//! list each other both show the same list or one shows none.

use crate::support::registrar::{Agreement, Registrar};
use crate::support::{all_is_well, happens, seconds, setup};
use starl_core::Duration;
use starl_explore::{Bounds, Setup};
use starl_primitives::registration::Options;

fn explore(ticks: u16, delay: Option<u8>, crashes: u8) -> (u32, u64, u32) {
    all_is_well(registration(ticks, delay, crashes), 0)
}

pub fn registration(ticks: u16, delay: Option<u8>, crashes: u8) -> Setup {
    let options = Options {
        settle: Duration::from_seconds(1),
        gather: Duration::from_seconds(1),
        first_timeout: Duration::from_seconds(2),
        longest_timeout: Duration::from_seconds(2),
        repetitions: 1,
        shortest_interval: Duration::from_seconds(4),
        longest_interval: Duration::from_seconds(8),
        patience: Duration::from_seconds(100),
        ..Options::default()
    };
    let bounds = Bounds {
        crashes,
        clocks: seconds(0, ticks, delay),
        ..Bounds::default()
    };
    let mut setup = setup(3, Registrar::new(options), bounds);
    setup.checkers.push(Box::new(Agreement::default()));
    setup
}

#[test]
fn robots_agree_in_the_explorations() {
    for (ticks, delay) in [(2, Some(0)), (1, None)] {
        assert!(
            happens(registration(ticks, delay, 0), 0, "agree"),
            "{ticks}"
        );
    }
}

#[test]
fn where_datagrams_arrive_within_a_tick_or_not_at_all() {
    assert_eq!(explore(2, Some(0), 0), (16_546, 31_455, 26));
}

#[test]
fn where_datagrams_take_any_time() {
    assert_eq!(explore(1, None, 0), (9_540, 30_090, 18));
}

#[test]
fn with_a_crash() {
    assert_eq!(explore(1, Some(0), 1), (97_198, 225_127, 23));
}
