//! Values of literals.

use alloc::string::String;
use core::f64::consts::PI;

use super::SyntaxKind;

/// A unit that may follow a number.
pub(crate) struct Unit {
    /// How it is written.
    pub name: &'static str,
    /// The kind of a number with it.
    pub kind: SyntaxKind,
    /// How many nanoseconds, metres or radians it has: this many, divided by `parts`.
    size: f64,
    parts: f64,
}

const fn unit_of(name: &'static str, kind: SyntaxKind, size: f64, parts: f64) -> Unit {
    Unit {
        name,
        kind,
        size,
        parts,
    }
}

/// All units.
pub(crate) const UNITS: &[Unit] = &[
    unit_of("ns", SyntaxKind::DurationLiteral, 1.0, 1.0),
    unit_of("us", SyntaxKind::DurationLiteral, 1e3, 1.0),
    unit_of("ms", SyntaxKind::DurationLiteral, 1e6, 1.0),
    unit_of("s", SyntaxKind::DurationLiteral, 1e9, 1.0),
    unit_of("min", SyntaxKind::DurationLiteral, 60e9, 1.0),
    unit_of("h", SyntaxKind::DurationLiteral, 3600e9, 1.0),
    unit_of("mm", SyntaxKind::LengthLiteral, 1.0, 1e3),
    unit_of("cm", SyntaxKind::LengthLiteral, 1.0, 1e2),
    unit_of("m", SyntaxKind::LengthLiteral, 1.0, 1.0),
    unit_of("km", SyntaxKind::LengthLiteral, 1e3, 1.0),
    unit_of("deg", SyntaxKind::AngleLiteral, PI, 180.0),
    unit_of("rad", SyntaxKind::AngleLiteral, 1.0, 1.0),
];

/// The unit that is written so.
pub(crate) fn unit(name: &str) -> Option<&'static Unit> {
    UNITS.iter().find(|unit| unit.name == name)
}

/// The unit that a word stands for, as other languages or people write it.
pub(crate) fn unit_meant(word: &str) -> Option<&'static str> {
    Some(match word {
        "sec" | "secs" | "second" | "seconds" => "s",
        "msec" | "millis" | "milliseconds" => "ms",
        "µs" | "μs" | "usec" => "us",
        "minute" | "minutes" | "mins" => "min",
        "hour" | "hours" | "hr" => "h",
        "meter" | "meters" | "metre" | "metres" => "m",
        "degrees" | "degree" | "°" => "deg",
        "radians" | "radian" => "rad",
        _ => unit(word)?.name,
    })
}

/// The type that other languages call so, in any case.
pub(crate) fn type_meant(word: &str) -> Option<&'static str> {
    Some(match word.to_ascii_lowercase().as_str() {
        "int" | "integer" | "long" | "uint" | "i32" | "i64" | "u32" | "u64" | "usize" => "Int",
        "float" | "double" | "real" | "number" | "f32" | "f64" | "angle" | "length"
        | "distance" | "speed" => "Float",
        "bool" | "boolean" => "Bool",
        "str" | "string" | "text" | "char" => "String",
        "itemposition" | "pos" | "position" | "pose" | "vec2" | "vec3" => "Point",
        "robot" => "RobotId",
        "timedelta" | "timespan" | "seconds" => "Duration",
        "datetime" | "timestamp" => "Time",
        "array" | "vec" | "vector" | "list" | "sequence" => "List",
        "dict" | "dictionary" | "map" | "hashmap" => "Map",
        "hashset" | "set" => "Set",
        _ => return None,
    })
}

/// The value of a literal without a unit and without a fraction. It may be 2^63, one more than an Int
/// holds, because the least Int is written with it.
pub(crate) fn integer(text: &str) -> Option<u64> {
    let digits = text.bytes().filter(|byte| *byte != b'_');
    let value = digits
        .map(|byte| u64::from(byte.wrapping_sub(b'0')))
        .try_fold(0_u64, |value, digit| {
            value.checked_mul(10)?.checked_add(digit)
        })?;
    (value <= i64::MIN.unsigned_abs()).then_some(value)
}

