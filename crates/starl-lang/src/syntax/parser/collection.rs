//! Arguments, lists, sets, maps and what builds them from other collections.

use super::expression::{Parsed, Shape, condition, expression_parsed};
use super::item::name;
use super::{Parser, SyntaxKind, SyntaxKind::*, words};

/// `(a, name = b)`; the height of the highest.
pub(super) fn arguments(parser: &mut Parser<'_>) -> u32 {
    let open = parser.span();
    let mut height = 0;
    parser.start(ArgumentList);
    parser.bump();
    parser.separated(RightParen, open, |parser| {
        parser.start(Argument);
        if parser.at(Identifier) && parser.nth(1) == Equal {
            name(parser);
            parser.bump();
        } else if parser.at(Identifier) && parser.nth(1) == Colon {
            name(parser);
            words::replace(parser, "the name of an argument stands before `=`", " =");
        }
        height = height.max(expression_parsed(parser).height);
        if parser.at(ForKeyword) {
            height = height.max(comprehension(parser));
        }
        parser.finish();
    });
    parser.finish();
    height + 1
}

/// `[a, b]` or `[f(x) for x in xs if c by k]`.
pub(super) fn list(parser: &mut Parser<'_>) -> Parsed {
    elements(parser, ListExpression, RightBracket, |parser| {
        expression_parsed(parser).height
    })
}

/// `{a, b}`, `{k: v}`, `{}`, `{:}` or a comprehension of them.
pub(super) fn braces(parser: &mut Parser<'_>) -> Parsed {
    if parser.nth(1) == Colon && parser.nth(2) == RightBrace {
        parser.start(BraceExpression);
        parser.bump();
        parser.bump();
        parser.bump();
        parser.finish();
        return Parsed::new(Shape::Other, 1);
    }
    elements(parser, BraceExpression, RightBrace, |parser| {
        let start = parser.checkpoint();
        let key = expression_parsed(parser).height;
        if !parser.eat(Colon) {
            return key;
        }
        let value = expression_parsed(parser).height;
        parser.start_at(start, MapEntry);
        parser.finish();
        key.max(value) + 1
    })
}

fn elements(
    parser: &mut Parser<'_>,
    kind: SyntaxKind,
    closing: SyntaxKind,
    element: fn(&mut Parser<'_>) -> u32,
) -> Parsed {
    let open = parser.span();
    let mut height = 0;
    parser.start(kind);
    parser.bump();
    parser.separated(closing, open, |parser| {
        height = height.max(element(parser));
        if parser.at(ForKeyword) {
            height = height.max(comprehension(parser));
        }
    });
    parser.finish();
    Parsed::new(Shape::Other, height + 1)
}

/// `for x in xs if c by k`.
fn comprehension(parser: &mut Parser<'_>) -> u32 {
    parser.start(ComprehensionClause);
    parser.bump();
    let mut height = iteration(parser);
    if parser.eat(IfKeyword) {
        height = height.max(condition(parser).height);
    }
    if parser.at_word("by") {
        parser.bump();
        height = height.max(expression_parsed(parser).height);
    }
    parser.finish();
    height + 1
}

/// `x in xs` or `k, v in map`; the height of the collection.
pub(super) fn iteration(parser: &mut Parser<'_>) -> u32 {
    parser.start(LoopVariables);
    pattern(parser);
    if parser.eat(Comma) {
        pattern(parser);
    }
    parser.finish();
    let is_foreign = parser.at_word("of");
    if is_foreign {
        words::replace(parser, "the collection stands after `in`", "in");
    }
    if is_foreign || parser.expect(InKeyword) {
        expression_parsed(parser).height
    } else {
        0
    }
}

/// A name, or names for the parts of a tuple: `x` or `(a, b)`.
pub(super) fn pattern(parser: &mut Parser<'_>) {
    if !parser.at(LeftParen) {
        return name(parser);
    }
    let open = parser.span();
    parser.start(TuplePattern);
    parser.bump();
    parser.separated(RightParen, open, name);
    parser.finish();
}
