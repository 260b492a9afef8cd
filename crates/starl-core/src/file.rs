//! Files that a scenario or a program names, which hosts bring from wherever they keep them.

use alloc::string::String;
use thiserror::Error;

/// Why a file cannot be had.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum FileError {
    /// Nothing has this path.
    #[error("there is no such file")]
    Missing,
    /// It is not UTF-8.
    #[error("it is not text in UTF-8, in line {line}")]
    NotText {
        /// The line of the first byte that is not, from 1.
        line: usize,
    },
    /// It is there, but cannot be read; the reason in words.
    #[error("{0}")]
    Unreadable(String),
}

/// The text of a file.
///
/// # Errors
/// [`FileError::NotText`].
pub fn text(bytes: &[u8]) -> Result<&str, FileError> {
    str::from_utf8(bytes).map_err(|error| {
        let before = &bytes[..error.valid_up_to()];
        let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count();
        FileError::NotText { line }
    })
}
