//! All behaviours of the mutexes by quorums and by leases after a warm-up. The checkers verify that no
//! resource is held by two robots.

use crate::support::locker::{Exclusion, Locker};
use crate::support::{all_is_well, happens, setup};
use starl_core::Duration;
use starl_explore::{Bounds, Clocks, Setup};
use starl_primitives::mutex::{Algorithm, Options};

pub const ALL: [&[&str]; 3] = [&["a"], &["a"], &["a"]];
/// Ticks before the first request: all arbiters are ready then.
const WARM_UP: u16 = 1;
/// The third only grants.
const TWO: [&[&str]; 3] = [&["a"], &["a"], &[]];

fn quorum(robots: usize, wishes: &[&[&'static str]], timers: u8, crashes: u8) -> (u32, u64, u32) {
    all_is_well(quorums(robots, wishes, timers, crashes), 0)
}

pub fn quorums(robots: usize, wishes: &[&[&'static str]], timers: u8, crashes: u8) -> Setup {
    let options = Options {
        algorithm: Algorithm::Quorum,
        ..Options::default()
    };
    let bounds = Bounds {
        timers,
        crashes,
        clocks: Clocks::Still,
        ..Bounds::default()
    };
    let mut setup = setup(robots, Locker::new(wishes, options), bounds);
    setup.checkers.push(Box::new(Exclusion::default()));
    setup.model.all_finish = true;
    setup
}

fn lease(robots: usize, wishes: &[&[&'static str]], ticks: u16, crashes: u8) -> (u32, u64, u32) {
    all_is_well(leases(robots, wishes, ticks, crashes), WARM_UP)
}

/// A lease ends for its holder after two ticks, and for the robots that granted it at the next. No robot repeats a
/// message within three ticks.
pub fn leases(robots: usize, wishes: &[&[&'static str]], ticks: u16, crashes: u8) -> Setup {
    let options = Options {
        algorithm: Algorithm::Lease,
        first_timeout: Duration::from_millis(2900),
        longest_timeout: Duration::from_seconds(1000),
        lease: Duration::from_seconds(2),
        drift: 0.01,
    };
    let bounds = Bounds {
        crashes,
        clocks: Clocks::Ticking {
            tick: Duration::from_millis(981),
            ticks: WARM_UP + ticks,
            skew: 0,
            delay: Some(0),
        },
        ..Bounds::default()
    };
    let mut setup = setup(robots, Locker::new(wishes, options), bounds);
    setup.checkers.push(Box::new(Exclusion::default()));
    setup
}

#[test]
fn resources_are_held_in_the_explorations() {
    assert!(happens(quorums(3, &ALL, 0, 0), 0, "enter"));
    assert!(happens(leases(3, &TWO, 0, 0), WARM_UP, "enter"));
    assert!(happens(leases(2, &ALL, 4, 0), WARM_UP, "expire"));
}

#[test]
fn quorums_of_three_robots() {
    assert_eq!(quorum(3, &ALL, 0, 0), (65_580, 256_350, 27));
}

#[test]
fn quorums_with_a_repetition() {
    assert_eq!(quorum(3, &TWO, 1, 0), (30_318, 125_212, 19));
}

#[test]
fn quorums_of_two_with_a_crash() {
    assert_eq!(quorum(2, &ALL, 0, 1), (35_690, 110_967, 21));
}

#[test]
fn leases_of_three_robots_that_two_of_them_want() {
    assert_eq!(lease(3, &TWO, 0, 0), (14_412, 41_788, 23));
}

#[test]
fn leases_of_two_robots_that_end() {
    assert_eq!(lease(2, &ALL, 4, 0), (187_963, 471_161, 31));
}

#[test]
fn leases_of_two_that_do_not_end_with_a_crash() {
    assert_eq!(lease(2, &ALL, 0, 1), (44_440, 107_283, 27));
}

#[test]
#[ignore = "takes minutes without optimisation"]
fn leases_of_two_with_a_crash() {
    assert_eq!(lease(2, &ALL, 1, 1), (1_826_384, 5_279_819, 32));
}
