//! The suite that every host passes: robots behave alike on all of them.
//!
//! A host implements [`Host`] and names the suite in its tests:
//!
//! ```ignore
//! starl_host::conformance!(MyHost, skip clocks_run_wrong = "this host has no clocks of its own");
//! ```
//!
//! That makes a test of each behaviour. One that the host cannot show is skipped by name, and the reason
//! shows in the output of the tests; the suite fails where a host cannot show a behaviour that it does not skip,
//! and where it skips one that it can show.

mod log;
mod network;
mod outcomes;
mod probe;
mod restarts;
mod storage;
mod times;

pub use log::{Log, Told};
pub use network::*;
pub use outcomes::*;
pub use probe::{Act, Cue, Probe};
pub use restarts::*;
pub use storage::*;
pub use times::*;

use crate::Clock;
use alloc::vec::Vec;
use starl_core::{Duration, Record, RobotId, Time};

/// All time spans of the suite are multiples of this, except those of [`Need::Milliseconds`], because a host
/// may have no finer time.
pub const TICK: Duration = Duration::from_millis(10);

/// How often programs are activated, and hear where they are.
pub const PERIOD: Duration = Duration::from_millis(100);

/// How long a datagram takes.
pub const DELAY: Duration = Duration::from_millis(20);

/// How long a write takes.
pub const WRITE_TIME: Duration = Duration::from_millis(30);

/// A host under test. Its methods are called in the order of time.
pub trait Host: Sized {
    /// The needs that this host cannot meet, with the reasons.
    const LACKS: &'static [(Need, &'static str)];

    /// A fleet that starts at time 0: programs are activated and located every [`PERIOD`], datagrams take
    /// [`DELAY`] and none is lost, and planners take a [`TICK`].
    fn start(fleet: Fleet) -> Self;

    /// Advances time to `end`. Everything due before `end` has happened then, and nothing due at `end`.
    fn run_before(&mut self, end: Time);

    /// A robot crashes now.
    fn crash(&mut self, robot: RobotId);

    /// A robot that is down restarts now.
    fn restart(&mut self, robot: RobotId);

    /// A robot's state is overwritten now. Needs [`Need::Corruption`].
    fn corrupt(&mut self, robot: RobotId);

    /// Suspends the host until `end`; everything due before is late. Needs [`Need::Stalls`].
    fn stall(&mut self, end: Time);

    /// All records so far.
    fn records(&self) -> Vec<Record>;

    /// How late the host may be with anything.
    fn lateness(&self) -> Duration {
        Duration::ZERO
    }
}

/// The needs of some behaviours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Need {
    /// The host decides itself in which order things happen that are due at one moment.
    Order,
    /// Robots have clocks of their own.
    Clocks,
    /// Planners find paths.
    Paths,
    /// Time advances in steps shorter than a [`TICK`].
    Milliseconds,
    /// States can be overwritten.
    Corruption,
    /// The host can be late.
    Stalls,
    /// Robots have storage.
    Storage,
    /// A write to storage takes time.
    WriteTime,
    /// A robot that restarts knows how many datagrams it has sent.
    Count,
}

/// The robots of a test.
pub struct Fleet {
    /// Their programs, by number.
    pub robots: Vec<Probe>,
    /// Their clocks. A host that draws clocks at random draws within these bounds.
    pub clock: Clock,
    /// Whether they have storage, to which a write takes [`WRITE_TIME`].
    pub has_storage: bool,
}

/// A behaviour that a host cannot show, and why.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Missing(pub &'static str);

/// The result of a test that did not fail.
pub type Outcome = Result<(), Missing>;

/// The host can do this.
///
/// # Errors
/// It cannot.
fn need<H: Host>(need: Need) -> Outcome {
    let lack = H::LACKS.iter().find(|(lack, _)| *lack == need);
    lack.map_or(Ok(()), |&(_, reason)| Err(Missing(reason)))
}

