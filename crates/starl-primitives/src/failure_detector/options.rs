//! The period of heartbeats, and the limits of silence before a suspicion.

use starl_core::{Duration, math};

/// Settings of [`super::FailureDetector`]; all robots should have the same period. Times run on the
/// robot's own clock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Time between two heartbeats, give or take a tenth. Default 500 ms.
    pub period: Duration,
    /// A robot is suspected once its silence would be this unlikely, as the negative decimal logarithm
    /// of the odds that it is only late (the papers' phi). Default 8.
    pub threshold: f64,
    /// A robot is not suspected for a silence up to this time beyond the usual one. Default 500 ms.
    pub margin: Duration,
    /// Silence longer than this is always held against a robot. The margin grows by a period whenever
    /// a suspicion proves false, up to this. Default 15 s.
    pub longest_patience: Duration,
    /// A robot that was never heard is suspected after this time. Default 3 s.
    pub first_timeout: Duration,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            period: Duration::from_millis(500),
            threshold: 8.0,
            margin: Duration::from_millis(500),
            longest_patience: Duration::from_seconds(15),
            first_timeout: Duration::from_seconds(3),
        }
    }
}

impl Options {
    /// The period, made a sensible one.
    pub(super) fn period(&self) -> Duration {
        self.period.max(Duration::from_millis(1))
    }

    /// How many standard deviations beyond the mean an interval has to be for the threshold.
    ///
    /// The normal distribution is approximated by the logistic function of a cubic polynomial (Bowling
    /// et al. 2009), within 0.0002 of it.
    pub(super) fn deviations(&self) -> f64 {
        let (mut low, mut high) = (0.0, 40.0);
        for _ in 0..60 {
            let middle = (low + high) / 2.0;
            if phi(middle) < self.threshold {
                low = middle;
            } else {
                high = middle;
            }
        }
        high
    }
}

/// How unlikely an interval is that lies this many standard deviations beyond the mean.
fn phi(deviations: f64) -> f64 {
    let cubic = deviations * (1.5976 + 0.070_566 * deviations * deviations);
    // log10(1 + e^x), which does not overflow for great x.
    let excess = cubic.max(0.0) + math::log(1.0 + math::exp(-cubic.abs()));
    excess / core::f64::consts::LN_10
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn phi_is_that_of_the_normal_distribution() {
        // Upper tails of the normal distribution, as tables have them.
        for (deviations, tail) in [(0.0, 0.5), (1.0, 0.158_655), (2.0, 0.022_750)] {
            let odds = math::pow(10.0, -phi(deviations));
            assert!((odds - tail).abs() < 2e-4, "{deviations}: {odds}");
        }
    }

    #[test]
    fn deviations_invert_phi() {
        for threshold in [0.5, 1.0, 3.0, 8.0, 12.0] {
            let options = Options {
                threshold,
                ..Options::default()
            };
            assert!((phi(options.deviations()) - threshold).abs() < 1e-9);
        }
    }
}
