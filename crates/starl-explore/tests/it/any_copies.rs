//! Three robots in a network that keeps every datagram: each may arrive at any time, any number of times, or never,
//! also after a crash and restart of its sender or receiver. This covers every loss and every duplicate. The checkers
//! are those of every run.

use crate::support::elector::Elector;
use crate::support::keeper::{Keeper, Operation};
use crate::support::locker::Locker;
use crate::support::registrar::Registrar;
use crate::support::sharer::Sharer;
use crate::support::waiter::Waiter;
use crate::support::{all_is_well, happens, seconds, setup, watched};
use starl_core::{Duration, Program};
use starl_explore::{Bounds, Clocks, Setup};
use starl_primitives::{election, mutex, register, registration, shared_memory};

fn any_copies(program: impl Program + Clone + 'static, clocks: Clocks, crashes: u8) -> Setup {
    let bounds = Bounds {
        any_copies: true,
        timers: 0,
        crashes,
        clocks,
        ..Bounds::default()
    };
    watched(setup(3, program, bounds))
}

pub fn memory(crashes: u8) -> Setup {
    let sharer = Sharer::new(&[true; 3], shared_memory::Options::default());
    any_copies(sharer, Clocks::Still, crashes)
}

pub const WRITE_AND_READ: [Option<Operation>; 3] =
    [Some(Operation::Write), Some(Operation::Read), None];
pub const TWO_WRITES: [Option<Operation>; 3] =
    [Some(Operation::Write), Some(Operation::Write), None];
/// Ticks after which all copies of the register answer.
pub const REGISTER_IS_UP: u16 = 2;

pub fn register(operations: [Option<Operation>; 3], crashes: u8) -> Setup {
    let keeper = Keeper::new(&operations, register::Options::default());
    any_copies(keeper, seconds(REGISTER_IS_UP, 0, Some(0)), crashes)
}

fn registration(crashes: u8) -> Setup {
    let second = Duration::from_seconds(1);
    let options = registration::Options {
        settle: second,
        gather: second,
        first_timeout: second * 2,
        longest_timeout: second * 2,
        repetitions: 1,
        shortest_interval: second * 4,
        longest_interval: second * 8,
        patience: second * 100,
        ..registration::Options::default()
    };
    any_copies(Registrar::new(options), seconds(0, 1, Some(0)), crashes)
}

fn election(algorithm: election::Algorithm, ticks: u16, crashes: u8) -> Setup {
    let second = Duration::from_seconds(1);
    let options = election::Options {
        algorithm,
        lease: second * 2,
        drift: 0.0,
        period: second * 2,
        first_timeout: second * 2,
        answer_timeout: second,
        patience: second * 4,
        give_up: second * 100,
        ..election::Options::default()
    };
    any_copies(Elector::new(options), seconds(3, ticks, Some(0)), crashes)
}

pub fn ballots(ticks: u16) -> Setup {
    election(election::Algorithm::Ballots, ticks, 1)
}

pub fn barrier() -> Setup {
    any_copies(Waiter::new(1), Clocks::Still, 0)
}

fn quorums() -> Setup {
    let options = mutex::Options {
        algorithm: mutex::Algorithm::Quorum,
        ..mutex::Options::default()
    };
    let locker = Locker::new(&[&["a"], &["a"], &[]], options);
    any_copies(locker, Clocks::Still, 0)
}

#[test]
fn the_judged_events_happen() {
    use election::Algorithm::{Ballots, Bully};
    assert!(happens(memory(1), 0, "write"));
    assert!(happens(register(WRITE_AND_READ, 1), REGISTER_IS_UP, "done"));
    assert!(happens(quorums(), 0, "enter"));
    assert!(happens(barrier(), 0, "pass"));
    assert!(happens(election(Bully, 2, 1), 3, "leader"));
    assert!(happens(election(Ballots, 2, 0), 3, "leader"));
}

#[test]
fn memory_with_three_writers_and_a_crash() {
    assert_eq!(all_is_well(memory(1), 0), (33_774, 107_136, 16));
}

#[test]
fn register_with_a_writer_a_reader_and_a_crash() {
    let size = (514_271, 2_111_794, 54);
    assert_eq!(
        all_is_well(register(WRITE_AND_READ, 1), REGISTER_IS_UP),
        size
    );
}

#[test]
fn register_with_two_writers() {
    assert_eq!(
        all_is_well(register(TWO_WRITES, 0), REGISTER_IS_UP),
        (4_442, 17_645, 23)
    );
}

#[test]
#[ignore = "takes minutes without optimisation"]
fn register_with_two_writers_and_a_crash() {
    assert_eq!(
        all_is_well(register(TWO_WRITES, 1), REGISTER_IS_UP),
        (6_685_908, 28_824_015, 61)
    );
}

#[test]
fn barrier_that_three_robots_pass() {
    assert_eq!(all_is_well(barrier(), 0), (52_848, 128_121, 21));
}

#[test]
fn quorums_that_two_robots_ask() {
    assert_eq!(all_is_well(quorums(), 0), (1_152, 4_345, 19));
}

#[test]
fn registration_with_a_crash() {
    let size = (437_564, 2_315_606, 31);
    assert_eq!(all_is_well(registration(1), 0), size);
}

#[test]
fn bully_with_a_crash() {
    let election = election(election::Algorithm::Bully, 2, 1);
    assert_eq!(all_is_well(election, 3), (155_299, 436_103, 22));
}

#[test]
fn ballots_with_a_crash_while_a_tick_passes() {
    assert_eq!(all_is_well(ballots(1), 3), (54_312, 363_902, 35));
}

#[test]
#[ignore = "takes minutes without optimisation"]
fn ballots_with_a_crash() {
    assert_eq!(all_is_well(ballots(2), 3), (485_290, 2_920_461, 45));
}
