//! Where robots are and how they move, in rows of numbers.

use starl_core::{Pose, RobotId};
use starl_sim::Simulation;

/// The numbers of a row of poses: x, y, z, and the orientation as a quaternion x, y, z, w.
const POSE: usize = 7;
/// The numbers of a row of velocities: the velocity, and the rates of roll, pitch and yaw.
const VELOCITY: usize = 6;

/// Arrays with a row for each robot.
pub struct Arrays<'a> {
    pub poses: &'a mut [f64],
    pub estimates: &'a mut [f64],
    pub velocities: &'a mut [f64],
}

impl Arrays<'_> {
    /// Fills the rows; false if there are more or fewer rows than robots.
    pub fn fill(self, simulation: &Simulation) -> bool {
        let robots = simulation.robots();
        let fits = |numbers: &[f64], row: usize| numbers.len() == robots.len() * row;
        let fit =
            fits(self.poses, POSE) && fits(self.estimates, POSE) && fits(self.velocities, VELOCITY);
        if !fit {
            return false;
        }
        let poses = self.poses.as_chunks_mut().0;
        let estimates = self.estimates.as_chunks_mut().0;
        let velocities = self.velocities.as_chunks_mut().0;
        let rows = poses.iter_mut().zip(estimates).zip(velocities);
        for (&robot, ((pose, estimate), velocity)) in robots.iter().zip(rows) {
            *pose = row(&simulation.state(robot).pose);
            *estimate = row(&simulation.estimate(robot).pose);
            *velocity = velocity_of(simulation, robot);
        }
        true
    }
}

/// Position and orientation of a pose: yaw about z, then pitch about the turned y, then roll about the turned x.
fn row(pose: &Pose) -> [f64; POSE] {
    let half = |angle: f64| {
        (
            starl_core::math::sin(angle / 2.0),
            starl_core::math::cos(angle / 2.0),
        )
    };
    let (sr, cr) = half(pose.roll);
    let (sp, cp) = half(pose.pitch);
    let (sy, cy) = half(pose.yaw);
    [
        pose.position.x,
        pose.position.y,
        pose.position.z,
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    ]
}

fn velocity_of(simulation: &Simulation, robot: RobotId) -> [f64; VELOCITY] {
    let twist = simulation.state(robot).twist;
    let linear = twist.linear;
    [
        linear.x,
        linear.y,
        linear.z,
        twist.roll,
        twist.pitch,
        twist.yaw,
    ]
}
