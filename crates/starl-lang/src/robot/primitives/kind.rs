//! A kind of primitive, as the program sees it: constructor, members and events.

use crate::machine::{HostCall, Object};
use crate::robot::arguments::{Arguments, Called};
use crate::robot::context::Context;
use crate::robot::instance::Instance;
use crate::robot::services::Needs;
use crate::robot::shape::{Shape, Signature};
use alloc::borrow::Cow;
use alloc::vec::Vec;
use core::fmt;
use starl_core::{Input, Point, Primitive, Random, Robot};

/// A method or flag of a kind of primitive.
pub struct Member<P: 'static> {
    /// Its name, arguments and results.
    pub signature: Signature,
    /// The function that runs it; arguments begin with the instance's number.
    pub run: fn(&mut P, &mut Context<'_, '_>, &mut HostCall<'_>) -> Called,
}

/// Something that a kind of primitive reports.
#[derive(Debug)]
pub struct Event {
    pub name: &'static str,
    pub parameters: &'static [Shape],
}

/// An event that happened.
#[derive(Clone, Debug)]
pub struct Report {
    /// Which of the kind's events.
    pub event: usize,
    /// The scalars of its fields.
    pub scalars: Vec<u64>,
    /// The objects of its fields.
    pub objects: Vec<Object>,
}

/// The frequent inputs that a kind of primitive needs. A fleet is large and most primitives wait for messages:
/// primitives without work are skipped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Attention {
    pub estimates: bool,
    pub activations: bool,
}

impl Attention {
    pub const FULL: Attention = Attention {
        estimates: true,
        activations: true,
    };
    pub const NONE: Attention = Attention {
        estimates: false,
        activations: false,
    };

    /// Whether it does something at this input.
    pub fn is_paid_to(self, input: &Input) -> bool {
        match input {
            Input::Estimate => self.estimates,
            Input::Activate => self.activations,
            _ => true,
        }
    }
}

/// A kind of primitive.
pub trait Kind: Clone + fmt::Debug + Send + Sync + Sized + 'static {
    const NAME: &'static str;
    /// The parameters of its constructor.
    const CONSTRUCTOR: &'static [Shape];
    /// Its methods and flags.
    const MEMBERS: &'static [Member<Self>];
    /// The events that it reports.
    const EVENTS: &'static [Event] = &[];
    /// The services that it shares with the program's other primitives.
    const NEEDS: Needs = Needs::NOTHING;
    /// The inputs that it must receive.
    const ATTENTION: Attention = Attention::FULL;

    /// Binds an instance.
    fn bind(
        instance: &Instance,
        context: &mut Context<'_, '_>,
        arguments: &mut Arguments<'_>,
    ) -> Result<Self, Cow<'static, str>>;

    /// The state machine; none if it has none of its own.
    fn primitive(&mut self) -> Option<&mut dyn Primitive> {
        None
    }

    /// Overwrites its state at random, as a transient fault would. State in the program's shared services is
    /// overwritten there.
    fn corrupt(&mut self, random: &mut Random);

    /// Passes the reports since the last call to `take`.
    fn take_reports(&mut self, take: &mut dyn FnMut(Report)) {
        let _ = take;
    }

    /// Stops moving the robot.
    fn halt(&mut self, robot: &mut Robot<'_>) {
        let _ = robot;
    }

    /// Stops its work for the program, which restarts. It keeps its knowledge of other robots.
    fn reset(&mut self, robot: &mut Robot<'_>) {
        let _ = robot;
    }

    /// Where it moves the robot.
    fn target(&self) -> Option<Point> {
        None
    }

    /// Whether it reads sensors when the robot is activated, whatever [`Kind::ATTENTION`] says. Its answers may
    /// change with each activation.
    fn looks(&self) -> bool {
        false
    }
}

/// A method: it may change something.
pub const fn method<P>(
    name: &'static str,
    parameters: &'static [Shape],
    result: Option<Shape>,
    run: fn(&mut P, &mut Context<'_, '_>, &mut HostCall<'_>) -> Called,
) -> Member<P> {
    let signature = Signature::effect(name, parameters, result);
    Member { signature, run }
}

/// A flag, or a method that only tells.
pub const fn query<P>(
    name: &'static str,
    parameters: &'static [Shape],
    result: Shape,
    run: fn(&mut P, &mut Context<'_, '_>, &mut HostCall<'_>) -> Called,
) -> Member<P> {
    let signature = Signature::query(name, parameters, result);
    Member { signature, run }
}

/// A flag of this name, which a function of the primitive answers.
macro_rules! flag {
    ($name:literal, $ask:path) => {
        $crate::robot::primitives::kind::query(
            $name,
            &[],
            $crate::robot::shape::Shape::Bool,
            |primitive, _, call| {
                call.set_bool(0, $ask(primitive));
                Ok(0)
            },
        )
    };
}

pub(super) use flag;
