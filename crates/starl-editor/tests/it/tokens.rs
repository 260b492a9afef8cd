//! Every word has its kind, so that an editor can colour what the grammar of words cannot tell apart.

use crate::common;
use crate::support::analysis;
use starl_editor::{TokenKind, tokens};

/// The words with their kinds, `+` for a declaration, `!` for what never changes, `*` for what every program
/// has.
fn shown(text: &str) -> Vec<String> {
    let analysis = analysis(text);
    let shown = tokens(&analysis).into_iter().map(|token| {
        let marks = [
            (token.modifiers.declaration, "+"),
            (token.modifiers.readonly, "!"),
            (token.modifiers.default_library, "*"),
            (token.modifiers.documentation, "#"),
        ];
        let marks: String = (marks.iter().filter(|(is_so, _)| *is_so))
            .map(|(_, mark)| *mark)
            .collect();
        format!("{:?}{marks} {}", token.kind, token.span.of(text))
    });
    shown.collect()
}

#[test]
fn of_declarations() {
    let text = "/// P.\nprogram P\nparam size: Float = 2cm // big\nenum E {a}\ne: E = a\nmotion = ReachAvoid(vicinity = size)\n";
    let expected = [
        "Comment# /// P.",
        "Keyword program",
        "Namespace+ P",
        "Keyword param",
        "Variable+! size",
        "Type* Float",
        "Number 2cm",
        "Comment // big",
        "Keyword enum",
        "Enum+ E",
        "EnumMember+ a",
        "Variable+ e",
        "Enum E",
        "EnumMember a",
        "Variable+! motion",
        "Class* ReachAvoid",
        "Parameter* vicinity",
        "Variable! size",
    ];
    assert_eq!(shown(text), expected);
}

#[test]
fn of_effects_and_properties() {
    let text = "program P\nspots: List[Point]\ngo()\n    pre spots.size() > 1\n    eff\n        let p = spots[0].x\n        if p < pi then emit(\"e\", at = p)\ninvariant i: forall r: r.up\n";
    let found = shown(text);
    let expected = [
        "Event+ go",
        "Keyword pre",
        "Variable spots",
        "Method* size",
        "Number 1",
        "Keyword eff",
        "Keyword let",
        "Variable+ p",
        "Variable spots",
        "Number 0",
        "Property* x",
        "Keyword if",
        "Variable p",
        "Variable!* pi",
        "Keyword then",
        "Function* emit",
        "String \"e\"",
        "Variable p",
        "Keyword invariant",
        "Function+ i",
        "Keyword forall",
        "Variable+ r",
        "Variable r",
        "Property* up",
    ];
    assert_eq!(found[found.len() - expected.len()..], expected);
}

#[test]
fn of_inputs() {
    let text = "program P\nn: Int\non input input(input: Int)\n    n = input\n";
    let expected = [
        "Keyword on",
        "Keyword input",
        "Event+ input",
        "Parameter+ input",
        "Type* Int",
        "Variable n",
        "Parameter input",
    ];
    assert_eq!(shown(text)[4..], expected);
}

#[test]
fn a_role_is_a_word_a_name_and_a_variable() {
    let text = "program P\nrole a\n    go()\n        eff role = a\n";
    let found = shown(text);
    assert_eq!(
        found[2..],
        [
            "Keyword role",
            "EnumMember+ a",
            "Event+ go",
            "Keyword eff",
            "Variable* role",
            "EnumMember a",
        ]
    );
}

#[test]
fn they_are_in_order_and_do_not_overlap() {
    for (name, text) in common::written() {
        let found = tokens(&analysis(text));
        let words = found.iter().zip(found.iter().skip(1));
        for (word, next) in words {
            assert!(
                word.span.end <= next.span.start,
                "{word:?} {next:?} of {name}"
            );
        }
        let lines = |kind: TokenKind| found.iter().filter(|token| token.kind == kind).count();
        assert_eq!(
            lines(TokenKind::Comment),
            text.matches("//").count(),
            "{name}"
        );
    }
}
