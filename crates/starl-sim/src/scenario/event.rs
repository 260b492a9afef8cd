//! What happens to a run besides faults: things and way-points appear, operators speak, the world changes.

use super::Bounds;
use starl_core::{Intervention, Time};

/// An event of a scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct ScenarioEvent {
    /// When it takes place.
    pub occasion: Occasion,
    /// What happens.
    pub what: Intervention,
}

/// When an event takes place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Occasion {
    /// Once, at this time.
    At(Time),
    /// Again and again at random times, drawn from the seed as a Poisson process. Things and way-points get
    /// the number of the occasion appended to their names.
    Rate {
        /// Occasions per second.
        per_second: f64,
        /// Things and way-points appear at random places in this rectangle; at one place if there is none.
        within: Option<Bounds>,
    },
}
