//! Every model takes controls from -1 to 1.

use starl_core::{Duration, Pose};
use starl_motion::{Disturbance, models};

#[test]
fn controls_are_commands_that_the_model_takes() {
    for kind in models::KINDS {
        let model = models::by_name(kind.name).expect("a model");
        let count = model.controls().len();
        for control in [-5.0, -1.0, 0.0, 0.5, 1.0] {
            let command = model.command_of(&vec![control; count]);
            assert!(model.accepts(&command), "{}: {command:?}", kind.name);
        }
        let beyond = model.command_of(&vec![7.0; count]);
        assert_eq!(beyond, model.command_of(&vec![1.0; count]), "{}", kind.name);
        for place in 0..count {
            let mut controls = vec![0.1; count];
            controls[place] = f64::NAN;
            let command = model.command_of(&controls);
            assert!(!model.accepts(&command), "{}: {command:?}", kind.name);
        }
    }
}

#[test]
fn ground_robots_move_with_controls_at_the_limit_and_stand_without() {
    for kind in models::KINDS.iter().filter(|kind| kind.name != "drone") {
        let model = models::by_name(kind.name).expect("a model");
        let start = model.at_rest(Pose::default());
        let after = |controls: &[f64]| {
            let command = model.command_of(controls);
            let second = Duration::from_seconds(1);
            model.predict(&start, &command, &Disturbance::default(), second)
        };
        assert_eq!(after(&[]).pose, start.pose, "{}", kind.name);
        let moved = after(&[1.0, if kind.name == "car" { 0.0 } else { 1.0 }]);
        let speed = moved.twist.linear.length();
        let limit = model.limits().speed;
        let part = speed / limit;
        assert!(
            part > 0.4 && part < 1.0 + 1e-9,
            "{}: {speed} of {limit} m/s",
            kind.name
        );
    }
}
