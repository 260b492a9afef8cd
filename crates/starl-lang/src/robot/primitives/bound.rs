//! A primitive that a program has bound, whatever its kind.

use super::kind::{Kind, Report};
use crate::machine::HostCall;
use crate::robot::arguments::Called;
use crate::robot::context::Context;
use alloc::boxed::Box;
use core::fmt;
use dyn_clone::DynClone;
use starl_core::{Point, Port, Primitive, Random, Robot};

/// The place of a primitive on a robot: none until it is bound.
pub type Slot = Option<BoundPrimitive>;

/// A bound primitive of some kind. `Debug` shows all of its state.
pub trait Bound: DynClone + fmt::Debug + Send + Sync {
    /// See [`Kind::primitive`].
    fn primitive(&mut self) -> Option<&mut dyn Primitive>;
    /// Runs the member with this number.
    fn call(
        &mut self,
        member: usize,
        context: &mut Context<'_, '_>,
        call: &mut HostCall<'_>,
    ) -> Called;
    /// See [`Kind::corrupt`].
    fn corrupt(&mut self, random: &mut Random);
    /// See [`Kind::take_reports`].
    fn take_reports(&mut self, take: &mut dyn FnMut(Report));
    /// See [`Kind::halt`].
    fn halt(&mut self, robot: &mut Robot<'_>);
    /// See [`Kind::reset`].
    fn reset(&mut self, robot: &mut Robot<'_>);
    /// See [`Kind::target`].
    fn target(&self) -> Option<Point>;
    /// See [`Kind::looks`].
    fn looks(&self) -> bool;
}

dyn_clone::clone_trait_object!(Bound);

impl<P: Kind> Bound for P {
    fn primitive(&mut self) -> Option<&mut dyn Primitive> {
        Kind::primitive(self)
    }

    fn call(
        &mut self,
        member: usize,
        context: &mut Context<'_, '_>,
        call: &mut HostCall<'_>,
    ) -> Called {
        match P::MEMBERS.get(member) {
            Some(member) => (member.run)(self, context, call),
            None => Err("the primitive has no such member".into()),
        }
    }

    fn corrupt(&mut self, random: &mut Random) {
        Kind::corrupt(self, random);
    }

    fn take_reports(&mut self, take: &mut dyn FnMut(Report)) {
        Kind::take_reports(self, take);
    }

    fn halt(&mut self, robot: &mut Robot<'_>) {
        Kind::halt(self, robot);
    }

    fn reset(&mut self, robot: &mut Robot<'_>) {
        Kind::reset(self, robot);
    }

    fn target(&self) -> Option<Point> {
        Kind::target(self)
    }

    fn looks(&self) -> bool {
        Kind::looks(self)
    }
}

/// A primitive of the program, with the data by which the host skips it when it has no work.
#[derive(Clone)]
pub struct BoundPrimitive {
    pub bound: Box<dyn Bound>,
    /// Where it listens; nowhere, if it has no state machine of its own.
    pub port: Option<Port>,
    /// Whether the program may have called it, or a fault changed it, since its reports were collected.
    pub is_stirred: bool,
}

impl BoundPrimitive {
    /// A new primitive, which the host visits first.
    pub fn new(mut bound: Box<dyn Bound>) -> BoundPrimitive {
        let port = bound.primitive().map(|primitive| primitive.port());
        BoundPrimitive {
            bound,
            port,
            is_stirred: true,
        }
    }
}

/// Shows the primitive alone: the rest follows from it, or has no effect.
impl fmt::Debug for BoundPrimitive {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.bound.fmt(f)
    }
}
