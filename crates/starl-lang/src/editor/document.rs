//! Changes of a text as editors send them.

use alloc::string::String;

use super::{Utf16Lines, Utf16Position};

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
