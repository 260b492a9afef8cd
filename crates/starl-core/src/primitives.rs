//! Which primitives a program holds.

use crate::{Area, ConvexPolygon, Event, Message, Obstacle, Payload, Primitive, Random, Value};
use alloc::string::String;

pub use starl_derive::Primitives;

/// Shows the primitives that a value holds. A host hands inputs to those that a program shows, and to no
/// others.
///
/// Derive it for programs. Each field is judged by its type, so none can be forgotten:
/// - a primitive is shown;
/// - `Option`, `Vec`, `VecDeque`, `Box`, arrays, tuples and the values of `BTreeMap` are searched, if they are
///   written by these names;
/// - a type that implements `Primitives` shows those that it holds; derive it for parts of a program, structs
///   and enums alike;
/// - other `Copy` types hold none: no primitive is `Copy`;
/// - all other types are refused. For a foreign type, write a struct around it and implement `Primitives` for
///   that.
///
/// ```
/// # use starl_core::{Input, Port, Primitive, Primitives, Program, Robot};
/// # use std::collections::BTreeMap;
/// # #[derive(Clone)]
/// # struct Mutex(&'static str, Vec<u8>);
/// # impl Primitive for Mutex {
/// #     fn port(&self) -> Port { Port::named(self.0) }
/// #     fn handle(&mut self, _: &mut Robot<'_>, _: &Input) {}
/// # }
/// # fn mutex(name: &'static str) -> Mutex { Mutex(name, Vec::new()) }
/// #[derive(Clone, Copy)]
/// enum Phase { Waiting, Crossing }
///
/// #[derive(Clone, Primitives)]
/// struct Lane { lock: Mutex, name: String }
///
/// #[derive(Clone, Primitives)]
/// struct Crossing {
///     phase: Phase,
///     door: Option<Mutex>,
///     zones: BTreeMap<u32, Vec<(f64, Mutex)>>,
///     lane: Lane,
/// }
///
/// impl Program for Crossing {
///     fn activate(&mut self, robot: &mut Robot<'_>) {}
/// }
///
/// let lane = Lane { lock: mutex("lane"), name: "left".into() };
/// let zones = BTreeMap::from([(2, vec![(0.5, mutex("a")), (0.7, mutex("b"))])]);
/// let door = Some(mutex("door"));
/// let mut crossing = Crossing { phase: Phase::Waiting, door, zones, lane };
/// let mut shown = Vec::new();
/// crossing.primitives(&mut |primitive| shown.push(primitive.port()));
/// assert_eq!(shown, ["door", "a", "b", "lane"].map(Port::named));
/// ```
///
/// A program that does not say which primitives it holds is refused:
///
/// ```compile_fail,E0277
/// # use starl_core::{Program, Robot};
/// #[derive(Clone)]
/// struct Idle;
///
/// impl Program for Idle {
///     fn activate(&mut self, robot: &mut Robot<'_>) {}
/// }
/// ```
///
/// So is one with a part that does not, in a field or in a container:
///
/// ```compile_fail,E0277
/// # use starl_core::Primitives;
/// struct Lane { name: String }
///
/// #[derive(Primitives)]
/// struct Crossing { lane: Lane }
/// ```
///
/// ```compile_fail,E0277
/// # use starl_core::Primitives;
/// struct Lane { name: String }
///
/// #[derive(Primitives)]
/// struct Crossing { lanes: Vec<Option<Lane>> }
/// ```
///
/// and one with a container that the macro does not know:
///
/// ```compile_fail,E0277
/// # use starl_core::Primitives;
/// # use std::collections::HashMap;
/// #[derive(Primitives)]
/// struct Crossing { zones: HashMap<u32, u32> }
/// ```
///
/// ```compile_fail,E0277
/// # use starl_core::Primitives;
/// #[derive(Primitives)]
/// struct Crossing<L> { lane: L }
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not say which primitives it holds",
    label = "it may hold primitives that no input would reach",
    note = "derive `starl_core::Primitives` for it, or implement the trait"
)]
pub trait Primitives {
    /// Shows each primitive to `visit`, always in the same order.
    fn primitives(&mut self, visit: &mut dyn FnMut(&mut dyn Primitive));
}

impl<T: Primitive> Primitives for T {
    fn primitives(&mut self, visit: &mut dyn FnMut(&mut dyn Primitive)) {
        visit(self);
    }
}

macro_rules! hold_none {
    ($($type:ty),+) => {
        $(impl Primitives for $type {
            fn primitives(&mut self, _: &mut dyn FnMut(&mut dyn Primitive)) {}
        })+
    };
}

hold_none!(
    Area,
    ConvexPolygon,
    Event,
    Message,
    Obstacle,
    Payload,
    Random,
    String,
    Value,
    str
);

/// The treatment of a field in derived code, which knows only the name of its type. Three traits offer `way`; of those
/// that the type implements, the compiler selects the one with the fewest dereferences of `&&&Probe`. So
/// [`Visited`](field::Visited) comes first. A type that is neither `Primitives` nor `Copy` is left to
/// [`Unknown`](field::Unknown), which fails to compile with the message of [`Primitives`].
#[doc(hidden)]
pub mod field {
    use super::{Primitive, Primitives};
    use core::marker::PhantomData;

    pub struct Probe<T: ?Sized>(PhantomData<fn(&T)>);

    impl<T: ?Sized> Probe<T> {
        pub fn of(_: &T) -> Probe<T> {
            Probe(PhantomData)
        }
    }

    pub struct Visit;

    impl Visit {
        pub fn show<T: Primitives + ?Sized>(
            self,
            field: &mut T,
            visit: &mut dyn FnMut(&mut dyn Primitive),
        ) {
            field.primitives(visit);
        }
    }

    pub struct Pass;

    impl Pass {
        pub fn show<T: ?Sized>(self, _: &mut T, _: &mut dyn FnMut(&mut dyn Primitive)) {}
    }

    pub trait Visited {
        fn way(&self) -> Visit {
            Visit
        }
    }

    impl<T: Primitives + ?Sized> Visited for &&Probe<T> {}

    pub trait Copied {
        fn way(&self) -> Pass {
            Pass
        }
    }

    impl<T: Copy> Copied for &Probe<T> {}

    pub trait Unknown {
        fn way(&self) -> Visit {
            Visit
        }
    }

    impl<T: ?Sized> Unknown for Probe<T> {}
}
