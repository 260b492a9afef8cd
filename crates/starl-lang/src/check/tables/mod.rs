//! Tables of the built-in vocabulary: primitives, functions, names, and the methods of built-in types.
//!
//! Each entry is one line in the language's own notation (see [`Signature`]). Editors and the reference pages show
//! these lines.

/// Makes an enum of built-in words from lines of a signature, something about its use, and the documentation.
macro_rules! words {
    (
        $(#[$meta:meta])+ $words:ident, $(#[$all:meta])+ $ALL:ident, $(#[$use:meta])+ $about:ident: $type:ty;
        $($name:ident = $signature:literal $value:tt $documentation:literal)+
    ) => {
        $(#[$meta])+
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum $words {
            $(#[doc = $documentation] $name,)+
        }

        $(#[$all])+
        pub const $ALL: &[$words] = &[$($words::$name,)+];

        impl $words {
            /// Its signature, as text.
            #[must_use]
            pub const fn text(self) -> &'static str {
                match self {
                    $(Self::$name => $signature,)+
                }
            }

            /// Its signature.
            #[must_use]
            pub fn signature(self) -> Signature {
                Signature::read(self.text())
            }

            $(#[$use])+
            #[must_use]
            pub const fn $about(self) -> $type {
                match self {
                    $(Self::$name => $value,)+
                }
            }

            /// The documentation shown to users.
            #[must_use]
            pub const fn documentation(self) -> &'static str {
                match self {
                    $(Self::$name => $documentation,)+
                }
            }
        }
    };
}

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
