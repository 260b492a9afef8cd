//! Numbers, with the unit that may follow them without a space: `12`, `1_000`, `1.5e-3`, `75mm`.

use super::SyntaxKind::{self, *};
use super::name;
use crate::syntax::literal::unit;

/// The number of a tuple's part at the start of the text: digits alone, so that `t.0.1` is the part 1 of the part 0.
pub(super) fn part(text: &str) -> (SyntaxKind, usize) {
    let digits = text
        .bytes()
        .take_while(|byte| byte.is_ascii_digit() || *byte == b'_');
    (IntegerLiteral, digits.count())
}

/// The number at the start of the text, with all letters and digits that follow it.
pub(super) fn number(text: &str) -> (SyntaxKind, usize) {
    let bytes = text.as_bytes();
    let digits = |from: usize| {
        let more = bytes.get(from..).unwrap_or_default();
        more.iter()
            .take_while(|byte| byte.is_ascii_digit() || **byte == b'_')
            .count()
    };
    let is_digit = |at: usize| bytes.get(at).is_some_and(u8::is_ascii_digit);

    let mut end = digits(0);
    let mut kind = IntegerLiteral;
    if bytes.get(end) == Some(&b'.') && is_digit(end + 1) {
        end += 1 + digits(end + 1);
        kind = FloatLiteral;
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        if is_digit(end + 1 + sign) {
            end += 1 + sign + digits(end + 1 + sign);
            kind = FloatLiteral;
        }
    }
    let suffix = name(&text[end..]);
    if suffix > 0 {
        kind = unit(&text[end..end + suffix]).map_or(MalformedNumber, |unit| unit.kind);
    }
    (kind, end + suffix)
}
