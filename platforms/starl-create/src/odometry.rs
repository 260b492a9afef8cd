//! From what the wheels count to a motion in the robot's frame.

use crate::{Generation, METRES_PER_COUNT};
use starl_core::Point;
use starl_core::math::sincos;

/// Sums up the motion between two readings.
#[derive(Clone, Debug)]
pub(crate) struct Odometry {
    generation: Generation,
    wheel_distance: f64,
    counts: Option<[i32; 2]>,
    moved: Point,
    turned: f64,
}

impl Odometry {
    pub fn new(generation: Generation, wheel_distance: f64) -> Odometry {
        Odometry {
            generation,
            wheel_distance,
            counts: None,
            moved: Point::ZERO,
            turned: 0.0,
        }
    }

    /// Takes the two values of odometry of a frame: counts of the left and right wheel, or millimetres and degrees.
    pub fn take(&mut self, values: [i32; 2]) {
        let (distance, turn) = match self.generation {
            Generation::Create1 => {
                let [millimetres, degrees] = values.map(f64::from);
                (0.001 * millimetres, degrees.to_radians())
            }
            Generation::Create2 => {
                let before = self.counts.replace(values).unwrap_or(values);
                let [left, right] = [0, 1].map(|wheel| {
                    // The counters have 16 bits; the short way round is the one that was driven.
                    let counts = values[wheel].wrapping_sub(before[wheel]) as i16;
                    f64::from(counts) * METRES_PER_COUNT
                });
                (0.5 * (left + right), (right - left) / self.wheel_distance)
            }
        };
        let (sin, cos) = sincos(self.turned + 0.5 * turn);
        self.moved += Point::planar(distance * cos, distance * sin);
        self.turned += turn;
    }

    /// After a stream restarts, its counters may have restarted too: the motion in between is unknown.
    pub fn forget(&mut self) {
        self.counts = None;
    }

    /// The motion since the last call: metres ahead and left, radians to the left.
    pub fn reap(&mut self) -> (Point, f64) {
        let motion = (self.moved, self.turned);
        (self.moved, self.turned) = (Point::ZERO, 0.0);
        motion
    }
}
