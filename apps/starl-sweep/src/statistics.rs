//! Estimates with their intervals, all at 95 % confidence.

use serde::Serialize;

/// An estimate and the interval that covers the true value in 95 % of all samples.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Interval {
    /// The estimate.
    pub estimate: f64,
    /// The lower end; none if there are too few samples for an interval.
    pub low: Option<f64>,
    /// The upper end.
    pub high: Option<f64>,
}

impl Interval {
    fn around(estimate: f64, low: f64, high: f64) -> Interval {
        Interval {
            estimate,
            low: Some(low),
            high: Some(high),
        }
    }

    /// Whether it excludes zero.
    pub fn excludes_zero(&self) -> bool {
        matches!((self.low, self.high), (Some(low), Some(high)) if low > 0.0 || high < 0.0)
    }
}

/// The 97.5 % quantile of the normal distribution.
const Z: f64 = 1.959_963_984_540_054;

/// A share with the score interval of Wilson (1927), which stays within 0 and 1 and holds for shares of 0 and 1 too;
/// none without samples.
pub fn wilson(successes: u64, samples: u64) -> Option<Interval> {
    if samples == 0 {
        return None;
    }
    let n = samples as f64;
    let share = successes as f64 / n;
    let scale = 1.0 + Z * Z / n;
    let centre = (share + Z * Z / (2.0 * n)) / scale;
    let spread = (share * (1.0 - share) / n + Z * Z / (4.0 * n * n)).sqrt();
    let half = Z * spread / scale;
    // Rounding would leave 1e-17 where the ends are exactly 0 and 1.
    let low = if successes == 0 { 0.0 } else { centre - half };
    let high = if successes == samples {
        1.0
    } else {
        centre + half
    };
    Some(Interval::around(share, low, high))
}

/// A mean with Student's interval; none without samples, and no ends with one.
pub fn mean(samples: &[f64]) -> Option<Interval> {
    let n = samples.len() as f64;
    if samples.is_empty() {
        return None;
    }
    let mean = samples.iter().sum::<f64>() / n;
    if samples.len() == 1 {
        return Some(Interval {
            estimate: mean,
            low: None,
            high: None,
        });
    }
    let square = |sample: &f64| (sample - mean) * (sample - mean);
    let variance = samples.iter().map(square).sum::<f64>() / (n - 1.0);
    let half = student(samples.len() - 1) * (variance / n).sqrt();
    Some(Interval::around(mean, mean - half, mean + half))
}

/// The difference of two shares of the same samples, of which `gained` have only the second property and `lost` only the
/// first, with the interval of Agresti and Min (2005): half a sample is added to each of the four cells. None without
/// samples.
pub fn agresti_min(gained: u64, lost: u64, samples: u64) -> Option<Interval> {
    if samples == 0 {
        return None;
    }
    let estimate = (gained as f64 - lost as f64) / samples as f64;
    let (b, c, n) = (gained as f64 + 0.5, lost as f64 + 0.5, samples as f64 + 2.0);
    let centre = (b - c) / n;
    let half = Z * ((b + c) - (b - c) * (b - c) / n).sqrt() / n;
    let (low, high) = ((centre - half).max(-1.0), (centre + half).min(1.0));
    Some(Interval::around(estimate, low, high))
}

/// The 97.5 % quantile of Student's distribution. Between the tabled degrees of freedom it is interpolated in their
/// reciprocals, which is exact to three decimals.
fn student(freedom: usize) -> f64 {
    let above = TABLE.iter().position(|(known, _)| *known >= freedom);
    let last = TABLE[TABLE.len() - 1];
    let (low, high) = match above {
        Some(index) if TABLE[index].0 == freedom => return TABLE[index].1,
        // The table begins with 1.
        Some(index) => (
            TABLE[index - 1],
            (1.0 / TABLE[index].0 as f64, TABLE[index].1),
        ),
        None => (last, (0.0, Z)),
    };
    let from = 1.0 / low.0 as f64;
    let part = (from - 1.0 / freedom as f64) / (from - high.0);
    low.1 + (high.1 - low.1) * part
}

/// Degrees of freedom and the 97.5 % quantile of Student's distribution.
const TABLE: &[(usize, f64)] = &[
    (1, 12.706_205),
    (2, 4.302_653),
    (3, 3.182_446),
    (4, 2.776_445),
    (5, 2.570_582),
    (6, 2.446_912),
    (7, 2.364_624),
    (8, 2.306_004),
    (9, 2.262_157),
    (10, 2.228_139),
    (11, 2.200_985),
    (12, 2.178_813),
    (13, 2.160_369),
    (14, 2.144_787),
    (15, 2.131_450),
    (16, 2.119_905),
    (17, 2.109_816),
    (18, 2.100_922),
    (19, 2.093_024),
    (20, 2.085_963),
    (25, 2.059_539),
    (30, 2.042_272),
    (40, 2.021_075),
    (60, 2.000_298),
    (120, 1.979_930),
];

#[cfg(test)]
mod tests {
    use super::*;

    fn near(found: Option<Interval>, estimate: f64, low: f64, high: f64) {
        let found = found.expect("there are samples");
        let ends = (found.low.expect("an end"), found.high.expect("an end"));
        for (found, expected) in [(found.estimate, estimate), (ends.0, low), (ends.1, high)] {
            assert!((found - expected).abs() < 5e-4, "{found} is not {expected}");
        }
    }

    /// The values are those of R: `binom::binom.wilson` and `t.test`.
    #[test]
    fn intervals_are_those_of_other_software() {
        near(wilson(8, 10), 0.8, 0.4902, 0.9433);
        near(wilson(0, 20), 0.0, 0.0, 0.1611);
        near(wilson(100, 100), 1.0, 0.9630, 1.0);
        near(mean(&[1.0, 2.0, 3.0, 4.0]), 2.5, 0.4457, 4.5543);
        near(mean(&[5.0, 5.0, 5.0]), 5.0, 5.0, 5.0);
    }

    #[test]
    fn quantiles_between_those_of_the_table_are_interpolated() {
        for (freedom, quantile) in [(22, 2.0739), (35, 2.0301), (50, 2.0086), (99, 1.9842)] {
            assert!((student(freedom) - quantile).abs() < 5e-4, "{freedom}");
        }
        assert!((student(1_000_000) - Z).abs() < 1e-4);
    }

    #[test]
    fn a_difference_of_shares_is_zero_where_as_many_are_gained_as_lost() {
        let found = agresti_min(3, 3, 100).expect("there are samples");
        assert_eq!(found.estimate, 0.0);
        assert!(!found.excludes_zero());
        assert!(agresti_min(0, 20, 100).is_some_and(|found| found.excludes_zero()));
    }

    #[test]
    fn few_samples_have_no_interval() {
        assert_eq!(wilson(0, 0), None);
        assert_eq!(mean(&[]), None);
        let one = mean(&[3.0]).expect("a mean");
        assert_eq!((one.estimate, one.low, one.high), (3.0, None, None));
    }
}
