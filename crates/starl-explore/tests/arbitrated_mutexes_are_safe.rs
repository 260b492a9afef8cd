//! The mutexes by quorums and by leases in all their behaviours after a warm-up. What checkers see to: no
//! resource is held by two robots.

mod support;

use starl_core::Duration;
use starl_explore::{Bounds, Clocks};
use starl_primitives::mutex::{Algorithm, Options};
use support::locker::{Exclusion, Locker};
use support::{all_is_well, seconds, setup};

const ALL: [&[&str]; 3] = [&["a"], &["a"], &["a"]];
/// The third only grants.
const TWO: [&[&str]; 3] = [&["a"], &["a"], &[]];

fn quorum(robots: usize, wishes: &[&[&'static str]], timers: u8, crashes: u8) -> (u32, u64, u32) {
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
    all_is_well(setup, 0)
}

/// A lease is two ticks long, and nobody repeats himself before the end.
fn lease(robots: usize, wishes: &[&[&'static str]], ticks: u16, crashes: u8) -> (u32, u64, u32) {
    let never = Duration::from_seconds(1000);
    let options = Options {
        algorithm: Algorithm::Lease,
        first_timeout: never,
        longest_timeout: never,
        lease: Duration::from_seconds(2),
        drift: 0.0,
    };
    let bounds = Bounds {
        crashes,
        clocks: seconds(3, ticks, Some(0)),
        ..Bounds::default()
    };
    let mut setup = setup(robots, Locker::new(wishes, options), bounds);
    setup.checkers.push(Box::new(Exclusion::default()));
    all_is_well(setup, 3)
}

#[test]
fn quorums_of_three_robots() {
    assert_eq!(quorum(3, &ALL, 0, 0), (34_837, 126_324, 27));
}

#[test]
fn quorums_with_a_repetition() {
    assert_eq!(quorum(3, &TWO, 1, 0), (37_968, 161_233, 19));
}

#[test]
fn quorums_of_two_with_a_crash() {
    assert_eq!(quorum(2, &ALL, 0, 1), (28_676, 87_701, 21));
}

#[test]
fn leases_of_three_robots_that_two_of_them_want() {
    assert_eq!(lease(3, &TWO, 3, 0), (423_345, 1_644_092, 25));
}

#[test]
#[ignore = "takes a minute without optimisation"]
fn leases_that_all_three_want() {
    assert_eq!(lease(3, &ALL, 1, 0), (1_601_243, 7_303_870, 25));
}

#[test]
#[ignore = "takes a minute without optimisation"]
fn leases_of_two_with_a_crash() {
    assert_eq!(lease(2, &ALL, 4, 1), (840_775, 2_562_419, 28));
}
