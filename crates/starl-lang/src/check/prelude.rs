//! The prelude: declarations that every program has without an import, written in the language itself.

/// The text of the prelude, a library whose declarations are used without `prelude.`.
pub const PRELUDE: &str = include_str!("prelude.starl");

/// The number of its file.
pub(super) const FILE: u32 = 1;
