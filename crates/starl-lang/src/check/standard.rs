//! The standard library: libraries that every host has, written in the language itself.
//!
//! They import nothing, so that a library of the same name beside a program changes nothing in them.

use alloc::string::String;
use alloc::vec::Vec;

use super::Libraries;

/// The libraries, by name.
pub const STANDARD: &[(&str, &str)] = &[
    ("fleet", include_str!("../../library/fleet.starl")),
    ("geometry", include_str!("../../library/geometry.starl")),
    ("lists", include_str!("../../library/lists.starl")),
    ("tasks", include_str!("../../library/tasks.starl")),
];

/// The libraries of [`STANDARD`] alone.
#[derive(Clone, Copy, Debug, Default)]
pub struct StandardLibraries;

impl Libraries for StandardLibraries {
    fn source(&self, name: &str) -> Option<String> {
        let mut libraries = STANDARD.iter();
        let (_, text) = libraries.find(|(own, _)| *own == name)?;
        Some((*text).into())
    }

    fn names(&self) -> Vec<String> {
        let names = STANDARD.iter().map(|(name, _)| String::from(*name));
        names.collect()
    }
}
