//! The contract of a robot's program.

use crate::{Message, Order, Primitives, Random, Robot, TimerKey};
use core::any::Any;
use core::fmt;
use dyn_clone::DynClone;
use serde::{Deserialize, Serialize};

/// How far a program is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// It works towards its goal.
    #[default]
    Running,
    /// It has reached its goal.
    Finished,
    /// It cannot continue.
    Failed,
}

/// A robot's program: a pure state machine that owns its primitives, and shows them by [`Primitives`].
///
/// The host calls [`Program::start`] once, then [`Program::activate`] every control period: one pass
/// over the guarded actions in the order written, each enabled action firing once (thesis, section
/// 2.2). [`Program::receive`] runs when a message arrives.
pub trait Program: Primitives + DynClone + Send + Sync {
    /// Runs once, before anything else, and again when the robot restarts after a crash (on a fresh
    /// copy of the program).
    fn start(&mut self, robot: &mut Robot<'_>) {
        let _ = robot;
    }

    /// One pass over the guarded actions.
    fn activate(&mut self, robot: &mut Robot<'_>);

    /// Handles a message: one that a primitive delivers (its port tells which), or a datagram
    /// sent to [`crate::Port::PROGRAM`].
    fn receive(&mut self, robot: &mut Robot<'_>, message: &Message) {
        let _ = (robot, message);
    }

    /// Handles a timer that the program armed on [`crate::Port::PROGRAM`].
    fn timer(&mut self, robot: &mut Robot<'_>, key: TimerKey) {
        let _ = (robot, key);
    }

    /// Handles what an operator says, and hears that the waypoints have changed
    /// ([`Order::WAY_POINTS`]).
    fn told(&mut self, robot: &mut Robot<'_>, order: &Order) {
        let _ = (robot, order);
    }

    /// Saves the state that must survive a crash ([`Robot::save`] under [`crate::Port::PROGRAM`]), if it has
    /// changed. Called after each input, only on robots with storage. The saved state is available at
    /// [`Program::start`].
    fn save(&mut self, robot: &mut Robot<'_>) {
        let _ = robot;
    }

    /// Overwrites the program's variables at random, within their types, as a transient fault would
    /// (self-stabilisation, Dijkstra 1974).
    fn corrupt(&mut self, random: &mut Random) {
        let _ = random;
    }

    /// Writes everything that the program's further behaviour depends on, including the states of its primitives, for
    /// hosts that compare states. Two programs of one robot that write the same text must answer every input in the
    /// same way; a derived `Debug` does this. Returns false if the program does not support this; then its state is
    /// identified by its history.
    fn write_state(&self, text: &mut dyn fmt::Write) -> bool {
        let _ = text;
        false
    }

    /// The state that the program shows to observers of a run, for example its variables to a
    /// monitor of its properties. The observer asks for the type that it knows.
    fn inspect(&self) -> Option<&dyn Any> {
        None
    }
}

dyn_clone::clone_trait_object!(Program);
