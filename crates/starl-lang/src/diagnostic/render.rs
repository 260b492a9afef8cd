//! Diagnostics as a person reads them in a terminal: the source around the place, with a mark under it.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use codespan_reporting::diagnostic::{Diagnostic as Shown, Label, LabelStyle, Severity as Weight};
use codespan_reporting::files::SimpleFile;
use codespan_reporting::term::{self, Config, termcolor};

use super::{Diagnostic, Severity, Span};

/// Whether a terminal is told to colour the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colour {
    /// Plain text.
    Off,
    /// With the escape sequences of ANSI terminals.
    On,
}

/// The diagnostics of one file in the order given, each as a few lines with an empty one after it.
/// `name` is what the file is called there.
#[must_use]
pub fn render(name: &str, source: &str, diagnostics: &[Diagnostic], colour: Colour) -> String {
    let visible = visible(source);
    let file = SimpleFile::new(name, visible.as_str());
    let config = Config {
        tab_width: 4,
        ..Config::default()
    };
    let mut text = String::new();
    for diagnostic in diagnostics {
        let shown = shown(diagnostic, source);
        // Spans are cut to the source, so that nothing can be outside of it.
        let part = match colour {
            Colour::Off => term::emit_into_string(&config, &file, &shown).ok(),
            Colour::On => {
                let mut writer = termcolor::Ansi::new(Vec::new());
                let done = term::emit_to_write_style(&mut writer, &config, &file, &shown);
                done.ok()
                    .and_then(|()| String::from_utf8(writer.into_inner()).ok())
            }
        };
        text.push_str(&part.unwrap_or_else(|| format!("{}: {}\n", shown.message, name)));
    }
    text
}

/// The source with a sign in the place of each character that would not be seen, or that would change
/// what a terminal does, of the same length in bytes.
fn visible(source: &str) -> String {
    let sign = |character: char| match character {
        '\n' | '\r' | '\t' => character,
        '\u{202a}'..='\u{202e}'
        | '\u{2066}'..='\u{2069}'
        | '\u{200b}'..='\u{200f}'
        | '\u{feff}' => '\u{fffd}',
        _ if character.is_control() && character.len_utf8() == 1 => '?',
        _ if character.is_control() => '\u{bf}',
        _ => character,
    };
    source.chars().map(sign).collect()
}

fn shown(diagnostic: &Diagnostic, source: &str) -> Shown<()> {
    let weight = match diagnostic.severity() {
        Severity::Error => Weight::Error,
        Severity::Warning => Weight::Warning,
    };
    let mut labels = Vec::new();
    let primary = Label::new(LabelStyle::Primary, (), range(diagnostic.span, source));
    labels.push(match &diagnostic.note_at_span {
        Some(words) => primary.with_message(words),
        None => primary,
    });
    for label in &diagnostic.labels {
        let secondary = Label::new(LabelStyle::Secondary, (), range(label.span, source));
        labels.push(secondary.with_message(&label.message));
    }
    Shown::new(weight)
        .with_code(diagnostic.code.number())
        .with_message(&diagnostic.message)
        .with_labels(labels)
        .with_notes(notes(diagnostic))
}

fn notes(diagnostic: &Diagnostic) -> Vec<String> {
    let mut notes = Vec::new();
    match (&diagnostic.expected, &diagnostic.found) {
        (Some(expected), Some(found)) => {
            notes.push(format!("expected: {expected}\n   found: {found}"));
        }
        (Some(expected), None) => notes.push(format!("expected: {expected}")),
        (None, Some(found)) => notes.push(format!("found: {found}")),
        (None, None) => {}
    }
    notes.extend(diagnostic.notes.iter().cloned());
    notes.extend(
        diagnostic
            .mend
            .iter()
            .map(|mend| format!("mend: {}", mend.message)),
    );
    notes
}

/// The span as a range that lies in the source and starts and ends between characters.
fn range(span: Span, source: &str) -> core::ops::Range<usize> {
    let start = source.floor_char_boundary((span.start as usize).min(source.len()));
    let end = source.ceil_char_boundary((span.end as usize).min(source.len()));
    start..end.max(start)
}
