//! What an editor asks of the language, as functions without input or output.
//!
//! An [`Analysis`] is one text, checked together with what it imports: its problems, what each name
//! stands for, and from these what to show at a place ([`Analysis::hover`], [`Analysis::call_help`]), where something is declared
//! and used ([`Analysis::definition`], [`Analysis::references`]), how to rename it
//! ([`Analysis::rename`]), the [`outline`] and the [`tokens`] to colour. [`completions`] says what a name
//! that is being typed may be; [`layout`] lays the text out anew by the smallest changes. All of them work
//! on texts with errors, as texts are while one types.
//!
//! Places are bytes of the text, as everywhere in the language; [`Utf16Lines`] makes them the lines and
//! columns of the Language Server Protocol and back. Names are those that the checker resolved
//! ([`crate::check::Resolutions`]): nothing is resolved a second time.

mod analysis;
mod built_in;
mod completion;
mod describe;
mod document;
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
pub use describe::Description;
pub use document::{BUILT_IN, is_library, replaced};
pub use index::Occurrence;
pub use layout::layout;
pub use outline::{OutlineEntry, OutlineKind, outline};
pub use position::{Utf16Lines, Utf16Position, Utf16Range};
pub use rename::{FileEdits, Renamed};
pub use signature::CallHelp;
pub use token::{Token, TokenKind, TokenModifiers, tokens};
