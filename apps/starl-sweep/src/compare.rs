//! Two versions of a program or a scenario, compared seed by seed.
//!
//! Both run with the same seeds, so what a seed draws (start places, noise, faults) is the same for both, and the
//! differences scatter less than the runs do (common random numbers).

use crate::statistics::{Interval, agresti_min, mean};
use crate::{METRICS, Row};
use serde::Serialize;

/// The differences of B from A.
#[derive(Clone, Debug, Serialize)]
pub struct Comparison {
    /// How many seeds both have run with.
    pub pairs: u64,
    /// How many of these runs are the same, digest by digest.
    pub identical: u64,
    /// The goal.
    pub goal: GoalDifference,
    /// Each metric, in the order of [`METRICS`].
    pub metrics: Vec<Difference>,
    /// The seeds that changed their outcome or the properties that they violate.
    pub changed: Vec<Pair>,
}

/// The difference of the shares of runs that reached the goal.
#[derive(Clone, Debug, Serialize)]
pub struct GoalDifference {
    /// How many runs of A reached it.
    pub a: u64,
    /// How many runs of B reached it.
    pub b: u64,
    /// The share of B minus that of A, with the interval of Agresti and Min; none without seeds.
    pub difference: Option<Interval>,
}

/// The difference of a metric.
#[derive(Clone, Debug, Serialize)]
pub struct Difference {
    /// Its name.
    pub metric: &'static str,
    /// How many seeds have it with both.
    pub pairs: u64,
    /// The mean with A over these seeds.
    pub a: Option<f64>,
    /// The mean with B over these seeds.
    pub b: Option<f64>,
    /// The mean of B minus A, with Student's interval.
    pub difference: Option<Interval>,
}

/// A seed with another outcome.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Pair {
    /// The seed.
    pub seed: u64,
    /// The outcome with A.
    pub a: String,
    /// The outcome with B.
    pub b: String,
    /// The properties that A violates.
    pub violated_by_a: Vec<String>,
    /// The properties that B violates.
    pub violated_by_b: Vec<String>,
    /// Whether A succeeded and B did not.
    pub is_worse: bool,
}

impl Comparison {
    /// Compares the rows of A and B that have the same seeds. Both are in the order of their seeds.
    pub fn of(a: &[Row], b: &[Row]) -> Comparison {
        let pairs: Vec<(&Row, &Row)> = a
            .iter()
            .filter_map(|a| {
                let found = b.binary_search_by_key(&a.seed, |b| b.seed);
                found.ok().map(|index| (a, &b[index]))
            })
            .collect();
        let count =
            |is: &dyn Fn(&Row, &Row) -> bool| pairs.iter().filter(|(a, b)| is(a, b)).count() as u64;
        let gained = count(&|a, b| !a.goal_reached && b.goal_reached);
        let lost = count(&|a, b| a.goal_reached && !b.goal_reached);
        let changed = pairs
            .iter()
            .filter(|(a, b)| (&a.outcome, &a.violated) != (&b.outcome, &b.violated));
        Comparison {
            pairs: pairs.len() as u64,
            identical: count(&|a, b| a.digest == b.digest),
            goal: GoalDifference {
                a: count(&|a, _| a.goal_reached),
                b: count(&|_, b| b.goal_reached),
                difference: agresti_min(gained, lost, pairs.len() as u64),
            },
            metrics: METRICS
                .iter()
                .map(|metric| difference(metric, &pairs))
                .collect(),
            changed: changed.map(|(a, b)| Pair::of(a, b)).collect(),
        }
    }

    /// The number of seeds that became worse: A succeeded, and B did not.
    pub fn worse(&self) -> usize {
        self.changed.iter().filter(|pair| pair.is_worse).count()
    }
}

impl Pair {
    fn of(a: &Row, b: &Row) -> Pair {
        Pair {
            seed: a.seed,
            a: a.outcome.clone(),
            b: b.outcome.clone(),
            violated_by_a: a.violated.clone(),
            violated_by_b: b.violated.clone(),
            is_worse: a.is_success() && !b.is_success(),
        }
    }
}

fn difference(metric: &'static crate::Metric, pairs: &[(&Row, &Row)]) -> Difference {
    let values = pairs
        .iter()
        .filter_map(|(a, b)| metric.of(a).zip(metric.of(b)));
    let (a, b): (Vec<f64>, Vec<f64>) = values.unzip();
    let differences: Vec<f64> = a.iter().zip(&b).map(|(a, b)| b - a).collect();
    let estimate = |samples: &[f64]| mean(samples).map(|mean| mean.estimate);
    Difference {
        metric: metric.name,
        pairs: differences.len() as u64,
        a: estimate(&a),
        b: estimate(&b),
        difference: mean(&differences),
    }
}
