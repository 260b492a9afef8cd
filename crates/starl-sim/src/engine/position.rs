//! The simulated positioning system: what robots learn of where they are.

use super::shared::Shared;
use super::{Stream, stream};
use starl_core::{Estimate, Point, Pose, RobotId, Time, Twist, math};
use starl_motion::State;

/// An estimate of a robot's state, taken at `at`, which is less than a step after the state. The
/// state is extrapolated to that time along its velocity. Noise is drawn for each estimate, and
/// never changes the state.
pub fn estimate(shared: &Shared, robot: RobotId, state: &State, from: Time, at: Time) -> Estimate {
    let late = at.since(from).seconds();
    let twist = state.twist;
    let pose = Pose {
        position: state.pose.position + twist.linear * late,
        yaw: math::wrap_angle(state.pose.yaw + twist.yaw * late),
        pitch: state.pose.pitch + twist.pitch * late,
        roll: state.pose.roll + twist.roll * late,
    };
    let system = &shared.scenario.positioning;
    if system.position_noise == 0.0 && system.heading_noise == 0.0 && system.velocity_noise == 0.0 {
        return Estimate { pose, twist, at };
    }
    let key = [u64::from(robot.0), at.0];
    let mut random = stream(shared.scenario.seed, Stream::Positioning, &key);
    let mut around = |value: f64, deviation: f64| random.normal(value, deviation);
    let mut point = |p: Point, deviation: f64, flat: bool| {
        let (x, y) = (around(p.x, deviation), around(p.y, deviation));
        Point::new(x, y, if flat { p.z } else { around(p.z, deviation) })
    };
    // A robot on the floor knows that it is there.
    let grounded = pose.position.z == 0.0 && twist.linear.z == 0.0;
    let position = point(pose.position, system.position_noise, grounded);
    let linear = point(twist.linear, system.velocity_noise, grounded);
    let yaw = math::wrap_angle(random.normal(pose.yaw, system.heading_noise));
    Estimate {
        pose: Pose {
            position,
            yaw,
            ..pose
        },
        twist: Twist { linear, ..twist },
        at,
    }
}
