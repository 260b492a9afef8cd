//! Problems that keep a checked program from being compiled.

use alloc::boxed::Box;
use alloc::format;
use alloc::string::String;

use crate::diagnostic::{Code, Diagnostic, Span};

/// The result of a step of the compiler.
pub(super) type Compiled<T = ()> = Result<T, Box<Problem>>;

/// A problem and the file that it is in.
#[derive(Clone, Debug)]
pub(super) struct Problem {
    /// The number of the file.
    pub file: u32,
    /// The diagnostic.
    pub diagnostic: Diagnostic,
}

impl Problem {
    /// A problem at a place.
    pub fn new(code: Code, file: u32, span: Span, message: impl Into<String>) -> Box<Self> {
        Box::new(Self {
            file,
            diagnostic: Diagnostic::new(code, span, message),
        })
    }

    /// The same, with more that is worth knowing.
    pub fn note(mut self: Box<Self>, words: impl Into<String>) -> Box<Self> {
        self.diagnostic = self.diagnostic.note(words);
        self
    }

    /// The diagnostic for the program. A diagnostic refers to the program's own text, so a problem of a library is
    /// reported at the program's first line.
    pub fn told(self, files: &[crate::check::CheckedFile]) -> Diagnostic {
        let library = files.get(self.file as usize).filter(|_| self.file != 0);
        let Some(library) = library else {
            return self.diagnostic;
        };
        let lines = crate::diagnostic::LineIndex::new(&library.source);
        let line = lines.line(self.diagnostic.span.start);
        let place = format!("it is in the library `{}`, line {line}", library.name);
        let told = Diagnostic {
            span: Span::empty(0),
            ..self.diagnostic
        };
        told.note(place)
    }
}
