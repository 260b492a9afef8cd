//! Three robots whose storage survives a crash. Checkers excuse nothing then that they excuse where robots forget.

use crate::any_copies::{REGISTER_IS_UP, TWO_WRITES, WRITE_AND_READ, register};
use crate::elections_are_safe::election;
use crate::support::{all_is_well, happens, watched};
use crate::three_robots_with_a_crash::{ALL, TWO, mutex};
use starl_explore::Setup;
use starl_primitives::election::Algorithm::Leases;
use starl_primitives::mutex::Algorithm;

fn stored(mut setup: Setup) -> Setup {
    setup.model.keeps_storage = true;
    watched(setup)
}

/// Robots want the same resource, one robot crashes, and so many datagrams arrive twice.
fn quorums(wishes: &[&[&'static str]], duplicates: u8) -> Setup {
    let mut mutex = mutex(Algorithm::Quorum, wishes, 0);
    mutex.bounds.crashes = 1;
    mutex.bounds.duplicates = duplicates;
    stored(mutex)
}

#[test]
fn the_judged_events_happen() {
    let register = stored(register(WRITE_AND_READ, 1));
    assert!(happens(register, REGISTER_IS_UP, "done"));
    assert!(happens(quorums(&TWO, 1), 0, "enter"));
}

#[test]
fn register_with_a_writer_a_reader_and_a_crash() {
    let register = stored(register(WRITE_AND_READ, 1));
    let size = (139_546, 455_202, 37);
    assert_eq!(all_is_well(register, REGISTER_IS_UP), size);
}

#[test]
#[ignore = "takes minutes without optimisation"]
fn register_with_two_writers_and_a_crash() {
    let register = stored(register(TWO_WRITES, 1));
    let size = (1_846_491, 7_170_938, 42);
    assert_eq!(all_is_well(register, REGISTER_IS_UP), size);
}

#[test]
fn mutex_by_quorums_that_two_want_with_a_crash_and_a_duplicate() {
    let size = (512_679, 1_955_061, 29);
    assert_eq!(all_is_well(quorums(&TWO, 1), 0), size);
}

#[test]
#[ignore = "takes minutes without optimisation"]
fn mutex_by_quorums_that_all_want_with_a_crash() {
    let size = (8_854_193, 33_616_585, 39);
    assert_eq!(all_is_well(quorums(&ALL, 0), 0), size);
}

#[test]
#[ignore = "takes minutes without optimisation"]
fn election_by_leases_with_a_crash_and_a_duplicate() {
    let mut election = election(Leases, 1, 0, 1);
    election.bounds.duplicates = 1;
    election.bounds.most_states = 20_000_000;
    let size = (16_247_256, 80_066_067, 30);
    assert_eq!(all_is_well(stored(election), 3), size);
}
