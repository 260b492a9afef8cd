//! A robot's true positions from its pose records, and their uncertainty.

use crate::Setting;
use starl_core::{Duration, Point, Time};
use std::collections::VecDeque;

/// Standard deviations of positioning noise that are put down to chance. One estimate in ten million
/// is farther off.
pub(super) const DEVIATIONS: f64 = 6.0;

/// No body here speeds up faster than a falling one, metres per second squared.
const FASTEST_ACCELERATION: f64 = 9.81;

/// A true position on record.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    pub at: Time,
    pub position: Point,
    /// Metres to the samples before and after it, the greater of the two.
    pub leg: f64,
}

/// The latest true positions of a robot, oldest first.
#[derive(Clone, Debug, Default)]
pub(super) struct Track {
    samples: VecDeque<Sample>,
}

impl Track {
    /// Adds the next position; one that is not finite is left out.
    pub fn push(&mut self, at: Time, position: Point) {
        if !position.is_finite() {
            return;
        }
        let mut leg = 0.0;
        if let Some(last) = self.samples.back_mut() {
            leg = last.position.distance(position);
            last.leg = last.leg.max(leg);
        }
        self.samples.push_back(Sample { at, position, leg });
    }

    /// Drops samples that are not needed for positions from `since` on.
    pub fn forget_before(&mut self, since: Time) {
        while self.samples.get(1).is_some_and(|next| next.at <= since) {
            self.samples.pop_front();
        }
    }

    /// Where the robot was from `since` until `until`, latest first: the samples of that time, and
    /// the one before it.
    pub fn between(&self, since: Time, until: Time) -> impl Iterator<Item = &Sample> {
        let start = self.samples.partition_point(|sample| sample.at <= since);
        let end = self.samples.partition_point(|sample| sample.at <= until);
        let start = start.saturating_sub(1).min(end);
        self.samples.range(start..end).rev()
    }
}

/// The greatest distance between the last sample and the position on which a primitive acts: the robot has moved since,
/// and uses the estimates of the positioning system.
///
/// It holds if the robot accelerates no faster than a falling body and the noise stays within six standard deviations.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tolerance {
    /// Whatever the robot does, metres.
    fixed: f64,
    /// On top of it, per metre of the sample's leg.
    per_leg: f64,
}

impl Tolerance {
    /// For estimates that are acted on when they are up to `age` old.
    pub fn new(setting: &Setting, age: Duration) -> Tolerance {
        let period = setting.pose_period.max(setting.step);
        let window = (period + age).seconds();
        Tolerance {
            fixed: 0.5 * FASTEST_ACCELERATION * window * window
                + DEVIATIONS * setting.position_noise,
            per_leg: if period.is_zero() {
                1.0
            } else {
                window / period.seconds()
            },
        }
    }

    /// Metres from this sample.
    pub fn around(&self, sample: &Sample) -> f64 {
        self.fixed + self.per_leg * sample.leg
    }
}
