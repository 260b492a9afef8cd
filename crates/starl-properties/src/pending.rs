//! Pending violations, which a fault may still excuse.
//!
//! Faults take effect at the beginning of the step in which they are recorded, so a robot's action in a step may be
//! recorded before the fault that caused it.

use super::{Excuse, Excused, Setting, Violation};
use starl_core::{Duration, Time};
use std::collections::VecDeque;

/// Violations in the order of their times, of the last step.
#[derive(Clone, Debug, Default)]
pub(super) struct Pending {
    found: VecDeque<Violation>,
    step: Duration,
}

impl Pending {
    /// Nothing yet.
    pub fn new(setting: &Setting) -> Pending {
        Pending {
            found: VecDeque::new(),
            step: setting.step,
        }
    }

    /// One more.
    pub fn push(&mut self, violation: Violation) {
        self.found.push_back(violation);
    }

    /// A fault excuses all except these.
    pub fn retain(
        &mut self,
        excuse: Excuse,
        excused: &mut Excused,
        mut has_no_excuse: impl FnMut(&Violation) -> bool,
    ) {
        self.found.retain(|found| {
            let stays = has_no_excuse(found);
            if !stays {
                excused.forgive(found, excuse);
            }
            stays
        });
    }

    /// Advances to `now` and reports the violations that no fault can excuse any more.
    pub fn settle(&mut self, now: Time, violations: &mut Vec<Violation>) {
        let step = self.step;
        while let Some(settled) = self.found.pop_front_if(|found| found.at + step < now) {
            violations.push(settled);
        }
    }
}

impl Extend<Violation> for Pending {
    fn extend<T: IntoIterator<Item = Violation>>(&mut self, violations: T) {
        self.found.extend(violations);
    }
}
