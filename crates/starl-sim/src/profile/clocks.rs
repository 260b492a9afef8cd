//! Clocks are apart and run at different rates.

use super::Trouble;
use crate::scenario::Clock;
use starl_core::{Duration, math};

/// Clocks of each group are up to an hour apart, as often by milliseconds as by minutes, and drift by up
/// to 500 parts per million, or as often by up to 9,000, which leases allow for.
pub(super) fn set_wrong(trouble: &mut Trouble<'_>) {
    for group in 0..trouble.scenario.fleet.groups.len() {
        // Evenly in the logarithm, from a millisecond to an hour.
        let millis = math::exp(trouble.random.between(0.0, math::log(3.6e6)));
        let drawn = trouble.count(0, 500);
        let ppm = if drawn.is_multiple_of(2) {
            drawn
        } else {
            18 * drawn
        };
        let clock = Clock {
            offset: Duration::from_millis(millis as u64),
            // As a scenario's file would give it, to the last bit.
            drift_ppm: f64::from(ppm) / 1e6 * 1e6,
        };
        trouble.scenario.fleet.groups[group].clock = clock;
    }
}
