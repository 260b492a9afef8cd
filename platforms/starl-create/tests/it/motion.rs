//! The driver turns the wheels as the model does, so that a program drives alike in the simulator and on hardware.

use starl_core::{Command, Duration, Pose, Random};
use starl_create::{Generation, wheel_speeds};
use starl_motion::models::with_parameters;
use starl_motion::{Disturbance, Model};

#[test]
fn wheels_move_the_body_as_the_model_moves_it() {
    let distance = Generation::Create2.wheel_distance();
    let model = with_parameters("create", &[("wheel_distance".into(), distance)]).unwrap();
    let mut random = Random::keyed(6, &[]);
    for _ in 0..20_000 {
        let a = random.between(-2.0, 2.0);
        let b = random.between(-2.0, 2.0);
        let command = match random.below(5) {
            0 => Command::Stop,
            1 => Command::Straight { speed: a },
            2 => Command::Turn { rate: 4.0 * a },
            3 => Command::Curve {
                speed: a,
                radius: b,
            },
            _ => Command::Wheels { left: a, right: b },
        };
        let (left, right) = wheel_speeds(&command, distance).unwrap();
        let wheels = Command::Wheels { left, right };
        let [wanted, driven] = [command, wheels].map(|command| advance(&*model, &command));
        let off = wanted.position.distance(driven.position) + (wanted.yaw - driven.yaw).abs();
        assert!(off < 1e-9, "{command:?}: {wanted:?} and {driven:?}");
    }
}

fn advance(model: &dyn Model, command: &Command) -> Pose {
    let start = model.at_rest(Pose::default());
    let step = Duration::from_millis(100);
    model
        .predict(&start, command, &Disturbance::default(), step)
        .pose
}

#[test]
fn commands_that_are_not_finite_are_refused() {
    for number in [f64::NAN, f64::INFINITY] {
        let commands = [
            Command::Straight { speed: number },
            Command::Turn { rate: number },
            Command::Curve {
                speed: number,
                radius: 1.0,
            },
            Command::Curve {
                speed: 0.1,
                radius: number,
            },
            Command::Wheels {
                left: 0.1,
                right: number,
            },
        ];
        for command in commands {
            assert_eq!(wheel_speeds(&command, 0.235), None, "{command:?}");
        }
    }
}
