//! Which numbers a summary shows.

use crate::failure::Failure;
use starl_sweep::Metric;

/// A number of a summary.
#[derive(Clone, Copy, Debug)]
pub enum Shown {
    /// The share of runs that reached the goal.
    Goal,
    /// The mean of a metric.
    Mean(&'static Metric),
}

/// The name of [`Shown::Goal`].
const GOAL: &str = "goal";

/// Shown unless others are named.
const USUAL: [&str; 3] = [GOAL, "time_to_goal_seconds", "messages_sent"];

/// The metrics of these names; the usual ones if there are none.
pub fn shown(names: &[String]) -> Result<Vec<Shown>, Failure> {
    let named = names.iter().map(|name| name.trim());
    let names: Vec<&str> = match names {
        [] => USUAL.to_vec(),
        _ => named.collect(),
    };
    let shown = names.into_iter().map(|name| match name {
        GOAL => Ok(Shown::Goal),
        name => Ok(Shown::Mean(Metric::by_name(name)?)),
    });
    shown.collect()
}

impl Shown {
    /// Its name, as `--metric` has it.
    pub fn name(self) -> &'static str {
        match self {
            Shown::Goal => GOAL,
            Shown::Mean(metric) => metric.name,
        }
    }

    /// Its name at an axis, with the unit.
    pub fn label(self) -> &'static str {
        match self {
            Shown::Goal => "runs that reached the goal in %",
            Shown::Mean(metric) => metric.label,
        }
    }
}
