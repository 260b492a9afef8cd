//! A program that writes shared memory on command.

use super::{Wire, World};
use starl_core::timer::{Timer, Token};
use starl_core::{Duration, Primitives, Program, Random, Robot, RobotId, TimerKey};
use starl_primitives::SharedMemory;
use starl_primitives::shared_memory::Options;
use std::any::Any;

#[derive(Clone, Primitives)]
pub struct Sharer {
    pub memory: SharedMemory,
    /// The number of causal variables, from `x0` on.
    causal: u16,
}

impl Sharer {
    pub fn boxed(options: Options) -> impl Fn() -> Box<dyn Program> {
        Sharer::causal(options, 0)
    }

    /// A sharer with this number of causal variables.
    pub fn causal(options: Options, causal: u16) -> impl Fn() -> Box<dyn Program> {
        move || {
            let memory = SharedMemory::new("memory", options);
            Box::new(Sharer { memory, causal })
        }
    }
}

#[derive(Clone, Copy, Debug)]
pub enum Command {
    Write(u8, u32),
    WriteOwn(u8, u32),
    WriteMany(u32),
}

impl Timer for Command {
    fn token(self) -> Token {
        let (what, place, value) = match self {
            Command::Write(variable, value) => (0, variable, value),
            Command::WriteOwn(array, value) => (1, array, value),
            Command::WriteMany(count) => (2, 0, count),
        };
        Token::new(u16::from_be_bytes([what, place]), value)
    }

    fn from_token(token: Token) -> Option<Command> {
        let (kind, value) = token.parts();
        match kind.to_be_bytes() {
            [0, variable] => Some(Command::Write(variable, value)),
            [1, array] => Some(Command::WriteOwn(array, value)),
            [2, 0] => Some(Command::WriteMany(value)),
            _ => None,
        }
    }
}

/// Tells a sharer to write a value to the variable `x0`, `x1`, ...
pub fn write(variable: u8, value: u32) -> Command {
    Command::Write(variable, value)
}

/// Tells a sharer to write a value to its element of the array `x0`, `x1`, ...
pub fn write_own(array: u8, value: u32) -> Command {
    Command::WriteOwn(array, value)
}

/// Tells a sharer to write this many variables, `x0`, `x1`, ..., each with its number as value.
pub fn write_many(count: u32) -> Command {
    Command::WriteMany(count)
}

/// Four robots with activations at this period, each of which has written each of eight variables and its element
/// of each of eight arrays.
pub fn busy_world(seed: u64, wire: Wire, period: Duration) -> World {
    let make = Sharer::boxed(Options::default());
    let mut world = World::new(4, seed, wire, Some(period), make);
    for robot in 0..4 {
        for variable in 0..8 {
            world.command(robot, write(variable, robot as u32));
            world.command(robot, write_own(variable, robot as u32));
        }
    }
    world
}

impl Program for Sharer {
    fn start(&mut self, robot: &mut Robot<'_>) {
        for variable in 0..self.causal {
            self.memory.make_causal(robot, &format!("x{variable}"));
        }
    }

    fn activate(&mut self, _: &mut Robot<'_>) {}

    fn timer(&mut self, robot: &mut Robot<'_>, key: TimerKey) {
        let content = |value: u32| value.to_le_bytes().as_slice().into();
        let mut write = |variable: u32, value| {
            let name = format!("x{variable}");
            self.memory.write(robot, &name, content(value)).unwrap();
        };
        match key.read().expect("a command") {
            Command::Write(variable, value) => write(variable.into(), value),
            Command::WriteMany(count) => (0..count).for_each(|variable| write(variable, variable)),
            Command::WriteOwn(array, value) => {
                let name = format!("x{array}");
                let written = self.memory.write_own(robot, &name, content(value));
                written.unwrap();
            }
        }
    }

    fn corrupt(&mut self, random: &mut Random) {
        self.memory.corrupt(random);
    }

    fn inspect(&self) -> Option<&dyn Any> {
        Some(self)
    }
}

/// The memory of a robot that is up.
pub fn memory(world: &World, robot: usize) -> &SharedMemory {
    &world.inspect::<Sharer>(robot).memory
}

/// The value that a robot reads in the variable `x0`, `x1`, ...
pub fn read(world: &World, robot: usize, variable: u16) -> Option<u32> {
    memory(world, robot)
        .read(&format!("x{variable}"))
        .map(number)
}

/// The value that a robot reads in the array `x0`, `x1`, ... as the element of another.
pub fn read_of(world: &World, robot: usize, array: u16, owner: u32) -> Option<u32> {
    let memory = memory(world, robot);
    memory
        .read_of(&format!("x{array}"), RobotId(owner))
        .map(number)
}

/// All of an array that a robot knows.
pub fn all(world: &World, robot: usize, array: u16) -> Vec<(u32, u32)> {
    let name = format!("x{array}");
    let elements = memory(world, robot).all(&name);
    elements
        .map(|(owner, value)| (owner.0, number(value)))
        .collect()
}

/// A value as its number; values that are not four bytes long come from a corruption.
fn number(value: &[u8]) -> u32 {
    value.try_into().map_or(u32::MAX, u32::from_le_bytes)
}
