//! The seeds of a sweep: every combination runs with each, so that combinations can be compared seed by seed.

use crate::Error;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// Consecutive seeds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Seeds {
    first: u64,
    count: u64,
}

/// Scenarios hold seeds as signed numbers.
const LARGEST: u64 = i64::MAX as u64;

impl Seeds {
    /// The seeds from `first` to `last`, both included; none if the range is empty, or has a seed beyond those of
    /// scenarios.
    pub fn between(first: u64, last: u64) -> Option<Seeds> {
        let count = last.checked_sub(first)?.checked_add(1)?;
        (last <= LARGEST).then_some(Seeds { first, count })
    }

    /// The first seed.
    pub fn first(self) -> u64 {
        self.first
    }

    /// The last seed.
    pub fn last(self) -> u64 {
        self.first + (self.count - 1)
    }

    /// How many there are, at least one.
    pub fn count(self) -> u64 {
        self.count
    }
}

impl FromStr for Seeds {
    type Err = Error;

    /// `100` for the seeds 1 to 100, or `FIRST..LAST`, both included.
    fn from_str(text: &str) -> Result<Seeds, Error> {
        let whole = |text: &str| text.trim().parse::<u64>().ok();
        let seeds = match text.split_once("..") {
            Some((first, last)) => whole(first)
                .zip(whole(last))
                .and_then(|(first, last)| Seeds::between(first, last)),
            None => whole(text).and_then(|count| Seeds::between(1, count)),
        };
        seeds.ok_or_else(|| {
            let help =
                "give their number, such as 100, or the first and the last one, such as 101..200";
            Error::option(&format!("--seeds {text}"), "these are not seeds", help)
        })
    }
}

impl fmt::Display for Seeds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}..{}", self.first, self.last())
    }
}
