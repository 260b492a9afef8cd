//! The timing of actions that wait: `pre ... for` and `every`.
//!
//! Invariant: a time in the future, which a fault may have left here, counts as now.

use crate::machine::{Action, Machine, RuntimeError};
use starl_core::{Duration, Random, Time};

/// The state of an action that waits for a time.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pace {
    /// Since when the guard has held at each activation; since the action fired, if that is later.
    held_since: Option<Time>,
    /// When it fired, or was to have fired, last.
    fired: Option<Time>,
}

impl Pace {
    /// Whether the action may fire at an activation.
    pub fn is_due(
        &mut self,
        action: &Action,
        number: u32,
        now: Time,
        machine: &mut Machine<'_>,
    ) -> Result<bool, RuntimeError> {
        if !machine.guard(number)? {
            self.held_since = None;
            return Ok(false);
        }
        let since = self.held_since.map_or(now, |since| since.min(now));
        self.held_since = Some(since);
        if now.since(since) < duration(action.hold, machine)? {
            return Ok(false);
        }
        let every = duration(action.every, machine)?;
        Ok(self.waited(now).is_none_or(|waited| waited >= every))
    }

    /// The action has fired.
    pub fn fire(
        &mut self,
        action: &Action,
        now: Time,
        machine: &mut Machine<'_>,
    ) -> Result<(), RuntimeError> {
        self.held_since = Some(now);
        let every = duration(action.every, machine)?;
        // Activations do not come at multiples of the time; the mean is correct nevertheless.
        let late = self
            .waited(now)
            .and_then(|waited| waited.0.checked_sub(every.0));
        self.fired = Some(match late.filter(|late| *late < every.0) {
            Some(late) => now - Duration(late),
            None => now,
        });
        Ok(())
    }

    /// How long ago it fired; none if it has not.
    fn waited(&self, now: Time) -> Option<Duration> {
        let fired = self.fired.filter(|fired| *fired <= now)?;
        Some(now.since(fired))
    }

    /// Random moments, as a transient fault leaves them.
    pub fn corrupt(&mut self, random: &mut Random) {
        for moment in [&mut self.held_since, &mut self.fired] {
            let bits = random.word();
            *moment = random
                .chance(0.5)
                .then(|| Time(bits >> (1 + random.below(63))));
        }
    }
}

/// The result of a function of an action; zero if it has none.
fn duration(function: Option<u32>, machine: &mut Machine<'_>) -> Result<Duration, RuntimeError> {
    let Some(function) = function else {
        return Ok(Duration::ZERO);
    };
    let (scalars, _) = machine.call(function, &[], &[])?;
    Ok(Duration(scalars.get(1).copied().unwrap_or(0)))
}
