//! The tokens of any text put together are the text, and whatever is malformed is reported. Seeds:
//! `fuzz/seeds/language`.

#![no_main]

use libfuzzer_sys::fuzz_target;
use starl_lang::syntax::{SyntaxKind, parse};

fuzz_target!(|text: &str| {
    let parse = parse(text);
    let mut end = 0;
    let elements = parse.syntax().descendants_with_tokens();
    for token in elements.filter_map(|element| element.into_token()) {
        let range = token.text_range();
        assert_eq!(usize::from(range.start()), end);
        end = usize::from(range.end());
        assert_eq!(token.text(), &text[usize::from(range.start())..end]);
        assert!(!token.text().is_empty());
        let malformed = matches!(
            token.kind(),
            SyntaxKind::Unknown | SyntaxKind::MalformedNumber | SyntaxKind::MalformedString
        );
        let reported = |start: u32, stop: u32| {
            parse
                .diagnostics()
                .iter()
                .any(|problem| problem.span.start >= start && problem.span.end <= stop)
        };
        assert!(
            !malformed || reported(range.start().into(), range.end().into()),
            "{token:?}"
        );
    }
    assert_eq!(end, text.len());
});
