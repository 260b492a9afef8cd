//! Formats a text by the smallest changes, so that an editor's marks and cursors stay in place.
//!
//! Only white space changes ([`mod@crate::format`]): both texts have the same other characters, and each white space that
//! differs is one change.

use crate::format::format;
use starl_lang::diagnostic::{Edit, Span};

/// The changes that format the text, sorted by position; none if it is already formatted.
#[must_use]
pub fn layout(text: &str) -> Vec<Edit> {
    let formatted = format(text);
    match between(text, &formatted) {
        Some(edits) => edits,
        // Letters differ only where Unicode and the language disagree on what white space is.
        None => Vec::from([Edit::new(Span::new(0, text.len() as u32), formatted)]),
    }
}

fn between(old: &str, new: &str) -> Option<Vec<Edit>> {
    let mut edits = Vec::new();
    let (mut rest, mut wanted) = (old, new);
    loop {
        let (space, after) = split(rest);
        let (wanted_space, after_wanted) = split(wanted);
        if space != wanted_space {
            let at = old.len() - rest.len();
            let span = Span::new(at as u32, (at + space.len()) as u32);
            edits.push(Edit::new(span, wanted_space));
        }
        let (mut letters, mut wanted_letters) = (after.chars(), after_wanted.chars());
        let letter = letters.next();
        if letter != wanted_letters.next() {
            return None;
        }
        if letter.is_none() {
            return Some(edits);
        }
        (rest, wanted) = (letters.as_str(), wanted_letters.as_str());
    }
}

/// The white space that the text begins with, and the rest.
fn split(text: &str) -> (&str, &str) {
    text.split_at(text.len() - text.trim_start().len())
}
