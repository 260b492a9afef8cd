//! A robot of a batch moves, bit for bit, as one of the simulator that gets the same commands.

use crate::support::{Arrays, actions, settings};
use starl_core::{
    Command, Duration, Point, Pose, Primitives, Program, Random, Robot, RobotId, Time,
};
use starl_env::{Batch, Settings};
use starl_sim::Simulation;
use starl_sim::scenario::{Clock, Goal, Group, Scenario, SensorSuite, WorldObstacle};

/// Drives one command after another, a step each.
#[derive(Clone, Primitives)]
struct Tape {
    commands: Vec<Vec<Command>>,
    next: usize,
}

impl Program for Tape {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        if let Some(commands) = self.commands.get(self.next) {
            robot.drive(commands[robot.id().index()]);
        }
        self.next += 1;
    }
}

/// Robots in a ring, heading for its middle, where a pillar stands.
fn starts(robots: usize) -> Vec<Pose> {
    let pose = |robot: usize| {
        let angle = robot as f64 / robots as f64 * std::f64::consts::TAU;
        let height = if robots == 3 { 1.0 } else { 0.0 };
        Pose::level(Point::polar(1.4, angle).at_height(height), angle - 3.0)
    };
    (0..robots).map(pose).collect()
}

fn simulation(settings: &Settings, commands: Vec<Vec<Command>>) -> Simulation {
    let mut scenario = Scenario {
        goal: Goal::Duration,
        duration: Duration::from_seconds(600),
        ..Scenario::default()
    };
    let obstacles = settings.obstacles.iter().cloned();
    scenario.world.obstacles = obstacles
        .map(|obstacle| WorldObstacle {
            obstacle,
            hidden: false,
            expires: Time::NEVER,
        })
        .collect();
    scenario.physics.step = settings.physics_step;
    scenario.positioning.period = settings.physics_step;
    scenario.fleet.groups.push(Group {
        name: "robot".into(),
        numbered: true,
        first_number: 0,
        model: settings.models[0].clone(),
        program: "tape".into(),
        parameters: Default::default(),
        starts: starts(settings.robots()),
        control_period: settings.physics_step,
        sensors: SensorSuite::default(),
        clock: Clock::default(),
    });
    let tape = Tape { commands, next: 0 };
    Simulation::new(scenario, &|_| Ok(Box::new(tape.clone()))).expect("it starts")
}

/// How many robots of how many steps touched something.
fn compare(model: &str, robots: usize) -> usize {
    let settings = Settings {
        steps_per_action: 1,
        ..settings(model, robots)
    };
    let mut batch = Batch::new(settings.clone(), 3).expect("fair settings");
    for environment in 0..3 {
        batch.place(environment, &starts(robots));
    }
    let numbers = settings.action_numbers();
    let mut random = Random::keyed(3, &[robots as u64]);
    // Each action lasts for a second and more: bodies cross the ring and press against each other.
    let tape: Vec<Vec<f64>> = (0..400)
        .scan(Vec::new(), |current, step| {
            if current.is_empty() || random.chance(0.05) {
                *current = actions(9, step, robots * numbers);
            }
            Some(current.clone())
        })
        .collect();
    let command = |row: &[f64]| settings.models[0].command_of(row);
    let commands = tape
        .iter()
        .map(|row| row.chunks(numbers).map(command).collect());
    let mut simulation = simulation(&settings, commands.collect());
    let mut arrays = Arrays::of(&batch);
    let mut touches = 0;
    for (step, row) in tape.iter().enumerate() {
        simulation.step();
        let other = vec![0.25; row.len()];
        let all = [other.as_slice(), row, &other].concat();
        batch.step(&all, &[], arrays.outputs()).expect("finite");
        for robot in 0..robots {
            let there = simulation.state(RobotId(robot as u32));
            let here = batch.state(1, robot);
            assert_eq!(here, there, "{model} {robot} after step {step}");
            touches += usize::from(arrays.contacts[robots + robot] >= 0);
        }
    }
    touches
}

#[test]
fn every_model_moves_as_in_the_simulator() {
    for (model, robots) in [
        ("holonomic", 8),
        ("create", 7),
        ("differential", 12),
        ("car", 5),
        ("drone", 3),
    ] {
        let touches = compare(model, robots);
        println!("{model}: {touches} touches");
        assert!(
            touches > 20 || model == "drone",
            "{model}: only {touches} touches"
        );
    }
}
