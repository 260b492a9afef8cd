//! For every text and cursor, the services answer, with positions within the text.

use crate::common::{self, mutation};
use crate::support::edited;
use starl_editor::format::format;
use starl_editor::{Analysis, OutlineEntry, completions, layout, outline, tokens};
use starl_lang::check::StandardLibraries;
use starl_lang::diagnostic::Span;

/// Asks everything at some places of the text.
fn ask(text: &str, every: usize) {
    let analysis = Analysis::new(text, &StandardLibraries);
    let inside = |span: Span| {
        assert!(
            text.get(span.start as usize..span.end as usize).is_some(),
            "{span:?}"
        );
    };
    for token in tokens(&analysis) {
        inside(token.span);
    }
    let mut open: Vec<OutlineEntry> = outline(&analysis.checked.files[0].parse);
    while let Some(entry) = open.pop() {
        inside(entry.span);
        inside(entry.name_span);
        open.extend(entry.parts);
    }
    assert_eq!(edited(text, &layout(text)), format(text));
    for name in analysis.occurrences() {
        inside(name.site.span);
        let shown = analysis.describe(name.symbol);
        assert!(!shown.signature.is_empty(), "{name:?}");
    }
    let places = (0..=text.len()).filter(|at| text.is_char_boundary(*at));
    for at in places.step_by(every) {
        let at = at as u32;
        if let Some((span, _)) = analysis.hover(at) {
            inside(span);
        }
        inside(completions(text, at, &StandardLibraries).span);
        if let Some(help) = analysis.call_help(at) {
            let last = help.parameters.last().map_or(0, |span| span.end as usize);
            assert!(last <= help.signature.len(), "{help:?}");
            assert!(
                help.active
                    .is_none_or(|active| active < help.parameters.len())
            );
        }
        if let Ok(found) = analysis.renameable(at) {
            let _ = analysis.rename(found.symbol, "something_else", &StandardLibraries);
        }
    }
}

#[test]
fn every_place_of_a_listing() {
    let (_, race) = common::LISTINGS[0];
    ask(race, 1);
}

#[test]
fn a_text_that_is_being_typed() {
    let (_, formation) = common::LISTINGS[3];
    let ends = (0..formation.len()).filter(|at| formation.is_char_boundary(*at));
    for end in ends.step_by(7) {
        let text = &formation[..end];
        ask(text, text.len().max(1));
    }
}

#[test]
fn texts_that_are_not_programs() {
    for text in [
        "",
        "\n",
        "\u{feff}",
        "program",
        "\u{1f600}",
        "program P\n\u{1f600}: Int\n",
        ".",
        "a.",
        "((((",
        "\t\t",
        "on",
        "role\n",
    ] {
        ask(text, 1);
    }
}

#[test]
fn listings_with_random_changes_and_noise() {
    for seed in 0..40 {
        let (_, listing) = common::LISTINGS[seed as usize % common::LISTINGS.len()];
        let text = mutation::mutated(listing, seed);
        ask(&text, 97);
        let text = mutation::noise(seed);
        ask(&text, 31);
    }
}
