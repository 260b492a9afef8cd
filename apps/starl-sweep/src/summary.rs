//! The result of each combination: the share of runs that reached their goal, and the mean of each metric.

use crate::statistics::{Interval, mean, wilson};
use crate::{METRICS, Measured, Metric, Plan, Row};
use serde::Serialize;
use std::collections::BTreeMap;

/// The existing rows of a plan, condensed by combination.
#[derive(Clone, Debug, Serialize)]
pub struct Summary {
    /// In the order of the plan; also those without rows.
    pub combinations: Vec<Combination>,
}

/// The runs of one combination.
#[derive(Clone, Debug, Serialize)]
pub struct Combination {
    /// The value of each axis, by field.
    pub values: BTreeMap<String, String>,
    /// How many runs there are.
    pub runs: u64,
    /// How many reached the goal.
    pub reached: u64,
    /// How many violated a property.
    pub violated: u64,
    /// How many ended because a program failed or no robot was left.
    pub failed: u64,
    /// The share of runs that reached the goal, with the interval of Wilson; none without runs.
    pub goal: Option<Interval>,
    /// The mean of each metric over the runs that have it, with Student's interval.
    pub metrics: BTreeMap<&'static str, Option<Interval>>,
}

impl Summary {
    /// The summary of the rows that there are, by number.
    pub fn of(plan: &Plan, rows: &BTreeMap<u64, Measured>) -> Summary {
        let seeds = plan.seeds().count();
        let combinations = (0..plan.combinations()).map(|combination| {
            let first = combination * seeds;
            let rows = rows.range(first..first + seeds);
            let rows: Vec<&Row> = rows.map(|(_, measured)| &measured.row).collect();
            let axes = plan.axes().iter().map(|axis| axis.field.clone());
            let values = plan.values(combination).into_iter().map(str::to_string);
            Combination::of(axes.zip(values).collect(), &rows)
        });
        Summary {
            combinations: combinations.collect(),
        }
    }
}

impl Combination {
    fn of(values: BTreeMap<String, String>, rows: &[&Row]) -> Combination {
        let count = |is: &dyn Fn(&Row) -> bool| rows.iter().filter(|row| is(row)).count() as u64;
        let (runs, reached) = (rows.len() as u64, count(&|row| row.goal_reached));
        let mean_of = |metric: &'static Metric| {
            let samples: Vec<f64> = rows.iter().filter_map(|row| metric.of(row)).collect();
            (metric.name, mean(&samples))
        };
        Combination {
            values,
            runs,
            reached,
            violated: count(&|row| !row.violated.is_empty()),
            failed: count(&|row| row.outcome == "failed"),
            goal: wilson(reached, runs),
            metrics: METRICS.iter().map(mean_of).collect(),
        }
    }
}
