//! A run that looks for a failure: it ends at the first one.

use crate::run::{Outcome, Run};
use serde::{Deserialize, Serialize};
use starl_core::event::Name;
use starl_core::{Record, Time};
use starl_properties::Excuse;
use std::fmt;

/// The failure of a run.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Finding {
    /// This property was violated.
    Violated(Name),
    /// A program could not continue.
    Failed,
    /// The time was up before the goal was reached, or no robot was left.
    Unreached,
}

/// The result of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// How it ended.
    pub outcome: Outcome,
    /// The first failure.
    pub finding: Option<Finding>,
    /// The observation, in a sentence; empty without a failure.
    pub text: String,
    /// When the run ended.
    pub end: Time,
    /// How often something was excused that speaks against a property, and why.
    pub excused: Vec<(Name, Excuse, u64)>,
}

impl Trial {
    /// Lets the run continue to its end, or until something goes wrong. Whether a goal that is not reached is wrong is
    /// for the caller to say.
    pub fn of(run: &mut Run, demands_goal: bool) -> Trial {
        Trial::watched(run, demands_goal, &mut |_| ())
    }

    /// Does the same, and passes the records of each step to `see`.
    pub fn watched(run: &mut Run, demands_goal: bool, see: &mut dyn FnMut(&[Record])) -> Trial {
        while !run.is_over() && run.violations().is_empty() && run.failures().is_empty() {
            run.advance();
            see(run.simulation().records());
        }
        let (outcome, finding, text) = if let Some(violation) = run.violations().first() {
            let finding = Finding::Violated(violation.property.clone());
            (Outcome::Violated, Some(finding), violation.text.clone())
        } else if let Some(failure) = run.failures().first() {
            let text = format!("robot {}: {}", failure.robot, failure.text);
            (Outcome::Failed, Some(Finding::Failed), text)
        } else {
            let outcome = run.outcome();
            let missed = demands_goal && outcome != Outcome::Reached;
            let text = match missed {
                true => unreached(run),
                false => String::new(),
            };
            (outcome, missed.then_some(Finding::Unreached), text)
        };
        Trial {
            outcome,
            finding,
            text,
            end: run.simulation().now(),
            excused: run.excused(),
        }
    }
}

fn unreached(run: &Run) -> String {
    let progress = run.simulation().progress();
    if progress.up == 0 {
        return "no robot is left".into();
    }
    format!(
        "{} of {} robots that are up have finished within {}",
        progress.finished,
        progress.up,
        run.simulation().scenario().duration
    )
}

impl Finding {
    /// The property that was violated, `failed` or `unreached`.
    pub fn name(&self) -> &str {
        match self {
            Finding::Violated(property) => property,
            Finding::Failed => "failed",
            Finding::Unreached => "unreached",
        }
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Finding::Violated(property) => f.write_str(property),
            Finding::Failed => f.write_str("a program failed"),
            Finding::Unreached => f.write_str("the goal was not reached"),
        }
    }
}
