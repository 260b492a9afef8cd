//! Tracking for the ideal robot: straight at the waypoint, slower with the distance left.

use super::arrival::{Tolerance, at_rest};
use super::{Goal, Tracking};
use starl_core::Command;
use starl_core::motion::Estimate;

const TOLERANCE: Tolerance = Tolerance {
    stop: 0.03,
    start: 0.05,
};

/// Part of the distance left that is covered before the next estimate, at most.
const PART_PER_ESTIMATE: f64 = 0.5;
/// Part of the distance left that is driven per second, at most.
const PART_PER_SECOND: f64 = 3.0;

/// See [`crate::Limits::stopping_distance`]: the way until the estimate that says stop.
pub(crate) fn stopping_distance(cruise_speed: f64) -> f64 {
    0.1 * cruise_speed + TOLERANCE.stop
}

/// One step of tracking at up to `cruise_speed` metres per second.
pub(crate) fn track(
    tracking: &mut Tracking,
    estimate: &Estimate,
    goal: &Goal,
    cruise_speed: f64,
) -> Command {
    let period = tracking.period(estimate);
    let position = estimate.pose.position;
    if goal.next.is_some() {
        tracking.rest = None;
    } else if at_rest(tracking, goal, position, TOLERANCE) {
        return Command::Stop;
    }
    let way = (goal.target - position).at_height(0.0);
    let distance = way.planar_length();
    if distance <= 0.0 {
        return Command::Stop;
    }
    let gain = PART_PER_SECOND.min(PART_PER_ESTIMATE / period);
    let speed = (gain * distance)
        .max(goal.through_speed(position, cruise_speed))
        .min(cruise_speed)
        .min(goal.speed_limit);
    Command::Velocity {
        velocity: way * (speed / distance),
        yaw_rate: 0.0,
    }
}
