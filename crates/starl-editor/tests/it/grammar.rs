//! The grammar by which editors colour programs has every word of the language.

use crate::common;
use std::collections::BTreeSet;

use crate::support::analysis;
use serde_json::Value;
use starl_editor::{TokenKind, tokens};
use starl_lang::syntax::{Language, SyntaxKind};

const GRAMMAR: &str = include_str!("../../../../editors/vscode/syntaxes/starl.tmLanguage.json");

/// The words in the patterns of the grammar.
fn words() -> BTreeSet<String> {
    let grammar: Value = serde_json::from_str(GRAMMAR).expect("the grammar is JSON");
    let mut words = BTreeSet::new();
    collect(&grammar["repository"], &mut words);
    words
}

fn collect(part: &Value, words: &mut BTreeSet<String>) {
    match part {
        Value::Object(fields) => {
            for (name, value) in fields {
                match (name.as_str(), value) {
                    ("match" | "begin" | "end", Value::String(pattern)) => {
                        // `\b` and similar characters are not part of a word.
                        let pattern = pattern.replace("\\b", " ").replace("\\s", " ");
                        let is_part = |letter: char| letter == '_' || letter.is_alphanumeric();
                        let parts = pattern.split(|letter| !is_part(letter));
                        words.extend(parts.map(str::to_string));
                    }
                    _ => collect(value, words),
                }
            }
        }
        Value::Array(parts) => parts.iter().for_each(|part| collect(part, words)),
        _ => {}
    }
}

/// The reserved words.
fn keywords() -> Vec<&'static str> {
    use rowan::Language as _;
    let kinds = 0..=SyntaxKind::OnKeyword as u16;
    let kinds = kinds.map(|raw| Language::kind_from_raw(rowan::SyntaxKind(raw)));
    let keywords = kinds.filter(|kind| kind.is_keyword());
    keywords.filter_map(SyntaxKind::text).collect()
}

#[test]
fn every_reserved_word() {
    let words = words();
    let keywords = keywords();
    assert_eq!(keywords.len(), 18, "{keywords:?}");
    for keyword in keywords {
        assert!(words.contains(keyword), "`{keyword}` is not in the grammar");
    }
}

#[test]
fn every_word_that_has_a_meaning_in_its_place() {
    let words = words();
    let texts = common::written().map(|(_, text)| text);
    let mut found = BTreeSet::new();
    for text in texts.chain(["library tools\n"]) {
        let tokens = tokens(&analysis(text)).into_iter();
        let own = tokens.filter(|token| token.kind == TokenKind::Keyword);
        found.extend(own.map(|token| token.span.of(text).to_string()));
    }
    for word in [
        "library", "allwrite", "role", "leads_to", "exists", "atomic",
    ] {
        assert!(found.contains(word), "no text has `{word}`");
    }
    for word in found {
        assert!(words.contains(&word), "`{word}` is not in the grammar");
    }
}

#[test]
fn every_unit() {
    let words = words();
    for unit in [
        "ns", "us", "ms", "s", "min", "h", "mm", "cm", "m", "km", "deg", "rad",
    ] {
        assert!(words.contains(unit), "`{unit}` is not in the grammar");
    }
}
