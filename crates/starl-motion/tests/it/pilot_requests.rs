//! The pilot does what the program asked for last.

use crate::conformance::{CALM, every_model, place, start};
use starl_core::motion::{Estimate, PlanRequest, Planner};
use starl_core::{Command, Duration, MotionRequest, Point, Pose, Random, Time};
use starl_motion::{Model, Pilot, State, avoidance, models};

/// Lets a pilot steer a robot, alone, for some seconds.
fn steer(model: &dyn Model, pilot: &mut Pilot, state: &mut State, now: &mut Time, seconds: f64) {
    let mut random = Random::keyed(1, &[]);
    for _ in 0..(seconds * 20.0) as u32 {
        let estimate = Estimate {
            pose: state.pose,
            twist: state.twist,
            at: *now,
        };
        let command = pilot.command(model, &estimate, &[], &[], &mut random);
        *state = model.predict(state, &command, &CALM, Duration::from_millis(50));
        *now += Duration::from_millis(50);
    }
}

#[test]
fn it_tracks_halts_and_drives() {
    for model in every_model() {
        for avoidance in [None, Some(avoidance::Options::default())] {
            let model = &*model;
            let mut random = Random::keyed(2, &[]);
            let mut state = model.at_rest(start(model, &mut random));
            let mut now = Time::ZERO;
            let mut pilot = Pilot::new(model, avoidance);
            let at_first = state;
            steer(model, &mut pilot, &mut state, &mut now, 2.0);
            assert_eq!(
                state,
                at_first,
                "{}: nothing is asked for yet",
                model.name()
            );

            let target = place(model, &mut random, 1.0);
            pilot.request(&MotionRequest::Track { target, next: None });
            steer(model, &mut pilot, &mut state, &mut now, 60.0);
            let distance = state.pose.position.distance(target);
            assert!(distance < 0.1, "{}: {distance} m", model.name());

            let other = place(model, &mut random, 1.0);
            pilot.request(&MotionRequest::Track {
                target: other,
                next: None,
            });
            steer(model, &mut pilot, &mut state, &mut now, 4.0);
            pilot.request(&MotionRequest::Halt);
            steer(model, &mut pilot, &mut state, &mut now, 10.0);
            assert!(
                state.twist.linear.length() < 0.01,
                "{}: it halts",
                model.name()
            );
        }
    }
}

#[test]
fn an_unreachable_waypoint_is_moved_within_reach() {
    for (name, target) in [
        ("create", Point::new(1.0, 0.0, 3.0)),
        ("drone", Point::planar(1.0, 0.0)),
    ] {
        let model = &*models::by_name(name).unwrap();
        let mut state = model.at_rest(Pose::default());
        let mut pilot = Pilot::new(model, None);
        pilot.request(&MotionRequest::Track { target, next: None });
        steer(model, &mut pilot, &mut state, &mut Time(0), 30.0);
        let reachable = model.body().reachable(target);
        assert!(
            state.pose.position.distance(reachable) < 0.1,
            "{name}: {state:?}"
        );
    }
}

#[test]
fn commands_of_the_program_reach_the_model_as_they_are() {
    let model = &*models::by_name("create").unwrap();
    let mut pilot = Pilot::new(model, Some(avoidance::Options::default()));
    let estimate = Estimate::default();
    let command =
        |pilot: &mut Pilot| pilot.command(model, &estimate, &[], &[], &mut Random::keyed(1, &[]));
    let curve = Command::Curve {
        speed: 0.2,
        radius: 0.7,
    };
    pilot.request(&MotionRequest::Drive(curve));
    assert_eq!(command(&mut pilot), curve);
    assert_eq!(pilot.wants_neighbours(), None);
    // Not its own, or not a number.
    for refused in [Command::TakeOff, Command::Straight { speed: f64::NAN }] {
        pilot.request(&MotionRequest::Drive(refused));
        assert_eq!(command(&mut pilot), Command::Stop);
    }
}

#[test]
fn it_needs_neighbours_only_while_it_tracks_and_avoids() {
    for model in every_model() {
        let track = MotionRequest::Track {
            target: Point::planar(1.0, 0.0),
            next: None,
        };
        let mut bold = Pilot::new(&*model, None);
        let mut careful = Pilot::new(&*model, Some(avoidance::Options::default()));
        assert_eq!(careful.wants_neighbours(), None);
        bold.request(&track);
        careful.request(&track);
        assert_eq!(bold.wants_neighbours(), None);
        let sight = careful.wants_neighbours().expect("it avoids");
        assert!(
            sight > 2.0 * model.body().radius && sight.is_finite(),
            "{}",
            model.name()
        );
        careful.request(&MotionRequest::Halt);
        assert_eq!(careful.wants_neighbours(), None);
    }
}

#[test]
fn a_plan_request_does_not_change_the_motion() {
    let model = &*models::by_name("holonomic").unwrap();
    let mut pilot = Pilot::new(model, None);
    pilot.request(&MotionRequest::Track {
        target: Point::planar(1.0, 0.0),
        next: None,
    });
    pilot.request(&MotionRequest::Plan(PlanRequest {
        ticket: 1,
        target: Point::ZERO,
        vicinity: 0.1,
        unsafe_set: Vec::new().into(),
        around_robots: false,
        planner: Planner::Auto,
        most_nodes: 10,
        seed: 1,
    }));
    let estimate = Estimate::default();
    let command = pilot.command(model, &estimate, &[], &[], &mut Random::keyed(1, &[]));
    assert!(matches!(command, Command::Velocity { velocity, .. } if velocity.x > 0.0));
}

#[test]
fn a_waypoint_that_is_not_finite_stops_it() {
    for model in every_model() {
        let mut pilot = Pilot::new(&*model, Some(avoidance::Options::default()));
        for bad in [f64::NAN, f64::INFINITY] {
            pilot.request(&MotionRequest::Track {
                target: Point::planar(bad, 0.0),
                next: None,
            });
            let estimate = Estimate::default();
            let command = pilot.command(&*model, &estimate, &[], &[], &mut Random::keyed(1, &[]));
            assert_eq!(command, Command::Stop, "{}", model.name());
        }
    }
}
