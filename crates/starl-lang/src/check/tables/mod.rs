//! Tables of the built-in vocabulary: primitives, functions, names, and the methods of built-in types.
//!
//! Each entry is one line in the language's own notation (see [`Signature`]). Editors and the reference pages show
//! these lines.

mod builtins;
mod methods;
mod primitives;
mod signature;

pub use builtins::{BUILTINS, Builtin};
pub use methods::{METHODS, Method};
pub use primitives::{Event, Member, PRIMITIVES, Primitive};
pub use signature::{Parameter, Shape, Signature};

/// The effect of a use on the world, which decides where the use is allowed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Purity {
    /// It depends on its arguments only: it may stand anywhere.
    Pure,
    /// It reads what the robot or a primitive knows: not in functions and constants.
    Query,
    /// It does something: only in `init`, effects and handlers.
    Effect,
    /// Known only to an observer of the run, not to robots: allowed only in properties.
    Property,
}
