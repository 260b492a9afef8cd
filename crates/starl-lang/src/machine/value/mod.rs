//! Values: in registers and states, as trees with names, as bytes.

pub(in crate::machine) mod codec;
mod index;
pub(in crate::machine) mod list;
pub(in crate::machine) mod map;
pub(in crate::machine) mod object;
pub(in crate::machine) mod state;
pub(in crate::machine) mod tree;
pub(in crate::machine) mod variables;
