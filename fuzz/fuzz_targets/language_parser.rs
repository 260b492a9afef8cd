//! Reading any text gives a tree of the whole of it; diagnostics and fixes are within the text and
//! can be shown; formatting keeps the meaning and is stable. Seeds: `fuzz/seeds/language`.

#![no_main]

use formatting::tokens;
use libfuzzer_sys::fuzz_target;
use starl_editor::format::format_parse;
use starl_lang::diagnostic::{Colour, has_errors, json, render};
use starl_lang::syntax::{SyntaxKind, parse};

#[allow(dead_code, reason = "the tests use the rest")]
#[path = "../../crates/starl-editor/tests/it/support/formatting.rs"]
mod formatting;

fuzz_target!(|text: &str| {
    let read = parse(text);
    assert_eq!(read.syntax().text().to_string(), text);
    let skipped = read
        .syntax()
        .descendants()
        .any(|node| node.kind() == SyntaxKind::Error);
    assert!(!skipped || has_errors(read.diagnostics()));
    for diagnostic in read.diagnostics() {
        let spans = diagnostic
            .labels
            .iter()
            .map(|label| label.span)
            .chain([diagnostic.span]);
        for span in spans {
            assert!(span.start <= span.end);
            assert!(text.get(span.start as usize..span.end as usize).is_some());
        }
        if let Some(fix) = &diagnostic.fix {
            assert_ne!(fix.apply(text), text);
        }
    }
    if read.diagnostics().len() < 50 {
        let _ = render("fuzz.starl", text, read.diagnostics(), Colour::Off);
        let _ = json("fuzz.starl", text, read.diagnostics());
    }
    let formatted = format_parse(&read);
    let again = parse(&formatted);
    assert_eq!(tokens(&read), tokens(&again));
    assert_eq!(format_parse(&again), formatted);
});
