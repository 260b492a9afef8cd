//! Where the text of an imported library comes from.

use alloc::string::String;
use alloc::vec::Vec;

/// Finds libraries.
pub trait Libraries {
    /// The text of the library with this name; none if there is no such library.
    fn source(&self, name: &str) -> Option<String>;

    /// The names of those that can be told, for editors to suggest.
    fn names(&self) -> Vec<String> {
        Vec::new()
    }
}

impl<F: Fn(&str) -> Option<String>> Libraries for F {
    fn source(&self, name: &str) -> Option<String> {
        self(name)
    }
}

/// No library at all.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoLibraries;

impl Libraries for NoLibraries {
    fn source(&self, _name: &str) -> Option<String> {
        None
    }
}
