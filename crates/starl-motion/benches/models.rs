//! Nanoseconds per step of each model and per turn of its tracker, one thread: `cargo bench -p
//! starl-motion --bench models`.
#![allow(missing_docs)]
#![allow(clippy::disallowed_methods)] // a benchmark reads the clock

use starl_core::motion::Estimate;
use starl_core::{Command, Duration, Point, Pose, Random, Time};
use starl_motion::{Disturbance, Goal, Model, State, Tracking, models};
use std::hint::black_box;
use std::time::Instant;

const ROBOTS: usize = 1000;
const STEPS: usize = 1000;

/// A command that keeps each robot busy, different from robot to robot.
fn command(model: &dyn Model, random: &mut Random) -> Command {
    let mut number = || random.between(0.1, 0.2);
    let candidates = [
        Command::Attitude {
            yaw_rate: number(),
            pitch: number(),
            roll: number(),
            gaz: number(),
        },
        Command::Steer {
            speed: number(),
            angle: number(),
        },
        Command::Velocity {
            velocity: Point::planar(number(), number()),
            yaw_rate: number(),
        },
        Command::Wheels {
            left: number(),
            right: number(),
        },
    ];
    *candidates
        .iter()
        .find(|command| model.accepts(command))
        .unwrap_or(&Command::Stop)
}

fn predict(model: &dyn Model, step: Duration) -> f64 {
    let mut random = Random::keyed(1, &[]);
    let calm = Disturbance::default();
    let mut robots: Vec<(State, Command)> = (0..ROBOTS)
        .map(|i| {
            let pose = Pose::level(Point::new(i as f64, 0.0, 100.0), random.between(-3.0, 3.0));
            (model.at_rest(pose), command(model, &mut random))
        })
        .collect();
    let began = Instant::now();
    for _ in 0..STEPS {
        for (state, command) in &mut robots {
            *state = model.predict(state, command, &calm, step);
        }
    }
    black_box(&robots);
    began.elapsed().as_nanos() as f64 / (ROBOTS * STEPS) as f64
}

fn track(model: &dyn Model) -> f64 {
    let pose = model
        .at_rest(Pose::level(Point::new(0.0, 0.0, 1.0), 0.3))
        .pose;
    let mut tracking = Tracking::default();
    let mut random = Random::keyed(2, &[]);
    let began = Instant::now();
    for i in 0..STEPS * 100 {
        let at = Time(50_000_000 * i as u64);
        let estimate = Estimate {
            pose,
            at,
            ..Estimate::default()
        };
        let goal = Goal::stop_at(Point::new(random.between(1.0, 3.0), 0.5, 1.0));
        black_box(model.track(&mut tracking, &estimate, &goal));
    }
    began.elapsed().as_nanos() as f64 / (STEPS * 100) as f64
}

fn main() {
    println!("model          predict 10 ms   predict 100 ms   track   (nanoseconds)");
    for kind in models::KINDS {
        let model = models::by_name(kind.name).expect("a registered model");
        let [short, long] = [10, 100].map(|ms| predict(&*model, Duration::from_millis(ms)));
        println!(
            "{:<14} {short:>13.1} {long:>16.1} {:>7.1}",
            kind.name,
            track(&*model)
        );
    }
}
