//! Texts in editors: their names, kinds and changes.

use crate::{Utf16Lines, Utf16Position};

/// The prefix of built-in libraries, which are not files: `starl-library:/prelude.starl`.
pub const BUILT_IN: &str = "starl-library:/";

/// Whether the text says that it is a library, without reading all of it.
#[must_use]
pub fn is_library(text: &str) -> bool {
    let mut lines = text.lines().map(str::trim_start);
    let first = lines.find(|line| !line.is_empty() && !line.starts_with("//"));
    first.is_some_and(|line| line.starts_with("library"))
}

/// The text with the part from `start` to `end` replaced. Places outside of the text are its nearest
/// ones; an end before its start is the start.
#[must_use]
pub fn replaced(text: &str, start: Utf16Position, end: Utf16Position, by: &str) -> String {
    let lines = Utf16Lines::new(text);
    let start = lines.offset(text, start) as usize;
    let end = (lines.offset(text, end) as usize).max(start);
    let mut changed = String::with_capacity(text.len() - (end - start) + by.len());
    changed.push_str(&text[..start]);
    changed.push_str(by);
    changed.push_str(&text[end..]);
    changed
}