/// Starts robots whose clocks are the host's.
fn start<H: Host>(robots: impl Into<Vec<Probe>>) -> H {
    H::start(Fleet {
        robots: robots.into(),
        clock: Clock::default(),
        has_storage: false,
    })
}

/// The same with storage.
fn start_with_storage<H: Host>(robots: impl Into<Vec<Probe>>) -> H {
    H::start(Fleet {
        robots: robots.into(),
        clock: Clock::default(),
        has_storage: true,
    })
}

/// A moment, in milliseconds.
fn ms(millis: u64) -> Time {
    Time::ZERO + Duration::from_millis(millis)
}

/// A span, in milliseconds.
fn span(millis: u64) -> Duration {
    Duration::from_millis(millis)
}

const ZERO: RobotId = RobotId(0);
const ONE: RobotId = RobotId(1);

/// Shows a behaviour.
#[track_caller]
pub fn show(behaviour: fn() -> Outcome) {
    if let Err(Missing(reason)) = behaviour() {
        panic!("this host cannot show it and does not say so: {reason}");
    }
}

/// Checks that a behaviour is skipped for the reason that the host gives.
#[track_caller]
pub fn check_skip(name: &str, behaviour: fn() -> Outcome, reason: &str) {
    assert_eq!(
        behaviour().map_err(|missing| missing.0),
        Err(reason),
        "{name}"
    );
}

/// Makes a test of each behaviour of the suite for a host: see [`testing::conformance`](crate::testing::conformance).
#[macro_export]
macro_rules! conformance {
    ($host:ty $(, skip $name:ident = $reason:literal)* $(,)?) => {
        $crate::conformance_tests!(($) $host $(, $name = $reason)*);

        #[test]
        fn every_skip_is_needed() {
            $($crate::testing::conformance::check_skip(
                stringify!($name),
                $crate::testing::conformance::$name::<$host>,
                $reason,
            );)*
        }
    };
}

#[doc(hidden)]
#[macro_export]
macro_rules! conformance_tests {
    (($d:tt) $host:ty $(, $name:ident = $reason:literal)*) => {
        macro_rules! behaviour {
            $(($name) => {
                #[test]
                #[ignore = $reason]
                fn $name() {}
            };)*
            ($d name:ident) => {
                #[test]
                fn $d name() {
                    $crate::testing::conformance::show(
                        $crate::testing::conformance::$d name::<$host>,
                    );
                }
            };
        }
        $crate::for_each_behaviour!(behaviour);
    };
}

#[doc(hidden)]
#[macro_export]
macro_rules! for_each_behaviour {
    ($with:ident) => {
        // Lives.
        $with!(a_robot_restarts_with_a_fresh_copy);
        $with!(nothing_of_an_earlier_life_comes_later);
        $with!(no_sequence_number_is_used_twice);
        $with!(the_next_life_continues_the_numbers);
        $with!(a_corrupted_robot_continues_until_it_restarts);
        // Times.
        $with!(things_due_at_once_happen_in_order);
        $with!(timers_are_moved_and_cancelled);
        $with!(timers_due_at_once_fire_in_the_order_of_their_keys);
        $with!(the_shortest_timer_takes_a_millisecond);
        $with!(clocks_run_wrong);
        $with!(a_late_host_activates_once);
        // Outcomes.
        $with!(a_path_answers_its_request);
        $with!(a_path_for_an_earlier_life_is_ignored);
        $with!(a_path_for_a_robot_that_is_down_is_ignored);
        $with!(a_failed_program_is_not_called_again);
        $with!(a_finished_program_still_answers);
        // Storage.
        $with!(saved_values_are_found_after_a_restart);
        $with!(effects_wait_for_the_write);
        $with!(a_crash_undoes_a_write_and_its_effects);
        $with!(writes_are_batched);
        $with!(robots_without_storage_find_nothing);
        // The network.
        $with!(datagrams_to_a_robot_that_is_down_are_dropped);
        $with!(a_datagram_may_arrive_in_a_later_life);
    };
}
