//! The joint between an import of a program and the functions that serve it.
//!
//! Functions are given by their numbers in the tables of built-ins, kinds of primitives and observables. So the program
//! and the context of its calls do not depend on the functions, which depend on them.

use super::messages::Outgoing;

/// An import joined to the functions that serve it.
#[derive(Clone, Debug)]
pub struct Joint {
    /// Its implementation on a robot.
    pub on_robot: Option<OnRobot>,
    /// Its implementation in properties: the number of an observable.
    pub in_property: Option<u16>,
    /// Whether on a robot its result follows from its arguments, inputs and the program's primitives.
    pub is_steady: bool,
    /// The message that it sends.
    pub message: Option<Outgoing>,
}

/// The implementation of an import on a robot.
#[derive(Clone, Copy, Debug)]
pub enum OnRobot {
    /// It is the built-in function with this number.
    Builtin(u16),
    /// It binds a primitive of this kind.
    Bind(u16),
    /// It is a member of a kind.
    Member {
        kind: u16,
        /// The number of the member.
        member: u16,
    },
}
