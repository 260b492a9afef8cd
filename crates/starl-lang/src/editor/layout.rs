//! Laying a text out anew by the smallest changes, so that an editor's marks and cursors stay where they
//! are.
//!
//! Only white space changes ([`crate::format`]), so that both texts are the same words with other white
//! space between; each white space that differs is one change.

use alloc::vec::Vec;

use crate::diagnostic::{Edit, Span};
use crate::format::format;

/// The changes that lay the text out, by rising place; none if it is laid out already.
#[must_use]
pub fn layout(text: &str) -> Vec<Edit> {
    let formatted = format(text);
    match between(text, &formatted) {
        Some(edits) => edits,
        // Words differ where a comment ends with white space that has a meaning to nobody but Unicode.
        None => Vec::from([Edit::new(Span::new(0, text.len() as u32), formatted)]),
    }
}

fn between(old: &str, new: &str) -> Option<Vec<Edit>> {
    let mut edits = Vec::new();
    let (mut at, mut rest) = (0, new);
    loop {
        let (space, after) = split(&old[at..], |letter| !letter.is_whitespace());
        let (wanted, after_wanted) = split(rest, |letter| !letter.is_whitespace());
        if space != wanted {
            let span = Span::new(at as u32, (at + space.len()) as u32);
            edits.push(Edit::new(span, wanted));
        }
        let (word, _) = split(after, char::is_whitespace);
        let (same, after_same) = split(after_wanted, char::is_whitespace);
        if word != same {
            return None;
        }
        if word.is_empty() {
            return Some(edits);
        }
        at += space.len() + word.len();
        rest = after_same;
    }
}

/// The text up to where something begins, and from there on.
fn split(text: &str, begins: impl Fn(char) -> bool) -> (&str, &str) {
    text.split_at(text.find(begins).unwrap_or(text.len()))
}
