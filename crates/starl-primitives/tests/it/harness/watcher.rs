//! A program that only watches the others, and records the verdicts of its detector.

use super::World;
use starl_core::{Input, Port, Primitive, Primitives, Program, Random, Robot, RobotId};
use starl_primitives::FailureDetector;
use starl_primitives::failure_detector::Options;
use std::any::Any;

#[derive(Clone, Primitives)]
pub struct Watcher {
    pub detector: FailureDetector,
    pub listener: Listener,
}

/// A primitive that hears the detector's verdicts, as those that wait for robots do.
#[derive(Clone, Default)]
pub struct Listener(pub Vec<Input>);

impl Primitive for Listener {
    fn port(&self) -> Port {
        Port::named("listener")
    }

    fn handle(&mut self, _: &mut Robot<'_>, input: &Input) {
        if matches!(input, Input::Suspected(_) | Input::Trusted(_)) {
            self.0.push(input.clone());
        }
    }
}

impl Watcher {
    pub fn boxed(options: Options) -> impl Fn() -> Box<dyn Program> {
        move || {
            Box::new(Watcher {
                detector: FailureDetector::new("watch", options),
                listener: Listener::default(),
            })
        }
    }
}

impl Program for Watcher {
    fn activate(&mut self, _: &mut Robot<'_>) {}

    fn corrupt(&mut self, random: &mut Random) {
        self.detector.corrupt(random);
    }

    fn inspect(&self) -> Option<&dyn Any> {
        Some(self)
    }
}

/// The program of a robot that is up.
pub fn watcher(world: &World, robot: usize) -> &Watcher {
    world.inspect(robot)
}

/// The robots that a robot suspects.
pub fn suspected(world: &World, robot: usize) -> Vec<u32> {
    let suspected = watcher(world, robot).detector.suspected();
    suspected.map(|RobotId(number)| number).collect()
}

/// The inputs of a robot's other primitives.
pub fn told(world: &World, robot: usize) -> &[Input] {
    &watcher(world, robot).listener.0
}
