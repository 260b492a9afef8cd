//! Problems of single tokens.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::{SyntaxKind, SyntaxKind::*, Tokens};
use crate::diagnostic::{Code, Diagnostic, Span, closest};
use crate::syntax::literal::{self, UNITS};

/// The problems of the tokens of `text`, in order.
pub(crate) fn problems(text: &str, tokens: &Tokens) -> Vec<Diagnostic> {
    let mut problems = Vec::new();
    let mut before = EndOfFile;
    for (index, kind) in tokens.kinds().iter().enumerate() {
        let span = tokens.span(index);
        match kind {
            // Most tokens.
            Whitespace | Newline | DocComment => continue,
            Identifier => problems.extend(letters(span.of(text), span)),
            IntegerLiteral => problems.extend(integer(span.of(text), span, before)),
            FloatLiteral | LengthLiteral | AngleLiteral => {
                problems.extend(float(span.of(text), span))
            }
            DurationLiteral => problems.extend(duration(span.of(text), span)),
            MalformedNumber => problems.push(malformed_number(span.of(text), span)),
            StringLiteral => string(span.of(text), span, &mut problems),
            MalformedString => problems.push(malformed_string(span.of(text), span)),
            Comment => problems.extend(comment(text, span)),
            Unknown => problems.push(unknown(text, span)),
            _ => problems.extend(spelling(*kind, text, span)),
        }
        before = *kind;
    }
    problems
}

/// The names of all units, in a sentence.
fn unit_names() -> String {
    let names: Vec<&str> = UNITS.iter().map(|unit| unit.name).collect();
    names.join(" ")
}

fn letters(name: &str, span: Span) -> Option<Diagnostic> {
    let other = name.chars().find(|character| !character.is_ascii())?;
    let message = format!("a name cannot contain `{}`", other.escape_debug());
    let problem = Diagnostic::new(Code::UnknownCharacter, span, message);
    Some(problem.note("names are made of the letters a to z and A to Z, digits and `_`"))
}

fn integer(number: &str, span: Span, before: SyntaxKind) -> Option<Diagnostic> {
    let largest = i64::MAX.unsigned_abs() + u64::from(before == Minus);
    if literal::integer(number).is_some_and(|value| value <= largest) {
        return None;
    }
    let message = "this number is too large for an Int";
    let problem = Diagnostic::new(Code::MalformedNumber, span, message);
    Some(problem.note(format!("the largest Int is {}", i64::MAX)))
}

fn float(number: &str, span: Span) -> Option<Diagnostic> {
    let message = "this number is too large for a Float";
    let too_large = || Diagnostic::new(Code::MalformedNumber, span, message);
    literal::float(number).is_none().then(too_large)
}

fn duration(number: &str, span: Span) -> Option<Diagnostic> {
    let too_long = || {
        Diagnostic::new(Code::MalformedNumber, span, "this duration is too long")
            .note("the longest Duration is about 292 years")
    };
    literal::duration(number).is_none().then(too_long)
}

fn malformed_number(text: &str, span: Span) -> Diagnostic {
    let digits = text
        .find(|c: char| c.is_alphabetic() || c == '_')
        .unwrap_or(text.len());
    let digits = text[..digits].trim_end_matches('_').len();
    let suffix = &text[digits..];
    let place = Span::new(span.start + digits as u32, span.end);
    if text.starts_with('0') && matches!(suffix.as_bytes().first(), Some(b'x' | b'X' | b'b' | b'o'))
    {
        let message = "numbers are written with the digits 0 to 9 only";
        return Diagnostic::new(Code::MalformedNumber, span, message);
    }
    let message = format!("there is no unit `{suffix}`");
    let problem = Diagnostic::new(Code::MalformedNumber, place, message)
        .note(format!("the units are {}", unit_names()));
    if matches!(suffix, "mps" | "ms2" | "mps2") {
        let end = if text[..digits].contains('.') {
            ""
        } else {
            ".0"
        };
        let form = format!(
            "write `{}{end}`, a Float in metres per second",
            &text[..digits]
        );
        return problem.replace(form, place, end);
    }
    let closest = || closest(suffix, UNITS.iter().map(|unit| unit.name));
    match literal::unit_meant(suffix).or_else(closest) {
        Some(name) => problem.write(place, name),
        None => problem,
    }
}

