//! The quadcopter differs from the others (thesis, section 2.2): it takes off before it travels,
//! flies faster than the ground robots, and overshoots more.

use crate::conformance::{CALM, Positioning, Run, every_model};
use starl_core::math::{FRAC_PI_2, radians, sin, tan};
use starl_core::{Command, Duration, Point, Pose, Time};
use starl_motion::{Disturbance, Goal, Model, State, models};

const STEP: Duration = Duration::from_millis(20);
const ORIGIN: Pose = Pose::level(Point::ZERO, 0.0);

fn fly(model: &dyn Model, mut state: State, command: Command, seconds: f64) -> State {
    for _ in 0..(seconds / STEP.seconds()) as u32 {
        state = model.predict(&state, &command, &CALM, STEP);
    }
    state
}

fn drone() -> std::sync::Arc<dyn Model> {
    models::by_name("drone").unwrap()
}

#[test]
fn it_takes_off_before_it_travels() {
    let drone = drone();
    let mut run = Run::new(&*drone, ORIGIN, Positioning::EXACT, 1);
    assert_eq!(run.state.mode, models::drone_mode::LANDED);
    let target = Point::new(3.0, 2.0, 1.0);
    let mut rose_at = None;
    for _ in 0..400 {
        run.turn(&Goal::stop_at(target));
        let position = run.state.pose.position;
        if position.z < 0.4 && rose_at.is_none() {
            assert!(position.planar_length() < 0.02, "travels at {position}");
        } else {
            rose_at = rose_at.or(Some(run.now));
        }
    }
    assert!(
        rose_at.is_some_and(|at| at < Time(4_000_000_000)),
        "{rose_at:?}"
    );
    assert!(run.distance(target) < 0.1);
}

/// How far a robot goes past the place where, at its speed of travel, it receives the command to go back.
fn overshoot(model: &dyn Model) -> f64 {
    let mut run = Run::new(model, ORIGIN, Positioning::EXACT, 1);
    let [there, back] = [10.0, -10.0].map(|x| model.body().reachable(Point::planar(x, 0.0)));
    while run.state.pose.position.x < 4.0 {
        run.turn(&Goal {
            next: Some(back),
            ..Goal::stop_at(there)
        });
    }
    let turned_at = run.state.pose.position.x;
    let mut farthest = turned_at;
    for _ in 0..200 {
        run.turn(&Goal::stop_at(back));
        farthest = farthest.max(run.state.pose.position.x);
    }
    farthest - turned_at
}

#[test]
fn it_overshoots_more_than_the_create() {
    let [drone, create] = [drone(), models::by_name("create").unwrap()].map(|m| overshoot(&*m));
    assert!(create < 0.05, "{create}");
    assert!(drone > 0.3, "{drone}");
}

#[test]
fn it_is_faster_than_the_create() {
    let seconds = ["drone", "create"].map(|name| {
        let model = models::by_name(name).unwrap();
        let mut run = Run::new(&*model, ORIGIN, Positioning::EXACT, 1);
        let target = model.body().reachable(Point::planar(5.0, 0.0));
        while run.distance(target) > 0.1 {
            run.turn(&Goal::stop_at(target));
        }
        run.now.seconds()
    });
    assert!(seconds[0] < 0.6 * seconds[1], "{seconds:?}");
}

#[test]
fn on_the_floor_only_take_off_does_anything() {
    let drone = drone();
    let landed = drone.at_rest(ORIGIN);
    let tilted = Command::Attitude {
        yaw_rate: 1.0,
        pitch: 0.2,
        roll: 0.1,
        gaz: 1.0,
    };
    for command in [tilted, Command::Hover, Command::Stop, Command::Land] {
        assert_eq!(fly(&*drone, landed, command, 2.0), landed, "{command:?}");
    }
    let risen = fly(&*drone, landed, Command::TakeOff, 6.0);
    assert_eq!(risen.mode, models::drone_mode::HOVERING);
    assert!((risen.pose.position.z - 0.5).abs() < 0.02, "{risen:?}");
}

#[test]
fn stop_aborts_a_take_off_and_hovers_there() {
    let drone = drone();
    let rising = fly(&*drone, drone.at_rest(ORIGIN), Command::TakeOff, 0.5);
    let stopped = fly(&*drone, rising, Command::Stop, 2.0);
    assert_eq!(stopped.mode, models::drone_mode::HOVERING);
    assert!(stopped.pose.position.z < 0.45, "{stopped:?}");
    assert!(stopped.twist.linear.length() < 1e-2);
}

