//! Places in the files.

use crate::diagnostic::Span;

/// Where something is declared: the file, and the name in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Site {
    /// The number of the file.
    pub file: u32,
    /// The name, or the word that begins the declaration if it has none.
    pub span: Span,
}

impl Site {
    /// The beginning of the program.
    pub const START: Self = Self {
        file: 0,
        span: Span::empty(0),
    };
}
