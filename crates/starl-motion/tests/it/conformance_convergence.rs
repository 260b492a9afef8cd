//! The integration converges to the exact motion as the step gets shorter.

use crate::conformance::{CALM, command_for, every_model_and_variants, place};
use starl_core::{Command, Duration, Pose, Random};
use starl_motion::{Model, State};

/// How long each command of a sequence is driven.
const HOLD: Duration = Duration::from_millis(200);

fn integrate(model: &dyn Model, start: &State, commands: &[Command], step: Duration) -> State {
    let mut state = *start;
    for command in commands {
        for _ in 0..HOLD.0 / step.0 {
            state = model.predict(&state, command, &CALM, step);
        }
    }
    state
}

/// Greatest difference of position (metres) and velocity (metres per second).
fn difference(a: &State, b: &State) -> f64 {
    let position = (a.pose.position - b.pose.position).length();
    position.max((a.twist.linear - b.twist.linear).length())
}

/// Flights are kept off the floor, where touching down is an event, not an integral.
fn sequence(model: &dyn Model, random: &mut Random) -> (State, Vec<Command>) {
    let start = Pose::level(place(model, random, 20.0), random.between(-3.0, 3.0));
    (
        model.at_rest(start),
        (0..10).map(|_| command_for(model, random)).collect(),
    )
}

#[test]
fn errors_shrink_with_the_step() {
    for model in every_model_and_variants() {
        let model = &*model;
        let mut errors = [0.0_f64; 3];
        for seed in 0..40 {
            let (start, commands) = sequence(model, &mut Random::keyed(seed, &[3]));
            let run = |micros: u64| integrate(model, &start, &commands, Duration(micros * 1000));
            let reference = run(625);
            for (error, micros) in errors.iter_mut().zip([20_000, 10_000, 5_000]) {
                *error += difference(&run(micros), &reference) / 40.0;
            }
        }
        let [whole, half, quarter] = errors;
        println!("{}: {whole:.2e} {half:.2e} {quarter:.2e} m", model.name());
        assert!(whole < 1e-3, "{}: {whole}", model.name());
        // At least second order on average (references that run into their limits bend the curve
        // within a step), down to rounding.
        assert!(
            half <= whole / 3.5 + 1e-11,
            "{}: {whole} {half}",
            model.name()
        );
        assert!(
            quarter <= half / 3.5 + 1e-11,
            "{}: {half} {quarter}",
            model.name()
        );
    }
}

#[test]
fn one_long_step_is_as_good_as_many_short_ones() {
    for model in every_model_and_variants() {
        // Without inertia every path is an arc and exact; a quadcopter notices only at the end of
        // a step that it has taken off.
        let most = match (
            model.body().flies(),
            model.limits().acceleration.is_finite(),
        ) {
            (true, _) => 5e-3,
            (false, true) => 1e-6,
            (false, false) => 1e-12,
        };
        for seed in 0..40 {
            let (start, commands) = sequence(&*model, &mut Random::keyed(seed, &[4]));
            let long = integrate(&*model, &start, &commands, HOLD);
            let short = integrate(&*model, &start, &commands, Duration::from_millis(1));
            let error = difference(&long, &short);
            assert!(error < most, "{}: seed {seed}: {error} m", model.name());
        }
    }
}
