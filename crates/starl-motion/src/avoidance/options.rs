//! The options of avoidance, with units and defaults.

use serde::{Deserialize, Serialize};

/// Tunables of [`super::Avoidance`]. The defaults suit robots of up to half a metre in radius that
/// are located to about a centimetre, twenty times a second.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Options {
    /// Room that each robot keeps on its side of the border between two bodies, metres; default
    /// 0.03. Two bodies stay apart as long as the error of each estimated gap is below twice this.
    pub margin: f64,
    /// Longest time between two position estimates, seconds; default 0.05. If estimates are less frequent, the longest
    /// time between two of them is used, and decays slowly. A longer gap than any before cannot be foreseen: if such
    /// gaps may occur, set the longest one here.
    pub period: f64,
    /// Radius of the largest robot that may be met, metres; default 0.5. It only sets how far away
    /// neighbours are asked for.
    pub largest_radius: f64,
    /// Free height, metres, at which robots above one another need not avoid each other in the
    /// plane; default 0.1.
    pub vertical_clearance: f64,
    /// Time without progress, while a neighbour is in the way, after which a robot may yield,
    /// seconds; default 0.8.
    pub patience: f64,
    /// Longest time a robot yields before it tries again, seconds; default 6.
    pub longest_yield: f64,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            margin: 0.03,
            period: 0.05,
            largest_radius: 0.5,
            vertical_clearance: 0.1,
            patience: 0.8,
            longest_yield: 6.0,
        }
    }
}

impl Options {
    /// Whether all numbers are finite and in their range.
    pub fn is_valid(&self) -> bool {
        let positive = |x: f64| x.is_finite() && x > 0.0;
        let not_negative = |x: f64| x.is_finite() && x >= 0.0;
        not_negative(self.margin)
            && positive(self.period)
            && not_negative(self.largest_radius)
            && not_negative(self.vertical_clearance)
            && positive(self.patience)
            && positive(self.longest_yield)
    }
}
