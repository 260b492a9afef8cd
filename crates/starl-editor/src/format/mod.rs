//! The formatter, with one canonical layout.
//!
//! As in gofmt, tokens stay on their lines: only the white space between them changes, so the meaning and the comments
//! stay the same. Each block indents its lines by four spaces. A declaration with errors stays as it is, because the
//! meaning of its white space is unknown.
//!
//! Formatting is idempotent.

mod blank;
mod comments;
mod indent;
mod line;
mod piece;
mod space;

use starl_lang::syntax::{self, Parse};

/// The formatted text.
#[must_use]
pub fn format(text: &str) -> String {
    format_parse(&syntax::parse(text))
}

/// The formatted text of a parsed program.
#[must_use]
pub fn format_parse(parse: &Parse) -> String {
    let pieces = piece::pieces(parse);
    let mut lines = line::lines(pieces);
    blank::arrange(&mut lines);
    comments::align(&mut lines);
    line::write(&lines)
}
