//! The faults of a scenario, with their times.

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

/// Random faults, as events per robot and second (partitions: per second). Each is drawn from the
/// seed as a Poisson process, and ends after a while.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaultRates {
    /// Crashes per robot and second; default 0.
    pub crash: f64,
    /// A crashed robot restarts after this time; default never (zero).
    pub restart_after: Duration,
    /// Partitions of the fleet into two random halves per second; default 0.
    pub partition: f64,
    /// A partition heals after this time; default 5 s.
    pub heal_after: Duration,
    /// Stuck motors per robot and second; default 0.
    pub stuck_motor: f64,
    /// Frozen sensors per robot and second; default 0.
    pub frozen_sensor: f64,
    /// Motors and sensors are repaired after this time; default 5 s.
    pub repair_after: Duration,
    /// Corruptions of state per robot and second; default 0.
    pub corrupt_state: f64,
}

impl Default for FaultRates {
    fn default() -> FaultRates {
        FaultRates {
            crash: 0.0,
            restart_after: Duration::ZERO,
            partition: 0.0,
            heal_after: Duration::from_seconds(5),
            stuck_motor: 0.0,
            frozen_sensor: 0.0,
            repair_after: Duration::from_seconds(5),
            corrupt_state: 0.0,
        }
    }
}
