//! Commands are exclusive, those a model does not take stop it, and nothing makes it lose its numbers.

use crate::conformance::{CALM, any_command, command_for, every_model, place};
use starl_core::{Command, Duration, Point, Pose, Random};
use starl_motion::{Disturbance, Model, State};

const STEP: Duration = Duration::from_millis(50);

/// A state in the middle of some motion.
fn moving(model: &dyn Model, random: &mut Random) -> State {
    let mut state = model.at_rest(Pose::level(
        place(model, random, 5.0),
        random.between(-3.0, 3.0),
    ));
    for _ in 0..20 {
        let command = command_for(model, random);
        for _ in 0..5 {
            state = model.predict(&state, &command, &CALM, STEP);
        }
    }
    state
}

fn is_finite(state: &State) -> bool {
    let State {
        pose,
        twist,
        memory,
        ..
    } = state;
    let angles = [
        pose.yaw,
        pose.pitch,
        pose.roll,
        twist.yaw,
        twist.pitch,
        twist.roll,
    ];
    pose.position.is_finite()
        && twist.linear.is_finite()
        && angles.iter().chain(memory).all(|number| number.is_finite())
}

/// After a moment of settling, the motion under a command does not depend on the command before it.
#[test]
fn a_new_command_aborts_the_old_one() {
    for model in every_model() {
        let mut random = Random::keyed(1, &[9]);
        let mut checked = 0;
        for _ in 0..300 {
            let (one, other) = (
                command_for(&*model, &mut random),
                command_for(&*model, &mut random),
            );
            let next = command_for(&*model, &mut random);
            let start = model.at_rest(Pose::level(place(&*model, &mut random, 50.0), 0.3));
            let velocity_after = |first: &Command| {
                let mut state = start;
                for _ in 0..4 {
                    state = model.predict(&state, first, &CALM, STEP);
                }
                for _ in 0..400 {
                    state = model.predict(&state, &next, &CALM, STEP);
                }
                // In the robot's own frame: the first command may have turned it.
                let (sin, cos) = starl_core::math::sincos(state.pose.yaw);
                let Point { x, y, z } = state.twist.linear;
                (Point::new(cos * x + sin * y, cos * y - sin * x, z), state)
            };
            let ((a, state_a), (b, state_b)) = (velocity_after(&one), velocity_after(&other));
            // Velocity commands are in the world frame; with a turn no frame shows them equal.
            if matches!(next, Command::Velocity { .. }) {
                assert_eq!(state_a.twist, state_b.twist, "{}", model.name());
                continue;
            }
            // A spinning quadcopter's velocity depends on its phase; landing ends it.
            let spins = state_a.twist.yaw.abs() > 0.01 && model.body().flies();
            // A stopped car keeps its front wheels where they were.
            if !spins {
                assert!(
                    (a - b).length() < 2e-3,
                    "{}: {one:?} {other:?} {next:?}",
                    model.name()
                );
                checked += 1;
            }
            assert_eq!(
                state_a.mode,
                state_b.mode,
                "{}: {one:?} {other:?}",
                model.name()
            );
        }
        assert!(
            checked > 50 || model.name() == "holonomic",
            "{}: {checked}",
            model.name()
        );
    }
}

#[test]
fn a_command_the_model_does_not_take_acts_as_stop() {
    for model in every_model() {
        let mut random = Random::keyed(2, &[9]);
        let mut refused = 0;
        for _ in 0..300 {
            let state = moving(&*model, &mut random);
            let command = any_command(&mut random);
            if model.accepts(&command) {
                continue;
            }
            refused += 1;
            let stopped = model.predict(&state, &Command::Stop, &CALM, STEP);
            assert_eq!(
                model.predict(&state, &command, &CALM, STEP),
                stopped,
                "{command:?}"
            );
        }
        assert!(refused > 50, "{}: {refused}", model.name());
        assert!(model.accepts(&Command::Stop), "{}", model.name());
    }
}

#[test]
fn stop_brings_every_model_to_a_halt() {
    for model in every_model() {
        let mut random = Random::keyed(3, &[9]);
        for _ in 0..50 {
            let mut state = moving(&*model, &mut random);
            for _ in 0..400 {
                state = model.predict(&state, &Command::Stop, &CALM, STEP);
            }
            assert!(
                state.twist.linear.length() < 1e-2,
                "{}: {state:?}",
                model.name()
            );
            assert!(state.twist.yaw.abs() < 1e-3, "{}: {state:?}", model.name());
        }
    }
}

#[test]
fn nan_is_refused_and_never_spreads() {
    let absurd = [
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::MAX,
        f64::MIN_POSITIVE,
        0.0,
    ];
    for model in every_model() {
        let mut random = Random::keyed(4, &[9]);
        for _ in 0..2000 {
            let mut pick = || absurd[random.below(6) as usize];
            let (a, b, c, d) = (pick(), pick(), pick(), pick());
            let command = match random.below(7) {
                0 => Command::Straight { speed: a },
                1 => Command::Turn { rate: a },
                2 => Command::Curve {
                    speed: a,
                    radius: b,
                },
                3 => Command::Wheels { left: a, right: b },
                4 => Command::Steer { speed: a, angle: b },
                5 => Command::Velocity {
                    velocity: Point::new(a, b, c),
                    yaw_rate: d,
                },
                _ => Command::Attitude {
                    yaw_rate: a,
                    pitch: b,
                    roll: c,
                    gaz: d,
                },
            };
            let mut state = moving(&*model, &mut random);
            for _ in 0..3 {
                state = model.predict(&state, &command, &CALM, STEP);
                assert!(
                    is_finite(&state),
                    "{}: {command:?}: {state:?}",
                    model.name()
                );
            }
        }
    }
}

#[test]
fn an_obstacle_stops_the_body_at_the_contact() {
    for model in every_model() {
        let mut random = Random::keyed(5, &[9]);
        for _ in 0..200 {
            let before = moving(&*model, &mut random);
            let command = command_for(&*model, &mut random);
            let predicted = model.predict(&before, &command, &CALM, STEP);
            let place = before.pose.position.lerp(predicted.pose.position, 0.5);
            let mut state = predicted;
            model.stop_at(&mut state, place);
            assert_eq!(state.pose.position, place, "{}", model.name());
            assert_eq!(state.twist.linear, Point::ZERO, "{}", model.name());
        }
    }
}

#[test]
fn a_step_of_zero_length_does_not_move() {
    for model in every_model() {
        let mut random = Random::keyed(6, &[9]);
        for _ in 0..100 {
            let state = moving(&*model, &mut random);
            let command = command_for(&*model, &mut random);
            let after = model.predict(&state, &command, &CALM, Duration::ZERO);
            assert!((after.pose.position - state.pose.position).length() < 1e-12);
        }
    }
}

#[test]
fn disturbances_disturb() {
    let disturbance = Disturbance {
        wind: Point::planar(1.0, 0.5),
        speed_error: 0.05,
        turn_error: 0.05,
    };
    for model in every_model() {
        let mut random = Random::keyed(7, &[9]);
        let moved = (0..50).any(|_| {
            let state = moving(&*model, &mut random);
            let command = command_for(&*model, &mut random);
            let calm = model.predict(&state, &command, &CALM, STEP);
            let disturbed = model.predict(&state, &command, &disturbance, STEP);
            assert!(is_finite(&disturbed));
            disturbed.pose.position != calm.pose.position
        });
        assert!(moved, "{}", model.name());
    }
}
