//! The faults of a scenario, with their times.

use crate::fields::field_table;
use crate::fields::schema::{RATE, SPAN};
use starl_core::{Duration, FaultKind, Time};

/// Faults on a schedule and at random.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Faults {
    /// Faults at given times.
    pub schedule: Vec<Fault>,
    /// Faults at seeded rates.
    pub rates: FaultRates,
}

/// One fault.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// When it sets in.
    pub at: Time,
    /// The kind of fault.
    pub kind: FaultKind,
}

field_table! {
    /// Random faults, as events per robot and second (partitions: per second). Each is drawn from the
    /// seed as a Poisson process, and ends after a while.
    #[derive(Copy)]
    pub struct FaultRates {
        /// Crashes of each robot.
        crash: f64 = RATE, Value("0/s");
        /// A crashed robot restarts after this time.
        restart_after: Duration = SPAN, Word("never");
        /// Partitions of the fleet into two random halves.
        partition: f64 = RATE, Value("0/s");
        /// A partition heals after this time.
        heal_after: Duration = SPAN, Value("5s");
        /// Stuck motors of each robot.
        stuck_motor: f64 = RATE, Value("0/s");
        /// Frozen sensors of each robot.
        frozen_sensor: f64 = RATE, Value("0/s");
        /// Motors and sensors are repaired after this time.
        repair_after: Duration = SPAN, Value("5s");
        /// Corruptions of each robot's state.
        corrupt_state: f64 = RATE, Value("0/s");
    }
}
