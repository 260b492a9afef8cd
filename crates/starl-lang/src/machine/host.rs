//! The interface to the host, which provides everything that touches the robot and the world.
//!
//! A program lists the functions that it needs as imports, each with a name, the types of its arguments and results,
//! and whether it is a query. Loading resolves every import to a number of the host's choice; running calls it by that
//! number. A primitive is bound to a number by the program (its instance, counted from zero), and its methods and flags
//! are imports like any other, `Mutex.acquire` or `Mutex.held`, with the instance as their first argument, an Int.

use crate::machine::types::{Layout, Type, bits};
use crate::machine::value::object::Object;
use crate::machine::value::state::State;
use alloc::borrow::Cow;
use alloc::string::String;
use alloc::vec::Vec;
use serde::{Deserialize, Serialize};
use starl_core::{Point, RobotId};

/// A function of the host that a program calls.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Import {
    /// Its name, for instance `position` or `Mutex.acquire`.
    pub name: String,
    /// Whether it changes nothing, so that guards and properties may call it.
    pub query: bool,
    /// The names that the call gives to its arguments, for functions that take any fields; else
    /// empty.
    pub labels: Vec<String>,
    /// The types of its arguments.
    pub arguments: Vec<Type>,
    /// The types of its results.
    pub results: Vec<Type>,
}

/// Finds the functions that a program imports.
pub trait Resolve {
    /// The host's number for an import; none if there is no such function or the types do not fit.
    fn resolve(&self, import: &Import) -> Option<u32>;
}

impl<F: Fn(&Import) -> Option<u32>> Resolve for F {
    fn resolve(&self, import: &Import) -> Option<u32> {
        self(import)
    }
}

/// A robot, as the machine sees it.
pub trait Host {
    /// Calls the function with this number. Arguments are read from `call` and results written to it. Returns the fuel
    /// that the call costs beyond one unit; an error stops the program.
    fn call(&mut self, function: u32, call: &mut HostCall<'_>) -> Result<u64, Cow<'static, str>>;

    /// Learns that the guard of the action with this number holds: its effect runs next.
    fn fires(&mut self, action: u32) {
        let _ = action;
    }

    /// The state of a robot that runs the same program, this one included; none if there is no such
    /// robot.
    fn state_of(&self, robot: RobotId) -> Option<&State> {
        let _ = robot;
        None
    }
}

/// The arguments of a call and room for its results. Both start at register zero: writing a result
/// may overwrite an argument, so arguments are read first.
///
/// Registers beyond those of arguments and results read as zero and are not written.
pub struct HostCall<'a> {
    /// The called function.
    pub import: &'a Import,
    /// Scalars of the arguments, then of the results.
    pub scalars: &'a mut [u64],
    /// Objects of the arguments, then of the results.
    pub objects: &'a mut [Object],
}

impl HostCall<'_> {
    /// A scalar argument.
    pub fn scalar(&self, index: usize) -> u64 {
        self.scalars.get(index).copied().unwrap_or(0)
    }

    /// A Bool argument.
    pub fn bool(&self, index: usize) -> bool {
        self.scalar(index) != 0
    }

    /// An Int argument.
    pub fn int(&self, index: usize) -> i64 {
        self.scalar(index) as i64
    }

    /// A Float argument.
    pub fn float(&self, index: usize) -> f64 {
        f64::from_bits(self.scalar(index))
    }

    /// A robot.
    pub fn robot(&self, index: usize) -> RobotId {
        RobotId(self.scalar(index) as u32)
    }

    /// A point argument whose x is in this register.
    pub fn point(&self, index: usize) -> Point {
        Point::new(
            self.float(index),
            self.float(index + 1),
            self.float(index + 2),
        )
    }

    /// An object argument.
    pub fn object(&self, index: usize) -> Object {
        self.objects.get(index).cloned().unwrap_or_default()
    }

    /// A text argument.
    pub fn text(&self, index: usize) -> &str {
        self.objects.get(index).map_or("", Object::text)
    }

    /// Writes a scalar result.
    pub fn set_scalar(&mut self, index: usize, value: u64) {
        if let Some(place) = self.scalars.get_mut(index) {
            *place = value;
        }
    }

    /// Writes a Bool result.
    pub fn set_bool(&mut self, index: usize, value: bool) {
        self.set_scalar(index, u64::from(value));
    }

    /// Writes an optional of one scalar from this register on.
    pub fn set_optional(&mut self, index: usize, value: Option<u64>) {
        self.set_bool(index, value.is_some());
        self.set_scalar(index + 1, value.unwrap_or(0));
    }

    /// Writes an Int result.
    pub fn set_int(&mut self, index: usize, value: i64) {
        self.set_scalar(index, value as u64);
    }

    /// Writes a time or duration in nanoseconds; later ones than an Int can hold become the last.
    pub fn set_nanoseconds(&mut self, index: usize, value: u64) {
        self.set_scalar(index, value.min(i64::MAX as u64));
    }

    /// Writes a Float result.
    pub fn set_float(&mut self, index: usize, value: f64) {
        self.set_scalar(index, bits(value));
    }

    /// Writes a robot.
    pub fn set_robot(&mut self, index: usize, robot: RobotId) {
        self.set_scalar(index, u64::from(robot.0));
    }

    /// Writes a point from this register on.
    pub fn set_point(&mut self, index: usize, point: Point) {
        self.set_float(index, point.x);
        self.set_float(index + 1, point.y);
        self.set_float(index + 2, point.z);
    }

    /// Writes an object result.
    pub fn set_object(&mut self, index: usize, object: Object) {
        if let Some(place) = self.objects.get_mut(index) {
            *place = object;
        }
    }
}

/// The registers that an import's arguments and results take.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::machine) struct Signature {
    pub number: u32,
    pub arguments: Layout,
    pub results: Layout,
}