fn string(text: &str, span: Span, problems: &mut Vec<Diagnostic>) {
    for (part, message) in literal::string(text).1 {
        let place = Span::new(span.start + part.start as u32, span.start + part.end as u32);
        let problem = Diagnostic::new(Code::MalformedString, place, message);
        problems.push(problem.note("the escapes are \\n \\t \\r \\\" \\\\ and \\u{...}"));
    }
}

fn malformed_string(text: &str, span: Span) -> Diagnostic {
    if let Some(inner) = text
        .strip_prefix('\'')
        .and_then(|text| text.strip_suffix('\''))
    {
        let inner = inner.replace("\\'", "'").replace('"', "\\\"");
        let problem = Diagnostic::new(Code::MalformedString, span, "strings are in double quotes");
        return problem.replace("use double quotes", span, format!("\"{inner}\""));
    }
    let message = "this string does not end on its line";
    let problem = Diagnostic::new(Code::MalformedString, span, message);
    problem.replace("close it with `\"`", Span::empty(span.end), "\"")
}

fn comment(text: &str, span: Span) -> Option<Diagnostic> {
    let comment = span.of(text);
    let problem = Diagnostic::new(Code::ForeignComment, span, "a comment starts with `//`");
    if comment.starts_with('#') {
        return Some(problem.write(Span::new(span.start, span.start + 1), "//"));
    }
    let inner = comment.strip_prefix("/*")?;
    let inner = inner.strip_suffix("*/").unwrap_or(inner).trim();
    let problem = problem.note("there are no comments between `/*` and `*/`");
    // Where more is on its lines, that would become a part of it.
    let rest = text[span.end as usize..].lines().next().unwrap_or_default();
    if inner.contains('\n') || !rest.trim().is_empty() {
        return Some(problem);
    }
    Some(problem.replace("write it after `//`", span, format!("// {inner}")))
}

fn unknown(text: &str, span: Span) -> Diagnostic {
    let word = |word| apart(word, text, span);
    let character = span.of(text).chars().next().unwrap_or_default();
    let problem = |message: String| Diagnostic::new(Code::UnknownCharacter, span, message);
    match character {
        '“' | '”' | '„' => problem(format!(
            "`{character}` is not a quotation mark of a program"
        ))
        .write(span, "\""),
        '°' => {
            let end = text[..span.start as usize].trim_end_matches(' ').len() as u32;
            let place = Span::new(end, span.end);
            problem("an angle in degrees is written `90deg`".into()).write(place, "deg")
        }
        '^' => problem("there is no operator `^`".into()).note("a power is written `pow(a, b)`"),
        '∀' => problem("`∀` is written `forall`".into()).write(span, word("forall")),
        '∃' => problem("`∃` is written `exists`".into()).write(span, word("exists")),
        _ if character.is_whitespace() => {
            let message = format!("not a plain space: U+{:04X}", u32::from(character));
            problem(message).replace("write a space", span, " ")
        }
        _ if character.is_control() || character.escape_debug().len() > 1 => problem(format!(
            "the character U+{:04X} has no meaning here",
            u32::from(character)
        )),
        _ => problem(format!("`{character}` has no meaning here")),
    }
}

/// A token that has one spelling but is written in another.
fn spelling(kind: SyntaxKind, text: &str, span: Span) -> Option<Diagnostic> {
    let (right, found) = (kind.text()?, span.of(text));
    if right == found {
        return None;
    }
    let message = format!("`{found}` is written `{right}`");
    let problem = Diagnostic::new(Code::ForeignOperator, span, message);
    Some(problem.write(span, apart(right, text, span)))
}

/// `word` with the spaces that it needs in place of what `span` marks.
fn apart(word: &str, text: &str, span: Span) -> String {
    let is_part = |character: char| character.is_alphanumeric() || character == '_';
    let before = text[..span.start as usize]
        .chars()
        .next_back()
        .is_some_and(|c| !c.is_whitespace() && c != '(');
    let after = text[span.end as usize..]
        .chars()
        .next()
        .is_some_and(|c| !c.is_whitespace());
    let is_word = word.starts_with(is_part);
    let space = |needed: bool| if needed && is_word { " " } else { "" };
    format!("{}{word}{}", space(before), space(after))
}
