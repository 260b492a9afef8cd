//! Primitives in programs: constructors, flags, methods and events.
//!
//! A kind is one file here with an implementation of [`Kind`], and one line of [`KINDS`]; everything else is the same
//! for all of them. The checker has the same information in the language's own table of primitives.

mod attended;
mod barrier;
mod election;
mod linearizable;
mod local;
mod messaging;
mod mutex;
mod policy;
mod reach_avoid;
mod registration;
mod shared;
mod watch;

pub use attended::{Attended, BoundPrimitive};
pub(super) use shared::{candidates, give, give_all};

use super::arguments::{Arguments, Called};
use super::host::Context;
use super::instance::Instance;
use super::services::Needs;
use super::shape::{Shape, Signature};
use crate::machine::{HostCall, Object};
use alloc::borrow::Cow;
use alloc::boxed::Box;
use alloc::vec::Vec;
use core::fmt;
use dyn_clone::DynClone;
use starl_core::{Input, Point, Primitive, Random, Robot};

/// The place of a primitive on a robot: none until it is bound.
pub type Slot = Option<BoundPrimitive>;

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
    /// Its name.
    pub name: &'static str,
    /// Its fields.
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
    /// Position estimates.
    pub estimates: bool,
    /// Activations.
    pub activations: bool,
}

impl Attention {
    /// All of them.
    pub const FULL: Attention = Attention {
        estimates: true,
        activations: true,
    };
    /// None of them.
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
    /// Its name.
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
    fn primitive(&mut self) -> Option<&mut dyn Primitive>;

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

/// An entry of the table of kinds.
pub struct Entry {
    /// The kind's name.
    pub name: &'static str,
    /// The parameters of its constructor.
    pub constructor: &'static [Shape],
    /// The signature of the member with this number.
    pub member: fn(usize) -> Option<&'static Signature>,
    /// The events that it reports.
    pub events: &'static [Event],
    /// The services that it shares with the program's other primitives.
    pub needs: Needs,
    /// The inputs that it must receive.
    pub attention: Attention,
    /// Binds an instance.
    pub bind: Bind,
}

type Bind = fn(
    &Instance,
    &mut Context<'_, '_>,
    &mut Arguments<'_>,
) -> Result<Box<dyn Bound>, Cow<'static, str>>;

impl Entry {
    const fn of<P: Kind>() -> Entry {
        Entry {
            name: P::NAME,
            constructor: P::CONSTRUCTOR,
            member: |index| P::MEMBERS.get(index).map(|member| &member.signature),
            events: P::EVENTS,
            needs: P::NEEDS,
            attention: P::ATTENTION,
            bind: |instance, context, arguments| {
                Ok(Box::new(P::bind(instance, context, arguments)?))
            },
        }
    }

    /// The signatures of all its members.
    pub fn members(&self) -> impl Iterator<Item = &'static Signature> + use<> {
        (0..).map_while(self.member)
    }
}

/// All kinds of primitives.
pub static KINDS: &[Entry] = &[
    Entry::of::<starl_primitives::ReachAvoid>(),
    Entry::of::<messaging::Sender<starl_primitives::Broadcast>>(),
    Entry::of::<messaging::Sender<starl_primitives::Geocast>>(),
    Entry::of::<messaging::Sender<starl_primitives::Unicast>>(),
    Entry::of::<starl_primitives::LocalBroadcast>(),
    Entry::of::<starl_primitives::Mutex>(),
    Entry::of::<starl_primitives::Registration>(),
    Entry::of::<starl_primitives::Barrier>(),
    Entry::of::<watch::Watch>(),
    Entry::of::<starl_primitives::LeaderElection>(),
    Entry::of::<shared::SingleWriter>(),
    Entry::of::<shared::MultiWriter>(),
    Entry::of::<linearizable::Linearizable>(),
    Entry::of::<policy::Policy>(),
];

/// A method: it may change something.
const fn method<P>(
    name: &'static str,
    parameters: &'static [Shape],
    result: Option<Shape>,
    run: fn(&mut P, &mut Context<'_, '_>, &mut HostCall<'_>) -> Called,
) -> Member<P> {
    let signature = Signature {
        name,
        query: false,
        parameters,
        fields: false,
        result,
    };
    Member { signature, run }
}

/// A flag, or a method that only tells.
const fn query<P>(
    name: &'static str,
    parameters: &'static [Shape],
    result: Shape,
    run: fn(&mut P, &mut Context<'_, '_>, &mut HostCall<'_>) -> Called,
) -> Member<P> {
    let signature = Signature {
        name,
        query: true,
        parameters,
        fields: false,
        result: Some(result),
    };
    Member { signature, run }
}
