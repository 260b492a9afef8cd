//! The iRobot Create's commands (thesis, table 4.1) take effect, within the limits of its wheels.

use crate::conformance::{CALM, Positioning, Run};
use starl_core::math::{PI, TAU, radians};
use starl_core::{Command, Duration, Point, Pose};
use starl_motion::{Goal, models};

fn drive(command: Command, seconds: f64) -> starl_motion::State {
    let create = models::by_name("create").unwrap();
    let state = create.at_rest(Pose::level(Point::ZERO, 0.0));
    create.predict(&state, &command, &CALM, Duration::from_seconds_f64(seconds))
}

fn close(a: Point, b: Point) -> bool {
    a.distance(b) < 1e-9
}

#[test]
fn straight_turn_and_curve() {
    let pose = drive(Command::Straight { speed: 0.3 }, 10.0).pose;
    assert!(close(pose.position, Point::planar(3.0, 0.0)));
    let pose = drive(Command::Turn { rate: 0.5 }, 2.0).pose;
    assert!(close(pose.position, Point::ZERO) && (pose.yaw - 1.0).abs() < 1e-12);
    // Half a circle to the left, a whole one to the right, a quarter backwards.
    let half = PI * 0.7 / 0.2;
    let pose = drive(
        Command::Curve {
            speed: 0.2,
            radius: 0.7,
        },
        half,
    )
    .pose;
    assert!(close(pose.position, Point::planar(0.0, 1.4)), "{pose:?}");
    let pose = drive(
        Command::Curve {
            speed: 0.2,
            radius: -0.7,
        },
        2.0 * half,
    )
    .pose;
    assert!(close(pose.position, Point::ZERO), "{pose:?}");
    let pose = drive(
        Command::Curve {
            speed: -0.2,
            radius: 0.7,
        },
        0.5 * half,
    )
    .pose;
    assert!(close(pose.position, Point::planar(-0.7, 0.7)), "{pose:?}");
    assert!((pose.yaw + 0.25 * TAU).abs() < 1e-9);
}

#[test]
fn a_curve_that_is_too_fast_keeps_its_radius() {
    let state = drive(
        Command::Curve {
            speed: 2.0,
            radius: 0.2,
        },
        0.1,
    );
    let speed = state.twist.linear.length();
    assert!((speed / state.twist.yaw - 0.2).abs() < 1e-12);
    // The outer wheel runs at its limit.
    assert!((speed + 0.129 * state.twist.yaw - 0.5).abs() < 1e-12);
}

#[test]
fn wheels_and_the_other_commands_agree() {
    let wheels = drive(
        Command::Wheels {
            left: 0.1,
            right: 0.3,
        },
        3.0,
    )
    .pose;
    let curve = drive(
        Command::Curve {
            speed: 0.2,
            radius: 0.258,
        },
        3.0,
    )
    .pose;
    assert!(close(wheels.position, curve.position) && (wheels.yaw - curve.yaw).abs() < 1e-9);
}

#[test]
fn it_turns_first_then_drives_and_slows_down_near_its_waypoint() {
    let create = models::by_name("create").unwrap();
    let mut run = Run::new(
        &*create,
        Pose::level(Point::ZERO, PI),
        Positioning::EXACT,
        1,
    );
    let goal = Goal::stop_at(Point::planar(3.0, 0.0));
    let mut speeds = Vec::new();
    for _ in 0..600 {
        let command = run.turn(&goal);
        if run.now.seconds() < 2.0 {
            assert_eq!(
                command,
                Command::Turn {
                    rate: radians(-50.0)
                }
                .with_sign_of(&command)
            );
        }
        let near = run.distance(goal.target) < 0.65;
        speeds.push((near, run.state.twist.linear.length()));
    }
    let fastest = |near: bool| {
        let of = speeds
            .iter()
            .filter(|(n, _)| *n == near)
            .map(|(_, speed)| *speed);
        of.fold(0.0, f64::max)
    };
    assert!((fastest(false) - 0.25).abs() < 1e-9 && (fastest(true) - 0.175).abs() < 1e-9);
}

trait WithSign {
    fn with_sign_of(self, other: &Command) -> Command;
}

impl WithSign for Command {
    /// A turn in the direction of another: a point right behind may be turned to either way.
    fn with_sign_of(self, other: &Command) -> Command {
        match (self, other) {
            (Command::Turn { rate }, Command::Turn { rate: like }) => Command::Turn {
                rate: rate.abs() * like.signum(),
            },
            (command, _) => command,
        }
    }
}
