//! Tools for authors of programs in the StarL language, as functions without input or output: what editors show while a
//! program is being written, the formatter ([`mod@format`]), and drawings of programs as state machines ([`explain`]).
//!
//! An [`Analysis`] is one text, checked together with what it imports: its problems, the meanings of its names,
//! descriptions at a position ([`Analysis::hover`], [`Analysis::call_help`]), declarations and uses
//! ([`Analysis::definition`], [`Analysis::references`]), renaming ([`Analysis::rename`]), the [`outline`] and the
//! [`tokens`] to colour. [`completions`] completes a name that is being typed; [`layout`] formats the text by the
//! smallest changes. All of them work on texts with errors, because a text has errors while it is being typed.
//!
//! Places are bytes of the text, as everywhere in the language; [`Utf16Lines`] makes them the lines and
//! columns of the Language Server Protocol and back. Names are those that the checker resolved
//! ([`starl_lang::check::Resolutions`]): nothing is resolved a second time.

mod analysis;
mod built_in;
mod completion;
mod describe;
mod description;
mod document;
pub mod explain;
pub mod format;
mod index;
mod layout;
mod outline;
mod position;
mod rename;
mod signature;
mod token;
mod words;

pub use analysis::Analysis;
pub use completion::{Call, Completion, CompletionKind, Completions, Insertion, completions};
pub use description::Description;
pub use document::{BUILT_IN, is_library, replaced};
pub use index::Occurrence;
pub use layout::layout;
pub use outline::{OutlineEntry, OutlineKind, outline};
pub use position::{Utf16Lines, Utf16Position, Utf16Range};
pub use rename::{FileEdits, RenameError};
pub use signature::CallHelp;
pub use token::{Token, TokenKind, TokenModifiers, tokens};
