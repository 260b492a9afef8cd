//! In programs without errors every word is a name that is known, or a word of the language.

use crate::common;
use crate::support::analysis;
use starl_editor::{TokenKind, tokens};
use starl_lang::check::Symbol;
use starl_lang::diagnostic::Span;
use starl_lang::syntax::SyntaxKind;

/// Words that stand for nothing: what an event's fields are called, and `_`.
fn is_free(before: &str, word: &str) -> bool {
    word == "_"
        || before
            .lines()
            .last()
            .is_some_and(|line| line.contains("emit("))
}

#[test]
fn in_the_listings() {
    for (name, text) in common::LISTINGS {
        let analysis = analysis(text);
        let known = tokens(&analysis);
        let root = analysis.checked.files[0].parse.syntax();
        let all = root.descendants_with_tokens();
        let words = all.filter_map(|element| element.into_token());
        for word in words.filter(|word| word.kind() == SyntaxKind::Identifier) {
            let span = Span::from(word.text_range());
            let found = known.iter().any(|token| token.span == span);
            let free = is_free(&text[..span.start as usize], word.text());
            assert!(found || free, "{} at {span:?} of {name}", word.text());
        }
    }
}

#[test]
fn names_are_not_mistaken_for_keywords() {
    for (name, text) in common::LISTINGS {
        let analysis = analysis(text);
        let names = analysis.occurrences();
        for token in tokens(&analysis) {
            let is_name = names.iter().any(|one| one.site.span == token.span);
            assert_eq!(
                is_name,
                !matches!(
                    token.kind,
                    TokenKind::Keyword | TokenKind::Comment | TokenKind::Number | TokenKind::String
                ),
                "{:?} of {name}",
                token.span.of(text)
            );
        }
        let locals = names
            .iter()
            .filter(|one| matches!(one.symbol, Symbol::Local(_)));
        for local in locals {
            let Symbol::Local(site) = local.symbol else {
                continue;
            };
            assert_eq!(site.span.of(text), local.site.span.of(text), "{name}");
        }
    }
}
