//! A robot that spreads out: it drives straight while its surroundings are free and turns away from obstacles (the
//! diffusion controller of swarm robotics; Howard, Mataric and Sukhatme 2002 spread robots by the same sum of
//! repulsions).

use starl_core::math::{self, radians};
use starl_core::{Command, Primitives, Program, Robot};

/// Speed of the wheels that turn, metres per second.
const SPEED: f64 = 0.05;
/// Shorter averages count as nothing.
const NEGLIGIBLE: f64 = 0.1;
/// Averages within this angle of straight ahead, degrees, let the robot drive on.
const AHEAD: f64 = 7.5;

/// The program of one robot; it remembers nothing.
#[derive(Clone, Copy, Debug, Default, Primitives)]
pub struct Diffusion;

impl Program for Diffusion {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        let rays = robot.sensors().proximity;
        let (mut x, mut y) = (0.0, 0.0);
        // A ray that meets nothing adds nothing.
        for ray in rays.iter().filter(|ray| ray.nearness > 0.0) {
            let (sin, cos) = math::sincos(ray.bearing);
            x += ray.nearness * cos;
            y += ray.nearness * sin;
        }
        let count = rays.len().max(1) as f64;
        let (length, angle) = (math::sqrt(x * x + y * y) / count, math::atan2(y, x));
        let (left, right) = if length < NEGLIGIBLE && angle.abs() <= radians(AHEAD) {
            (SPEED, SPEED)
        } else if angle > 0.0 {
            (SPEED, 0.0)
        } else {
            (0.0, SPEED)
        };
        robot.drive(Command::Wheels { left, right });
    }
}
