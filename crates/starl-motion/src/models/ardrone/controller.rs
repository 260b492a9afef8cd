//! A substitute for the drone's own controller, which its maker has not published: references for its loops.
//!
//! The real one holds its place with a camera that looks down; here it holds a point, by proportional and derivative
//! action, which is equivalent to integrating its velocity, and leans into the wind to compensate its push.

use super::GRAVITY;
use super::dynamics::{Dynamics, Motion};
use super::mode;
use crate::Disturbance;
use starl_core::Command;
use starl_core::math::atan;

/// The references of the loops of attitude, yaw and climb.
#[derive(Clone, Copy, Debug)]
pub(super) struct References {
    /// Radians.
    pub pitch: f64,
    /// Radians.
    pub roll: f64,
    /// Radians per second.
    pub yaw_rate: f64,
    /// Metres per second.
    pub climb: f64,
}

/// Acceleration per distance from the point held, 1/s squared.
const PLACE_GAIN: f64 = 1.0;
/// Acceleration per speed while holding a place, 1/s.
const SPEED_GAIN: f64 = 1.8;
/// Climb per height left while taking off, times the time constant of the climb: a quarter is
/// critical damping.
const HEIGHT_GAIN: f64 = 0.25;

impl Dynamics {
    /// The references under `command` in `mode`, in this motion, when holding the place `anchor`.
    #[inline]
    pub(super) fn references(
        &self,
        mode: u32,
        command: &Command,
        anchor: [f64; 2],
        motion: &Motion,
        (sin_yaw, cos_yaw): (f64, f64),
        disturbance: &Disturbance,
    ) -> References {
        let drive = 1.0 + disturbance.speed_error;
        if let (
            mode::FLYING,
            &Command::Attitude {
                yaw_rate,
                pitch,
                roll,
                gaz,
            },
        ) = (mode, command)
        {
            let (pitch, roll) = self.in_disc(pitch * drive, roll * drive);
            let yaw_rate = yaw_rate * (1.0 + disturbance.turn_error);
            let yaw_rate = yaw_rate.clamp(-self.yaw_rate, self.yaw_rate);
            return References {
                pitch,
                roll,
                yaw_rate,
                climb: (gaz * drive).clamp(-self.climb, self.climb),
            };
        }
        let air = [disturbance.wind.x, disturbance.wind.y];
        let [x, y] = [0, 1].map(|axis| {
            let error = anchor[axis] - motion.position[axis];
            let wind = self.drag * air[axis];
            (PLACE_GAIN * error - SPEED_GAIN * motion.velocity[axis] - wind) / GRAVITY
        });
        let (ahead, aside) = (cos_yaw * x + sin_yaw * y, sin_yaw * x - cos_yaw * y);
        let (pitch, roll) = self.in_disc(atan(ahead) * drive, atan(aside) * drive);
        let climb = match mode {
            mode::TAKING_OFF => {
                let left = self.safe_height - motion.position[2];
                (HEIGHT_GAIN / self.climb_time * left * drive).clamp(-self.climb, self.climb)
            }
            mode::LANDING => (-self.landing_speed * drive).clamp(-self.climb, self.climb),
            _ => 0.0,
        };
        References {
            pitch,
            roll,
            yaw_rate: 0.0,
            climb,
        }
    }

    /// Pitch and roll, scaled down together where they tilt the drone too far.
    fn in_disc(&self, pitch: f64, roll: f64) -> (f64, f64) {
        // Clamped first, so that squares of huge numbers do not overflow.
        let (pitch, roll) = (pitch.clamp(-9.0, 9.0), roll.clamp(-9.0, 9.0));
        let squared = pitch * pitch + roll * roll;
        if squared <= self.tilt * self.tilt {
            return (pitch, roll);
        }
        let scale = self.tilt / starl_core::math::sqrt(squared);
        (pitch * scale, roll * scale)
    }
}
