//! A robot's software: its program with its primitives, as one state machine for hosts to run.

use crate::effect::Effects;
use crate::{Input, Port, Primitive, Program, Random, Robot, Saved, View};
use alloc::boxed::Box;
use alloc::sync::Arc;
use core::{fmt, mem};

/// The program of one robot and its random stream. Every host runs this same machine.
#[derive(Clone)]
pub struct Agent {
    program: Box<dyn Program>,
    random: Random,
    saved: Option<Arc<Saved>>,
}

impl Agent {
    /// A robot's software, not yet started.
    pub fn new(program: Box<dyn Program>, random: Random) -> Agent {
        Agent {
            program,
            random,
            saved: None,
        }
    }

    /// The same on a robot with storage, with its saved values.
    pub fn with_saved(self, saved: Option<Arc<Saved>>) -> Agent {
        Agent { saved, ..self }
    }

    /// The contents of storage when this software was started; none on a robot without storage.
    pub fn saved(&self) -> Option<&Saved> {
        self.saved.as_deref()
    }

    /// Takes one input; what the robot asks for is appended to `effects`.
    pub fn handle(&mut self, input: &Input, view: &View<'_>, effects: &mut Effects) {
        let mut robot =
            Robot::new(view, effects, &mut self.random).with_saved(self.saved.as_deref());
        let program = &mut *self.program;
        let owner = match input {
            Input::Message(message) => Some(message.port),
            Input::Timer(key) => Some(key.port),
            _ => None,
        };
        if owner != Some(Port::PROGRAM) {
            program.primitives(&mut |primitive: &mut dyn Primitive| {
                if owner.is_none_or(|port| port == primitive.port()) {
                    primitive.handle(&mut robot, input);
                }
            });
            tell(program, &mut robot);
            deliver(program, &mut robot);
        }
        match input {
            Input::Start => program.start(&mut robot),
            Input::Activate => program.activate(&mut robot),
            Input::Message(message) if message.port == Port::PROGRAM => {
                program.receive(&mut robot, message);
            }
            Input::Timer(key) if key.port == Port::PROGRAM => program.timer(&mut robot, *key),
            Input::Order(order) => program.told(&mut robot, order),
            _ => {}
        }
        deliver(program, &mut robot);
        if robot.has_storage() {
            program.primitives(&mut |primitive| primitive.save(&mut robot));
            program.save(&mut robot);
        }
    }

    /// Overwrites the program's state at random: see [`Program::corrupt`].
    pub fn corrupt(&mut self, random: &mut Random) {
        self.program.corrupt(random);
    }

    /// Writes everything that the robot's further behaviour depends on. Returns false if its program does not support
    /// this: see [`Program::write_state`].
    pub fn write_state(&self, text: &mut dyn fmt::Write) -> bool {
        self.program.write_state(text) && write!(text, "{:x}", self.random.preview()).is_ok()
    }

    /// The random stream in its present state.
    pub fn random(&self) -> &Random {
        &self.random
    }

    /// Lets an observer call a method of the program that takes a handle to its robot, for example to find its enabled
    /// guards. The call changes nothing: effects are discarded, and random numbers are drawn from a copy of the stream.
    pub fn rehearse<T>(
        &self,
        view: &View<'_>,
        run: impl FnOnce(&dyn Program, &mut Robot<'_>) -> T,
    ) -> T {
        let mut effects = Effects::default();
        let mut random = self.random.clone();
        let mut robot = Robot::new(view, &mut effects, &mut random).with_saved(self.saved());
        run(&*self.program, &mut robot)
    }

    /// Shows the program, e.g. to a test.
    pub fn program(&self) -> &dyn Program {
        &*self.program
    }
}

/// Tells the primitives what a failure detector among them has found out.
fn tell(program: &mut dyn Program, robot: &mut Robot<'_>) {
    for verdict in robot.verdicts() {
        program.primitives(&mut |primitive: &mut dyn Primitive| {
            primitive.handle(robot, &verdict);
        });
    }
}

/// Hands what primitives have delivered to the program, and whatever that brings about.
#[inline]
fn deliver(program: &mut dyn Program, robot: &mut Robot<'_>) {
    while robot.has_upcalls() {
        for message in mem::take(robot.upcalls()) {
            program.receive(robot, &message);
        }
    }
}
