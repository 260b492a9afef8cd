//! Formatting changes neither tokens nor the tree, and formatting again changes nothing.

use crate::common::{generator, is_wrong, mutation, parsed, written};
use crate::support::formatting::tokens;
use starl_editor::format::format;
use starl_lang::syntax::{Parse, SyntaxKind};

/// The shape of the tree: nodes and tokens by kind, without trivia and line ends.
fn shape(parse: &Parse) -> String {
    let mut shape = String::new();
    for event in parse.syntax().preorder_with_tokens() {
        match event {
            rowan::WalkEvent::Enter(element) => match element.kind() {
                kind if kind.is_trivia() || kind == SyntaxKind::Newline => {}
                kind => shape += &format!("({kind:?} "),
            },
            rowan::WalkEvent::Leave(element) => match element.kind() {
                kind if kind.is_trivia() || kind == SyntaxKind::Newline => {}
                _ => shape.push(')'),
            },
        }
    }
    shape
}

fn check(text: &str) {
    let before = parsed(text);
    let formatted = format(text);
    let after = parsed(&formatted);
    assert_eq!(
        tokens(&before),
        tokens(&after),
        "tokens changed:\n{text}\n--- became\n{formatted}"
    );
    assert_eq!(
        is_wrong(&before),
        is_wrong(&after),
        "{text}\n--- became\n{formatted}"
    );
    if !is_wrong(&before) {
        assert_eq!(
            shape(&before),
            shape(&after),
            "the tree changed:\n{text}\n--- became\n{formatted}"
        );
    }
    let again = format(&formatted);
    let changed = formatted
        .lines()
        .zip(again.lines())
        .find(|(first, second)| first != second);
    assert_eq!(
        changed, None,
        "formatting again changes a line; it was\n{text}"
    );
    assert_eq!(
        again, formatted,
        "formatting again changes it; it was\n{text}"
    );
}

#[test]
fn of_written_programs() {
    for (name, text) in written() {
        check(text);
        assert_eq!(format(text), text, "{name} is not in canonical layout");
    }
}

#[test]
fn of_random_programs() {
    for seed in 0..1000 {
        check(&generator::program(seed));
    }
}

#[test]
fn of_nearly_correct_programs() {
    for (_, text) in written() {
        for seed in 0..1000 {
            check(&mutation::mutated(text, seed));
        }
    }
}

#[test]
fn of_noise() {
    for seed in 0..5000 {
        check(&mutation::noise(seed));
    }
}

#[test]
fn of_a_form_feed_at_the_end_of_an_error() {
    check("program P\n\nx: = 1 )\u{c}\u{c}\ny: Int\n");
}
