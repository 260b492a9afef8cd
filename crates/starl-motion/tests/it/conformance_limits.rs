//! No command, however absurd, makes a model exceed the limits that it states.

use crate::conformance::{CALM, any_command, command_for, every_model_and_variants, place};
use starl_core::{Duration, Pose, Random};
use starl_motion::{Disturbance, Model, State};

/// Relative room for the error of integration.
const ROUNDING: f64 = 1e-5;

fn check_step(model: &dyn Model, before: &State, after: &State, seconds: f64) {
    let limits = model.limits();
    let name = model.name();
    let most = |limit: f64| limit * (1.0 + ROUNDING) + 1e-9;
    let velocity = after.twist.linear;
    assert!(
        velocity.planar_length() <= most(limits.speed),
        "{name}: speed of {after:?}"
    );
    assert!(
        velocity.z.abs() <= most(limits.vertical_speed),
        "{name}: climb of {after:?}"
    );
    assert!(
        after.twist.yaw.abs() <= most(limits.turn_rate),
        "{name}: turn of {after:?}"
    );
    let radius = limits.turn_radius * after.twist.yaw.abs();
    assert!(
        radius <= most(velocity.planar_length()),
        "{name}: turn radius of {after:?}"
    );
    let way = after.pose.position - before.pose.position;
    assert!(
        way.planar_length() <= most(limits.speed * seconds),
        "{name}: from {before:?}"
    );
    // Coming down on the floor stops a robot harder than any limit says.
    let floor = model.body().flies() && after.pose.position.z <= 0.0;
    let change = (velocity - before.twist.linear).length();
    assert!(
        floor || change <= most(limits.acceleration * seconds),
        "{name}: {change} m/s in {seconds} s from {before:?} to {after:?}"
    );
    assert!(after.pose.position.z >= 0.0, "{name}: below the floor");
}

#[test]
fn commands_beyond_the_limits_are_driven_at_the_limits() {
    for model in every_model_and_variants() {
        let model = &*model;
        for seed in 0..200 {
            let mut random = Random::keyed(seed, &[1]);
            let up = place(model, &mut random, 5.0);
            let mut state = model.at_rest(Pose::level(up, random.between(-3.0, 3.0)));
            for _ in 0..40 {
                // Now and then one that the model does not take.
                let command = match random.below(5) {
                    0 => any_command(&mut random),
                    _ => command_for(model, &mut random),
                };
                let step = Duration::from_millis([1, 10, 50, 100][random.below(4) as usize]);
                // Errors of the drive do not lead beyond the limits either.
                let disturbance = match random.below(3) {
                    0 => CALM,
                    _ => Disturbance {
                        speed_error: random.normal(0.0, 1.0),
                        turn_error: random.normal(0.0, 1.0),
                        ..CALM
                    },
                };
                for _ in 0..random.below(20) {
                    let after = model.predict(&state, &command, &disturbance, step);
                    check_step(model, &state, &after, step.seconds());
                    state = after;
                }
            }
        }
    }
}

#[test]
fn a_quadcopter_tilts_no_further_than_its_limit() {
    let model = starl_motion::models::by_name("drone").unwrap();
    let limit = starl_core::math::radians(20.0) * (1.0 + ROUNDING);
    for seed in 0..100 {
        let mut random = Random::keyed(seed, &[2]);
        let mut state = model.at_rest(Pose::level(place(&*model, &mut random, 5.0), 0.0));
        for _ in 0..100 {
            let command = command_for(&*model, &mut random);
            for _ in 0..random.below(30) {
                state = model.predict(&state, &command, &CALM, Duration::from_millis(20));
                let Pose { pitch, roll, .. } = state.pose;
                assert!(pitch * pitch + roll * roll <= limit * limit, "{state:?}");
            }
        }
    }
}
