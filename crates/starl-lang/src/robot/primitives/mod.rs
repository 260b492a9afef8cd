//! Primitives in programs: constructors, flags, methods and events.
//!
//! A kind is one file here with an implementation of [`Kind`](kind::Kind), and one line of [`KINDS`]; everything else is
//! the same for all of them. The checker has the same information in the language's own table of primitives.

mod attended;
mod barrier;
mod bound;
mod election;
mod kind;
mod kinds;
mod linearizable;
mod local;
mod messaging;
mod mutex;
mod policy;
mod reach_avoid;
mod registration;
mod shared;
mod watch;

pub use attended::Attended;
pub use bound::{BoundPrimitive, Slot};
pub use kind::Report;
pub use kinds::KINDS;
pub(super) use shared::{candidates, give, give_all};
