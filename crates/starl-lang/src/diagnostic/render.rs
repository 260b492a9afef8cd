//! Diagnostics as a person reads them in a terminal: the source around the place, with a mark under it.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use codespan_reporting::diagnostic::{Diagnostic as Shown, Label, LabelStyle, Severity as Weight};
use codespan_reporting::files::{Files, SimpleFile};
use codespan_reporting::term::{self, Config, termcolor};

use super::excerpt::{self, Excerpt};
use super::{Diagnostic, Severity, Span};

/// Whether the text is coloured for a terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colour {
    /// Plain text.
    Off,
    /// With the escape sequences of ANSI terminals.
    On,
}

/// The most diagnostics shown of a file. Users read only the first ones, and a fix often removes several.
const MOST: usize = 20;
/// When so many lines are shown, no further warning is: they fill a screen.
const SCREEN: usize = 60;

/// The diagnostics of one file in the order given, each as a few lines with an empty one after it. Lines that are too
/// long for a screen are cut. If there are too many, warnings are left out first. `name` is the name of the file in the
/// text.
#[must_use]
pub fn render(name: &str, source: &str, diagnostics: &[Diagnostic], colour: Colour) -> String {
    let visible = visible(source);
    let file = SimpleFile::new(name, visible.as_str());
    let is_cut = excerpt::is_needed(&visible);
    let mut parts: Vec<(usize, String)> = Vec::new();
    let mut lines = 0;
    let errors_first = [Severity::Error, Severity::Warning].into_iter();
    let errors_first = errors_first.flat_map(|severity| {
        let numbered = diagnostics.iter().enumerate();
        numbered.filter(move |(_, diagnostic)| diagnostic.severity() == severity)
    });
    for (index, diagnostic) in errors_first.take(MOST) {
        if lines >= SCREEN && diagnostic.severity() == Severity::Warning {
            break;
        }
        let mut shown = shown(diagnostic, source);
        let part = match is_cut {
            false => written(&file, &shown, colour),
            true => {
                let place = range(diagnostic.span, source).start;
                let excerpt = Excerpt::around(name, &visible, place);
                for label in &mut shown.labels {
                    label.range = excerpt.range(&label.range);
                }
                written(&excerpt, &shown, colour)
            }
        };
        let part = part.unwrap_or_else(|| format!("{}: {}\n", shown.message, name));
        lines += part.matches('\n').count();
        parts.push((index, part));
    }
    let more = diagnostics.len() - parts.len();
    parts.sort_by_key(|&(index, _)| index);
    let mut text: String = parts.into_iter().map(|(_, part)| part).collect();
    if more > 0 {
        let (problems, verb) = match more {
            1 => ("problem", "is"),
            _ => ("problems", "are"),
        };
        text.push_str(&format!(
            "{more} more {problems} of {name} {verb} not shown; `starl check --json` lists all\n\n"
        ));
    }
    text
}

/// One diagnostic. Spans are cut to the source, so that nothing can be outside of it.
fn written<'a>(
    files: &'a impl Files<'a, FileId = ()>,
    shown: &Shown<()>,
    colour: Colour,
) -> Option<String> {
    let config = Config {
        tab_width: 4,
        ..Config::default()
    };
    match colour {
        Colour::Off => term::emit_into_string(&config, files, shown).ok(),
        Colour::On => {
            let mut writer = termcolor::Ansi::new(Vec::new());
            term::emit_to_write_style(&mut writer, &config, files, shown).ok()?;
            String::from_utf8(writer.into_inner()).ok()
        }
    }
}

/// The source with a sign in place of each character that would not be seen, or that would change what a terminal does,
/// of the same length in bytes.
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
            .fix
            .iter()
            .map(|fix| format!("fix: {}", fix.message)),
    );
    notes
}

/// The span as a range that lies in the source and starts and ends between characters.
fn range(span: Span, source: &str) -> core::ops::Range<usize> {
    let start = source.floor_char_boundary((span.start as usize).min(source.len()));
    let end = source.ceil_char_boundary((span.end as usize).min(source.len()));
    start..end.max(start)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::Code;

    fn error_at(source: &str, start: usize, length: usize) -> String {
        let span = Span {
            start: start as u32,
            end: (start + length) as u32,
        };
        let error = Diagnostic::new(Code::TooDeep, span, "too deep");
        render("deep.starl", source, &[error], Colour::Off)
    }

    #[test]
    fn a_long_line_is_cut_around_the_place_and_keeps_its_column() {
        let before = "-- \u{e4}\n";
        for filler in ["(", "\u{673a}"] {
            let line = format!("{}here{}", filler.repeat(5000), filler.repeat(9000));
            let source = format!("{before}{line}\nlast");
            let start = before.len() + 5000 * filler.len();
            let text = error_at(&source, start, 4);
            assert!(text.contains("deep.starl:2:5001"), "{text}");
            assert!(text.contains("here") && text.contains('\u{2026}'), "{text}");
            assert!(text.lines().all(|line| line.len() < 320), "{text}");
            // The mark is under the word.
            let lines: Vec<&str> = text.lines().collect();
            let marked = lines.iter().position(|line| line.contains("^^^^")).unwrap();
            assert!(lines[marked - 1].contains("here"), "{text}");
            // A line behind a cut one keeps its number.
            let after = error_at(&source, source.len() - 4, 4);
            assert!(
                after.contains("deep.starl:3:1") && after.contains("3 \u{2502} last"),
                "{after}"
            );
            assert!(error_at(&source, source.len(), 0).contains("deep.starl:3:5"));
        }
    }

    #[test]
    fn a_flood_of_errors_is_cut() {
        let source = "{".repeat(3000);
        let error = |at: u32| {
            let span = Span {
                start: at,
                end: at + 1,
            };
            Diagnostic::new(Code::TooDeep, span, "too deep")
        };
        let errors: Vec<Diagnostic> = (0..3000).map(error).collect();
        let text = render("deep.starl", &source, &errors, Colour::Off);
        assert!(text.len() < 100_000, "{}", text.len());
        assert!(text.ends_with(
            "2980 more problems of deep.starl are not shown; `starl check --json` lists all\n\n"
        ));
    }

    /// They were 20 warnings on 164 lines, without the error.
    #[test]
    fn warnings_of_deep_nesting_do_not_hide_its_error() {
        let source = "x\n".repeat(100);
        let problem = |code, at: u32| {
            let span = Span {
                start: at,
                end: at + 1,
            };
            Diagnostic::new(code, span, "problem")
        };
        let warnings = (0..99).map(|line| problem(Code::HeaderColon, 2 * line));
        let all: Vec<_> = warnings.chain([problem(Code::TooDeep, 198)]).collect();
        let text = render("deep.starl", &source, &all, Colour::Off);
        assert!(text.lines().count() < SCREEN + 12, "{text}");
        let (warning, error) = (text.find("deep.starl:1:1"), text.find("error[E0120]"));
        assert!(warning.is_some() && warning < error, "{text}");
    }
}
