//! Elections of three robots in all their behaviours after a warm-up, in a network that delivers within a tick
//! or not at all, in any order. The checkers are those of every run: an epoch has one leader, no two lead at
//! once, a leader has stood for election.

use crate::support::elector::Elector;
use crate::support::{all_is_well, happens, seconds, setup, watched};
use starl_core::Duration;
use starl_explore::{Bounds, Setup};
use starl_primitives::election::{Algorithm, Options};

fn explore(algorithm: Algorithm, ticks: u16, delay: u8, crashes: u8) -> (u32, u64, u32) {
    all_is_well(watched(election(algorithm, ticks, delay, crashes)), 3)
}

pub fn election(algorithm: Algorithm, ticks: u16, delay: u8, crashes: u8) -> Setup {
    let options = Options {
        algorithm,
        lease: Duration::from_seconds(2),
        drift: 0.0,
        period: Duration::from_seconds(2),
        first_timeout: Duration::from_seconds(2),
        answer_timeout: Duration::from_seconds(1),
        patience: Duration::from_seconds(4),
        give_up: Duration::from_seconds(100),
        ..Options::default()
    };
    let bounds = Bounds {
        crashes,
        clocks: seconds(3, ticks, Some(delay)),
        ..Bounds::default()
    };
    setup(3, Elector::new(options), bounds)
}

#[test]
fn leaders_are_elected_in_the_explorations() {
    for (algorithm, ticks) in [
        (Algorithm::Bully, 2),
        (Algorithm::Ballots, 2),
        (Algorithm::Leases, 1),
    ] {
        let election = election(algorithm, ticks, 0, 0);
        assert!(happens(election, 3, "leader"), "{algorithm:?}");
    }
}

#[test]
fn bully() {
    assert_eq!(explore(Algorithm::Bully, 2, 0, 0), (11_364, 25_266, 17));
}

#[test]
fn ballots() {
    assert_eq!(explore(Algorithm::Ballots, 2, 0, 0), (5_669, 15_545, 17));
}

#[test]
fn leases() {
    assert_eq!(explore(Algorithm::Leases, 1, 0, 0), (30_552, 115_004, 21));
}

#[test]
#[ignore = "takes a minute without optimisation"]
fn leases_that_end() {
    assert_eq!(
        explore(Algorithm::Leases, 2, 0, 0),
        (682_586, 3_283_073, 29)
    );
}

#[test]
fn leases_with_a_crash() {
    assert_eq!(
        explore(Algorithm::Leases, 1, 0, 1),
        (249_938, 1_080_945, 24)
    );
}

#[test]
fn bully_with_a_crash() {
    assert_eq!(explore(Algorithm::Bully, 1, 0, 1), (52_390, 134_182, 19));
}
