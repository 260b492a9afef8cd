//! Cuts a step into parts in which the paths of bodies are nearly straight.

use crate::State;
use starl_core::{Duration, Point, math};

/// The straight lines along which bodies move are at most this far from their paths, metres.
const STRAIGHTNESS: f64 = 1e-3;

/// Parts are not made shorter than this.
const SHORTEST: Duration = Duration(10_000);

/// How far the path of a body in the floor plane is from the straight line to its predicted state, metres: exact for a
/// constant acceleration, and nearly so for an arc.
#[inline]
pub fn bend(from: Point, predicted: &State, seconds: f64) -> f64 {
    let (way, velocity) = (predicted.pose.position - from, predicted.twist.linear);
    let x = velocity.x * seconds - way.x;
    let y = velocity.y * seconds - way.y;
    0.25 * math::sqrt(x * x + y * y)
}

/// The present part of a step: the whole step at first. Times count from the start of the step.
#[derive(Clone, Copy, Debug)]
pub struct Parts {
    step: Duration,
    /// The start of the part.
    pub from: Duration,
    /// The end of the part.
    pub to: Duration,
}

impl Parts {
    /// A step of this length.
    pub fn of(step: Duration) -> Parts {
        Parts {
            step,
            from: Duration::ZERO,
            to: step,
        }
    }

    /// The length of the part.
    pub fn length(&self) -> Duration {
        self.to - self.from
    }

    /// Whether the part is short enough if a path in it bends by this, metres. If not, the part becomes shorter.
    pub fn suits(&mut self, bend: f64) -> bool {
        let length = self.length();
        if bend <= STRAIGHTNESS || length <= SHORTEST {
            return true;
        }
        // The line of a part is nearer to the path by the square of their number.
        let parts = math::sqrt(bend / STRAIGHTNESS).min(1e6) as u64 + 1;
        self.to = self.from + Duration(length.0 / parts).max(SHORTEST);
        false
    }

    /// Continues with the next part, of up to twice the length; false after the last one.
    pub fn proceed(&mut self) -> bool {
        let length = self.length();
        self.from = self.to;
        self.to = self.step.min(self.to + length * 2);
        self.from < self.step
    }
}