#[test]
fn it_lands_level_and_stays() {
    let drone = drone();
    let up = drone.at_rest(Pose::level(Point::new(1.0, 2.0, 2.0), 0.7));
    let moving = fly(&*drone, up, pitch(0.2), 1.0);
    let down = fly(&*drone, moving, Command::Land, 8.0);
    assert_eq!(down.mode, models::drone_mode::LANDED);
    assert_eq!(down.pose.position.z, 0.0);
    assert_eq!((down.pose.pitch, down.pose.roll), (0.0, 0.0));
    assert_eq!(down.twist, starl_core::Twist::default());
}

fn pitch(pitch: f64) -> Command {
    Command::Attitude {
        yaw_rate: 0.0,
        pitch,
        roll: 0.0,
        gaz: 0.0,
    }
}

/// The direction of the acceleration turns with the yaw, and rolling right moves to the right: signs
/// that the thesis's table 4.2 has wrong in one place.
#[test]
fn nose_down_accelerates_ahead_at_any_yaw() {
    let drone = drone();
    for yaw in [0.0, 1.0, FRAC_PI_2, 3.0, -2.0] {
        let start = drone.at_rest(Pose::level(Point::new(0.0, 0.0, 5.0), yaw));
        let ahead = fly(&*drone, start, pitch(0.1), 1.0).twist.linear;
        assert!(
            starl_core::math::wrap_angle(ahead.heading() - yaw).abs() < 1e-3,
            "{ahead}"
        );
        assert!(ahead.planar_length() > 0.3);
        let roll = Command::Attitude {
            yaw_rate: 0.0,
            pitch: 0.0,
            roll: 0.1,
            gaz: 0.0,
        };
        let right = fly(&*drone, start, roll, 1.0).twist.linear;
        let off = starl_core::math::wrap_angle(right.heading() - (yaw - FRAC_PI_2));
        assert!(off.abs() < 1e-3, "{right}");
    }
}

#[test]
fn drag_and_tilt_balance_at_the_top_speed() {
    let drone = drone();
    let start = drone.at_rest(Pose::level(Point::new(0.0, 0.0, 5.0), 0.0));
    let fast = fly(&*drone, start, pitch(1.0), 20.0);
    let expected = tan(radians(20.0)) * 9.80665 * 0.42 / 0.3;
    assert!((fast.twist.linear.x - expected).abs() < 1e-3, "{fast:?}");
    assert!(
        (fast.twist.linear.x - 5.0).abs() < 0.01,
        "the maker's 18 km/h"
    );
    assert!(
        (fast.pose.position.z - 5.0).abs() < 1e-6,
        "it keeps its height"
    );
}

#[test]
fn it_holds_its_place_and_its_waypoint_in_wind() {
    let drone = drone();
    let wind = Disturbance {
        wind: Point::planar(1.5, -1.0),
        ..CALM
    };
    // Hovering by itself: it leans into the wind.
    let mut state = drone.at_rest(Pose::level(Point::new(0.0, 0.0, 2.0), 0.0));
    for _ in 0..1000 {
        state = drone.predict(&state, &Command::Hover, &wind, STEP);
    }
    assert!(state.twist.linear.length() < 1e-3, "{state:?}");
    let blown = state.pose.position.planar_length();
    assert!(blown < 0.02, "{state:?}");
    // Tracking.
    let mut run = Run::new(&*drone, state.pose, Positioning::EXACT, 1);
    run.disturbance = wind;
    let target = Point::new(0.0, 0.0, 1.0);
    for _ in 0..400 {
        run.turn(&Goal::stop_at(target));
    }
    assert!(run.distance(target) < 0.03, "{}", run.distance(target));
    // Gusts, as in the original's simulator.
    let mut farthest: f64 = 0.0;
    for i in 0..1200 {
        let gust = sin(0.05 * f64::from(i) * 0.5);
        run.disturbance = Disturbance {
            wind: Point::planar(gust, 0.0),
            ..CALM
        };
        run.turn(&Goal::stop_at(target));
        farthest = if i > 400 {
            farthest.max(run.distance(target))
        } else {
            farthest
        };
    }
    assert!(farthest < 0.2, "{farthest}");
}

#[test]
fn wind_does_not_move_a_drone_on_the_ground() {
    let wind = Disturbance {
        wind: Point::planar(5.0, 5.0),
        ..CALM
    };
    for model in every_model() {
        let rest = model.at_rest(ORIGIN);
        assert_eq!(
            model.predict(&rest, &Command::Stop, &wind, STEP),
            rest,
            "{}",
            model.name()
        );
    }
}

#[test]
fn a_low_waypoint_does_not_make_it_take_off() {
    let drone = drone();
    let mut run = Run::new(&*drone, ORIGIN, Positioning::EXACT, 1);
    for _ in 0..20 {
        assert_eq!(
            run.turn(&Goal::stop_at(Point::planar(1.0, 0.0))),
            Command::Stop
        );
    }
}
