//! Properties of formatting that must hold for every program; the fuzz targets use them too.

use starl_editor::format::format;
use starl_lang::check::{StandardLibraries, check};
use starl_lang::compile::compile;
use starl_lang::machine::Bytecode;
use starl_lang::syntax::{Parse, SyntaxKind, SyntaxToken, parse};

/// Formatting keeps the tokens and the meaning of a program, and formatting again changes nothing. Returns
/// whether the program can be compiled.
pub fn keeps(text: &str) -> bool {
    let formatted = format(text);
    assert_eq!(
        format(&formatted),
        formatted,
        "formatting again changes\n{formatted}"
    );
    assert_eq!(
        tokens(&parse(&formatted)),
        tokens(&parse(text)),
        "formatting\n{text}\ngives\n{formatted}"
    );
    let before = bytecode(text);
    assert!(
        before == bytecode(&formatted),
        "{text}\nis not compiled as\n{formatted}"
    );
    before.is_some()
}

/// The bytecode, without where in the text it comes from; none if the program has problems.
fn bytecode(text: &str) -> Option<Bytecode> {
    let mut bytecode = compile(&check(text, &StandardLibraries)).ok()?;
    bytecode.spans.clear();
    bytecode.files.clear();
    Some(bytecode)
}

/// The tokens without white space, each with its text, comments without spaces at their ends.
pub fn tokens(parse: &Parse) -> Vec<(SyntaxKind, String)> {
    let tokens = parse
        .syntax()
        .descendants_with_tokens()
        .filter_map(|element| element.into_token());
    let matters = |token: &SyntaxToken| {
        !matches!(
            token.kind(),
            SyntaxKind::Whitespace | SyntaxKind::LineBreak | SyntaxKind::Newline
        )
    };
    let text = |token: SyntaxToken| {
        (
            token.kind(),
            token.text().trim_end_matches([' ', '\t', '\r']).to_string(),
        )
    };
    tokens.filter(matters).map(text).collect()
}
