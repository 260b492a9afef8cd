//! No text nests so deeply, or is so long, that reading it overflows the stack or takes for ever.

use crate::common::deep::deep;
use crate::common::{is_wrong, parsed};
use starl_lang::diagnostic::Code;
use starl_lang::syntax::{MAX_LENGTH, parse};

#[test]
fn too_deep_nesting_is_an_error() {
    for text in deep(3000) {
        let parse = parsed(&text);
        let line: String = text.chars().skip(11).take(60).collect();
        assert!(is_wrong(&parse), "{line}");
        assert!(
            parse.diagnostics().len() < 10_000,
            "{line}: {}",
            parse.diagnostics().len()
        );
    }
}

#[test]
fn ordinary_programs_are_not_too_deep() {
    for text in deep(15) {
        let too_deep = parsed(&text)
            .diagnostics()
            .iter()
            .any(|diagnostic| diagnostic.code == Code::TooDeep);
        assert!(!too_deep, "{text}");
    }
}

#[test]
fn every_depth_around_the_limit_is_read_whole() {
    for count in 150..250 {
        for text in deep(count) {
            parsed(&text);
        }
    }
}

#[test]
fn many_problems_on_a_line_are_read_in_no_time() {
    let pieces = [
        "(", ")", "[", "{", "x ", "1 ", "+ ", ", ", "$", "\n", ";", " \n", "//\n", "if ", "a,\n",
        "\u{e9}", "x:",
    ];
    for piece in pieces {
        parsed(&piece.repeat(50_000));
        parsed(&format!("program P\n\nx: Int = f({}", piece.repeat(50_000)));
    }
}

#[test]
fn too_long_texts_are_not_read() {
    let text = "x".repeat(MAX_LENGTH + 1);
    let parse = parse(&text);
    assert_eq!(parse.diagnostics()[0].code, Code::TooLong);
    assert_eq!(
        parse.syntax().text().len(),
        u32::try_from(text.len()).unwrap().into()
    );
}
