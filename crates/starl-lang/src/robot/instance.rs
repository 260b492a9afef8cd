//! A primitive of a program, as its code describes it.

use alloc::string::String;
use alloc::vec::Vec;

/// A primitive that the program binds.
#[derive(Clone, Debug)]
pub struct Instance {
    /// The name by which instances on different robots find each other.
    pub name: String,
    /// The name in the program.
    pub variable: String,
    /// Its kind, by its number in [`KINDS`](super::primitives::KINDS).
    pub kind: u16,
    /// For each of the kind's events that is handled its number and the handler's.
    pub handlers: Vec<(usize, u32)>,
    /// The group of a linearizable variable, by the name of the first of it; else its own name.
    pub group: String,
}