/// The value of a number that is a Float, in metres or radians if it has a unit; none if it is too
/// large for one.
pub(crate) fn float(text: &str) -> Option<f64> {
    let (digits, unit) = split(text);
    let number = plain(digits)?;
    let value = match unit {
        Some(unit) => number * unit.size / unit.parts,
        None => number,
    };
    value.is_finite().then_some(value)
}

/// The value of a duration, in nanoseconds, rounded to the nearest; none if it is too long. A whole
/// number of the unit is exact, and so is a fraction if its value has at most 15 digits. The machine
/// holds durations in 63 bits.
pub(crate) fn duration(text: &str) -> Option<u64> {
    const LONGEST: u64 = i64::MAX.unsigned_abs();
    let (digits, unit) = split(text);
    let unit = unit?;
    if let Some(count) = integer(digits).filter(|_| !digits.contains(['.', 'e', 'E'])) {
        let nanoseconds = count.checked_mul(unit.size as u64)?;
        return (nanoseconds <= LONGEST).then_some(nanoseconds);
    }
    let nanoseconds = (plain(digits)? * unit.size).round();
    (nanoseconds < LONGEST as f64).then_some(nanoseconds as u64)
}

fn plain(digits: &str) -> Option<f64> {
    let digits: String = digits
        .chars()
        .filter(|character| *character != '_')
        .collect();
    digits.parse().ok()
}

/// The number and the unit after it.
fn split(text: &str) -> (&str, Option<&'static Unit>) {
    let letters = text
        .bytes()
        .rev()
        .take_while(u8::is_ascii_alphabetic)
        .count();
    let (digits, name) = text.split_at(text.len() - letters);
    (digits, unit(name))
}

/// A flaw of a string literal: its bytes and the problem.
pub(crate) type StringFlaw = (core::ops::Range<usize>, &'static str);

/// The value of a string literal in double quotes, and the flaws of its escapes, which are left out.
pub(crate) fn string(text: &str) -> (String, alloc::vec::Vec<StringFlaw>) {
    let inner = text.strip_prefix('"').unwrap_or(text);
    let inner = inner.strip_suffix('"').unwrap_or(inner);
    let start = usize::from(text.starts_with('"'));
    let (mut value, mut flaws) = (String::with_capacity(inner.len()), alloc::vec::Vec::new());
    let mut at = 0;
    while let Some(character) = inner[at..].chars().next() {
        if character != '\\' {
            value.push(character);
            at += character.len_utf8();
            continue;
        }
        let length = match escape(&inner[at..]) {
            Ok((character, length)) => {
                value.push(character);
                length
            }
            Err((message, length)) => {
                flaws.push((start + at..start + at + length, message));
                length
            }
        };
        at += length;
    }
    (value, flaws)
}

/// The character that the escape at the start of the text means, and how long the escape is.
fn escape(text: &str) -> Result<(char, usize), (&'static str, usize)> {
    let second = text[1..].chars().next();
    let character = match second {
        Some('n') => '\n',
        Some('t') => '\t',
        Some('r') => '\r',
        Some('"') => '"',
        Some('\\') => '\\',
        Some('u') => return unicode_escape(text),
        Some(other) => return Err(("there is no such escape", 1 + other.len_utf8())),
        None => return Err(("an escape needs a character after it", 1)),
    };
    Ok((character, 2))
}

fn unicode_escape(text: &str) -> Result<(char, usize), (&'static str, usize)> {
    let Some(rest) = text.strip_prefix("\\u{") else {
        return Err(("a character by its number is written `\\u{e9}`", 2));
    };
    let digits = rest.bytes().take_while(u8::is_ascii_hexdigit).count();
    if !rest[digits..].starts_with('}') {
        return Err(("a character by its number is written `\\u{e9}`", 3 + digits));
    }
    let number = u32::from_str_radix(&rest[..digits], 16)
        .ok()
        .and_then(char::from_u32);
    number
        .map(|character| (character, 4 + digits))
        .ok_or(("no character has this number", 4 + digits))
}
