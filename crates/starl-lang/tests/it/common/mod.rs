//! Common code of the tests of the language and of its tools: example programs, and the properties of any text.

pub mod deep;
pub mod generator;
pub mod mutation;

use starl_lang::diagnostic::{Code, Severity, has_errors};
use starl_lang::syntax::{Parse, SyntaxKind, parse};

/// The thesis's four listings, by name.
pub const LISTINGS: &[(&str, &str)] = &[
    ("race", include_str!("../../listings/race.starl")),
    (
        "mutex_usage",
        include_str!("../../listings/mutex_usage.starl"),
    ),
    (
        "intersection",
        include_str!("../../listings/intersection.starl"),
    ),
    ("formation", include_str!("../../listings/formation.starl")),
];

/// A program that uses every form of the language.
pub const EVERY_FORM: &str = include_str!("../../listings/every_form.starl");

/// All programs that are written down.
pub fn written() -> impl Iterator<Item = (&'static str, &'static str)> {
    LISTINGS.iter().copied().chain([("every_form", EVERY_FORM)])
}

/// Parses a text and checks the guarantees for every text: the tree's text is the text, every diagnostic is within it,
/// and nothing is omitted without an error.
pub fn parsed(text: &str) -> Parse {
    let parse = parse(text);
    assert_eq!(
        parse.syntax().text().to_string(),
        text,
        "the tree's text is not the source"
    );
    for diagnostic in parse.diagnostics() {
        let spans = diagnostic
            .labels
            .iter()
            .map(|label| label.span)
            .chain([diagnostic.span]);
        for span in spans {
            let inside = span.start <= span.end
                && text.get(span.start as usize..span.end as usize).is_some();
            assert!(inside, "{diagnostic:?} lies outside of {text:?}");
        }
        for edit in diagnostic.fix.iter().flat_map(|fix| &fix.edits) {
            let range = edit.span.start as usize..edit.span.end as usize;
            assert!(
                text.get(range).is_some(),
                "{diagnostic:?} fixes outside of {text:?}"
            );
        }
    }
    let skipped = parse
        .syntax()
        .descendants()
        .any(|node| node.kind() == SyntaxKind::Error);
    let told = has_errors(parse.diagnostics());
    assert!(
        told || !skipped,
        "something is left out without a word: {text:?}"
    );
    parse
}

/// Whether it has errors other than tabs, which formatting fixes.
pub fn is_wrong(parse: &Parse) -> bool {
    parse.diagnostics().iter().any(|diagnostic| {
        diagnostic.severity() == Severity::Error && diagnostic.code != Code::TabIndentation
    })
}
