//! The source of the files that a program names: imported libraries and models.

use alloc::string::String;
use alloc::vec::Vec;
use starl_core::FileError;

/// Finds libraries and models.
pub trait Libraries {
    /// The text of the library with this name; none if there is no such library.
    fn source(&self, name: &str) -> Option<String>;

    /// The bytes of the model at this path, relative to the program.
    ///
    /// # Errors
    /// Why it cannot be read.
    fn model(&self, path: &str) -> Result<Vec<u8>, FileError> {
        let _ = path;
        Err(FileError::Missing)
    }

    /// The names of those that can be determined, for editors to suggest.
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
