//! What every program may use without declaring it, as tables: primitives, built-in functions and
//! names, and the methods of built-in types.
//!
//! Each entry is one line of text in the language's own notation (see [`Signature`]), so that the
//! tables are the reference too: what editors show and documentation lists.

mod builtins;
mod methods;
mod primitives;
mod signature;

pub use builtins::{BUILTINS, Builtin};
pub use methods::{METHODS, Method};
pub use primitives::{Event, Member, PRIMITIVES, Primitive};
pub use signature::{Parameter, Shape, Signature};

/// What using something does to the world, and so where it may stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Purity {
    /// It depends on its arguments only: it may stand anywhere.
    Pure,
    /// It reads what the robot or a primitive knows: not in functions and constants.
    Query,
    /// It does something: only in `init`, effects and handlers.
    Effect,
    /// It is known to whoever watches the run, and to no robot: only in properties.
    Property,
}
