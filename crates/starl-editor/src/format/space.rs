//! Which tokens stand apart on a line.

use super::piece::Content;
use starl_lang::syntax::{SyntaxKind, SyntaxKind::*, SyntaxToken};

/// Whether a space is between the two, which stand on a line one after the other.
pub(super) fn between(before: &Content, after: &Content) -> bool {
    match (before, after) {
        (Content::Token(before), Content::Token(after)) => between_tokens(before, after),
        (Content::Verbatim(_), Content::Token(after)) => !matches!(after.kind(), Semicolon | Comma),
        _ => true,
    }
}

fn between_tokens(before: &SyntaxToken, after: &SyntaxToken) -> bool {
    // A number and the part of a tuple would become another number.
    let is_number = before.kind().is_number() && parent(before) == Some(LiteralExpression);
    if is_number && after.kind() == Dot {
        return true;
    }
    !sticks_to_next(before) && !sticks_to_last(before.kind(), after)
}

/// Whether nothing stands between the token and the one after it.
fn sticks_to_next(token: &SyntaxToken) -> bool {
    match token.kind() {
        LeftParen | LeftBracket | LeftBrace | Dot | DotDot => true,
        Minus => parent(token) == Some(PrefixExpression),
        _ => false,
    }
}

/// Whether nothing stands between the token and the one before it.
fn sticks_to_last(before: SyntaxKind, token: &SyntaxToken) -> bool {
    match token.kind() {
        RightParen | RightBracket | RightBrace | Comma | Semicolon | Colon | Dot | DotDot => true,
        LeftParen => matches!(
            parent(token),
            Some(ArgumentList | ParameterList | HandlerParameterList | FieldList)
        ),
        LeftBracket => matches!(
            parent(token),
            Some(IndexExpression | TypeArguments | Consistency)
        ),
        Bang => parent(token) == Some(UnwrapExpression),
        // Two question marks would be another operator.
        Question => before != Question,
        _ => false,
    }
}

fn parent(token: &SyntaxToken) -> Option<SyntaxKind> {
    token.parent().map(|parent| parent.kind())
}
