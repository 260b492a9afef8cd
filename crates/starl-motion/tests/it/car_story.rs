//! The car differs from the others: it cannot turn on the spot.

use crate::conformance::{CALM, Positioning, Run};
use starl_core::math::{FRAC_PI_2, PI, TAU, tan};
use starl_core::{Command, Duration, Point, Pose};
use starl_motion::{Goal, Model, models};
use std::sync::Arc;

fn car() -> Arc<dyn Model> {
    models::by_name("car").unwrap()
}

#[test]
fn at_full_lock_it_drives_its_smallest_circle() {
    let car = car();
    let radius = car.limits().turn_radius;
    // The body's centre is half a wheelbase ahead of the rear axle, whose radius is L / tan(24 deg).
    let rear = 0.33 / tan(starl_core::math::radians(24.0));
    assert!((radius - (rear * rear + 0.165 * 0.165).sqrt()).abs() < 1e-12);
    let steer = Command::Steer {
        speed: 1.0,
        angle: 9.0,
    };
    let mut state = car.at_rest(Pose::level(Point::ZERO, 0.0));
    state = car.predict(&state, &steer, &CALM, Duration::from_seconds(2));
    let start = state.pose;
    let lap = Duration::from_seconds_f64(TAU * radius);
    let end = car.predict(&state, &steer, &CALM, lap).pose;
    assert!(
        (end.position - start.position).length() < 1e-6,
        "{start:?} {end:?}"
    );
    let half = car.predict(&state, &steer, &CALM, lap / 2).pose;
    assert!(((half.position - start.position).length() - 2.0 * radius).abs() < 1e-6);
}

#[test]
fn it_reaches_a_point_inside_its_turning_circle_by_backing_up() {
    let car = car();
    for (x, y) in [
        (0.1, 0.7),
        (0.0, -0.6),
        (0.2, 0.3),
        (-0.2, 0.6),
        (-0.1, -0.4),
    ] {
        let mut run = Run::new(&*car, Pose::level(Point::ZERO, 0.0), Positioning::EXACT, 1);
        let target = Point::planar(x, y);
        let (mut ahead, mut back) = (false, false);
        for _ in 0..400 {
            run.turn(&Goal::stop_at(target));
            ahead |= run.state.memory[0] > 0.1;
            back |= run.state.memory[0] < -0.1;
        }
        assert!(
            run.distance(target) < 0.06,
            "{target}: {}",
            run.distance(target)
        );
        assert!(ahead && back, "{target}: it shunts");
        assert!(run.state.twist.linear.length() < 1e-9, "it stands");
    }
}

#[test]
fn it_backs_up_to_a_point_close_behind_and_turns_round_for_a_far_one() {
    let car = car();
    let mut run = Run::new(&*car, Pose::level(Point::ZERO, 0.0), Positioning::EXACT, 1);
    for _ in 0..200 {
        run.turn(&Goal::stop_at(Point::planar(-1.0, 0.1)));
    }
    assert!(run.distance(Point::planar(-1.0, 0.1)) < 0.06);
    assert!(
        run.state.pose.yaw.abs() < FRAC_PI_2,
        "it has not turned round"
    );
    let far = Point::planar(-8.0, 0.0);
    for _ in 0..600 {
        run.turn(&Goal::stop_at(far));
    }
    assert!(run.distance(far) < 0.06);
    assert!(
        (run.state.pose.yaw.abs() - PI).abs() < 0.5,
        "it has turned round"
    );
}

#[test]
fn it_gathers_speed_and_brakes_within_its_acceleration() {
    let car = car();
    let mut state = car.at_rest(Pose::level(Point::ZERO, 0.0));
    let half_second = Duration::from_millis(200);
    state = car.predict(
        &state,
        &Command::Steer {
            speed: 9.0,
            angle: 0.0,
        },
        &CALM,
        half_second,
    );
    assert!(
        (state.twist.linear.x - 0.5).abs() < 1e-12,
        "2.5 m/s2 for 0.2 s"
    );
    assert!((state.pose.position.x - 0.05).abs() < 1e-12);
    state = car.predict(&state, &Command::Stop, &CALM, Duration::from_seconds(5));
    assert!(
        (state.pose.position.x - 0.1).abs() < 1e-12,
        "as far again while braking"
    );
    assert_eq!(state.twist.linear, Point::ZERO);
}
