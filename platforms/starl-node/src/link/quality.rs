//! How well a robot hears another: losses, delays, and how far their clocks are apart.

use super::beacon::Beacon;
use serde::{Deserialize, Serialize};
use starl_core::{Duration, Time};

/// The measured quality of a link, from the other robot to this one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Quality {
    /// When the other was heard last, by this robot's clock; none if never.
    pub heard: Option<Time>,
    /// The part of recent beacons that did not arrive, 0 to 1.
    pub loss: f64,
    /// The latest time there and back, seconds, without the time that the other took to answer.
    pub round_trip: Option<f64>,
    /// How far the other's clock is ahead of this one, seconds; as exact as half of `best`.
    pub offset: Option<f64>,
    /// The shortest recent round-trip time in seconds, at which `offset` was measured.
    pub best: f64,
    /// The number of the next beacon.
    expected: u32,
}

/// How much of the measured loss is the latest beacon's.
const WEIGHT: f64 = 0.05;

impl Quality {
    /// Whether a beacon that arrives at `now` is the first of its robot, or the first after a restart or a silence so long.
    pub fn is_back(&self, now: Time, silence: Duration, beacon: &Beacon) -> bool {
        let is_silent = |heard| now.since(heard) > silence;
        beacon.number < self.expected || self.heard.is_none_or(is_silent)
    }

    /// Adds a beacon of the other robot that arrived at `now`.
    pub fn take(&mut self, now: Time, beacon: &Beacon) {
        let missed = match self.heard {
            // It has restarted, or this one is late.
            Some(_) if beacon.number >= self.expected => beacon.number - self.expected,
            _ => 0,
        };
        for _ in 0..missed.min(100) {
            self.loss += WEIGHT * (1.0 - self.loss);
        }
        self.loss -= WEIGHT * self.loss;
        self.expected = beacon.number.wrapping_add(1);
        self.heard = Some(now);
        if let Some((sent, arrived)) = beacon.echo {
            self.measure(sent, arrived, beacon.sent, now);
        }
    }

    /// Four times as of the Network Time Protocol (RFC 5905): this end sent, the other received, the other sent, this
    /// end received.
    fn measure(&mut self, sent: Time, arrived: Time, answered: Time, now: Time) {
        let [sent, arrived, answered, now] =
            [sent, arrived, answered, now].map(|t| t.0 as f64 * 1e-9);
        let round_trip = ((now - sent) - (answered - arrived)).max(0.0);
        self.round_trip = Some(round_trip);
        // A quick exchange says most; an old one counts for less and less, as clocks drift.
        self.best *= 1.01;
        if self.offset.is_none() || round_trip <= self.best {
            self.best = round_trip;
            self.offset = Some(((arrived - sent) + (answered - now)) / 2.0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(ms: u64) -> Time {
        Time::ZERO + Duration::from_millis(ms)
    }

    #[test]
    fn clocks_that_differ_are_measured() {
        let mut quality = Quality::default();
        for round in 0..50u64 {
            // The other is 5 s ahead; 2 ms there, 3 ms back, sometimes 40 ms more.
            let late = if round % 3 == 0 { 40 } else { 0 };
            let sent = 100 * round;
            let arrived = sent + 2 + 5000;
            let beacon = Beacon {
                number: round as u32,
                sent: at(arrived + 50),
                echo: Some((at(sent), at(arrived))),
                ..Beacon::default()
            };
            quality.take(at(sent + 2 + 50 + 3 + late), &beacon);
        }
        assert!(
            (quality.offset.unwrap() - 5.0).abs() < 0.0026,
            "{quality:?}"
        );
        assert!((quality.best - 0.005).abs() < 0.0001, "{quality:?}");
        assert_eq!(quality.loss, 0.0);
    }

    #[test]
    fn lost_beacons_are_counted() {
        let mut quality = Quality::default();
        for number in (0..400).filter(|number| number % 4 != 0) {
            let beacon = Beacon {
                number,
                ..Beacon::default()
            };
            quality.take(at(100), &beacon);
        }
        assert!((quality.loss - 0.25).abs() < 0.1, "{quality:?}");
    }
}
