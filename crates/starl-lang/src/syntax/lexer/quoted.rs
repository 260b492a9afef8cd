//! Strings: `"..."` on one line, with escapes. Between single quotes they are malformed.

use super::SyntaxKind::{self, *};

/// The string that starts with `quote`, and its length. An unterminated string extends to the end of the line; an
/// unmatched single quote is not a string.
pub(super) fn quoted(text: &str, quote: char) -> (SyntaxKind, usize) {
    let mut escaped = false;
    for (at, character) in text.char_indices().skip(1) {
        match character {
            '\n' => return unterminated(text, quote, at),
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            _ if character == quote => {
                return (
                    if quote == '"' {
                        StringLiteral
                    } else {
                        MalformedString
                    },
                    at + 1,
                );
            }
            _ => {}
        }
    }
    unterminated(text, quote, text.len())
}

fn unterminated(text: &str, quote: char, end: usize) -> (SyntaxKind, usize) {
    if quote == '\'' {
        return (Unknown, 1);
    }
    // A comment after it is more likely a comment than a part of it.
    let line = text[..end].trim_end();
    let comment = line.find(" //").unwrap_or(line.len());
    (MalformedString, line[..comment].trim_end().len().max(1))
}
