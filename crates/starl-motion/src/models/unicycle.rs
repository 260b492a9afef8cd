//! The kinematics that wheeled robots share: a body that moves along its own axis and turns.
//!
//! Between two commands speed and rate of turn are constant, so the path is an arc of a circle and is
//! integrated exactly, by its chord, for any step. Table 4.2 of the thesis gives the same equations in
//! differential form: x' = v cos(yaw), y' = v sin(yaw), yaw' = rate.

use crate::{Disturbance, State};
use starl_core::math;
use starl_core::{Point, Pose, Twist};

/// Below this half angle, radians, the series of [`half_arc`] are as exact as `f64`.
const SERIES: f64 = 0.5;

/// sin(h)/h and cos(h).
#[inline]
fn half_arc(half: f64) -> (f64, f64) {
    if math::fabs(half) < SERIES {
        // Taylor series in q = h squared; the first term left out is below 1e-16.
        let q = half * half;
        let sinc = 1.0
            - q / 6.0 * (1.0 - q / 20.0 * (1.0 - q / 42.0 * (1.0 - q / 72.0 * (1.0 - q / 110.0))));
        let cosine = 1.0
            - q / 2.0
                * (1.0
                    - q / 12.0
                        * (1.0
                            - q / 30.0 * (1.0 - q / 56.0 * (1.0 - q / 90.0 * (1.0 - q / 132.0)))));
        return (sinc, cosine);
    }
    let (sin, cos) = math::sincos(half);
    (sin / half, cos)
}

/// The state of a body at `pose` after `seconds` at constant speed (metres per second) along an axis
/// that is `offset` radians from its heading, and at constant rate of turn (radians per second).
#[inline]
pub(super) fn advance(
    pose: &Pose,
    offset: f64,
    speed: f64,
    rate: f64,
    seconds: f64,
) -> (Pose, Twist) {
    let turned = rate * seconds;
    let yaw = math::wrap_angle(pose.yaw + turned);
    if speed == 0.0 {
        // Turning on the spot, and standing, need no trigonometry.
        return (
            Pose { yaw, ..*pose },
            Twist {
                yaw: rate,
                ..Twist::default()
            },
        );
    }
    let half = 0.5 * turned;
    let (sinc, cos_half) = half_arc(half);
    // The chord points half the turn beyond the heading, the last velocity as much again.
    let (sin, cos) = math::sincos(pose.yaw + offset + half);
    let chord = speed * seconds * sinc;
    let sin_half = half * sinc;
    let position = Point {
        x: pose.position.x + chord * cos,
        y: pose.position.y + chord * sin,
        z: pose.position.z,
    };
    let linear = Point::planar(
        speed * (cos * cos_half - sin * sin_half),
        speed * (sin * cos_half + cos * sin_half),
    );
    (
        Pose {
            position,
            yaw,
            ..*pose
        },
        Twist {
            linear,
            yaw: rate,
            ..Twist::default()
        },
    )
}

/// The state of a robot on wheels after driving so: see [`advance`].
#[inline]
pub(super) fn drive(state: &State, speed: f64, rate: f64, seconds: f64) -> State {
    let (pose, twist) = advance(&state.pose, 0.0, speed, rate, seconds);
    State {
        pose,
        twist,
        ..*state
    }
}

/// Speed and rate of turn under a disturbance; where a wheel's rim would exceed `wheel_speed`, metres per
/// second, both are scaled down alike, which keeps the path's radius.
#[inline]
pub(super) fn disturbed(
    (speed, rate): (f64, f64),
    disturbance: &Disturbance,
    wheel_speed: f64,
    wheel_distance: f64,
) -> (f64, f64) {
    if disturbance.speed_error == 0.0 && disturbance.turn_error == 0.0 {
        return (speed, rate);
    }
    let speed = speed * (1.0 + disturbance.speed_error);
    let rate = rate * (1.0 + disturbance.turn_error);
    let fastest = math::fabs(speed) + 0.5 * wheel_distance * math::fabs(rate);
    if fastest <= wheel_speed {
        return (speed, rate);
    }
    let scale = wheel_speed / fastest;
    (speed * scale, rate * scale)
}

/// Speed and rate of turn of a body on two wheels whose rims move at `left` and `right` metres per
/// second, `wheel_distance` metres apart.
#[inline]
pub(super) fn of_wheels(left: f64, right: f64, wheel_distance: f64) -> (f64, f64) {
    (0.5 * (left + right), (right - left) / wheel_distance)
}
