//! Laying a program out in the one canonical way.
//!
//! What is on a line stays on a line: only white space between tokens changes, and with it neither the
//! meaning nor any comment (after gofmt). A line is indented by four spaces for each block that it is in.
//! A declaration with errors stays as it is, because what its white space means is not known.
//!
//! Formatting what was formatted changes nothing.

mod blank;
mod comments;
mod indent;
mod line;
mod piece;
mod space;

use alloc::string::String;

use crate::syntax::{self, Parse};

/// `text`, laid out anew.
#[must_use]
pub fn format(text: &str) -> String {
    format_parse(&syntax::parse(text))
}

/// A program that was read, laid out anew.
#[must_use]
pub fn format_parse(parse: &Parse) -> String {
    let pieces = piece::pieces(parse);
    let mut lines = line::lines(pieces);
    blank::arrange(&mut lines);
    comments::align(&mut lines);
    line::write(&lines)
}
