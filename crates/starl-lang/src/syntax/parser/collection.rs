//! Arguments, lists, sets, maps and what builds them from other collections.

use super::expression::{Parsed, Shape};
use super::{Parser, SyntaxKind, SyntaxKind::*};

impl Parser<'_> {
    /// `(a, name = b)`; the height of the highest.
    pub(super) fn arguments(&mut self) -> u32 {
        let mut height = 0;
        self.bracketed(ArgumentList, RightParen, |parser| {
            parser.start(Argument);
            if parser.at(Identifier) && parser.nth(1) == Equal {
                parser.name();
                parser.bump();
            } else if parser.at(Identifier) && parser.nth(1) == Colon {
                parser.name();
                parser.replace_word("the name of an argument stands before `=`", " =");
            }
            height = height.max(parser.expression().height);
            if parser.at(ForKeyword) {
                height = height.max(parser.comprehension());
            }
            parser.finish();
        });
        height + 1
    }

    /// `[a, b]` or `[f(x) for x in xs if c by k]`.
    pub(super) fn list(&mut self) -> Parsed {
        self.elements(ListExpression, RightBracket, |parser| {
            parser.expression().height
        })
    }

    /// `{a, b}`, `{k: v}`, `{}`, `{:}` or a comprehension of them.
    pub(super) fn braces(&mut self) -> Parsed {
        if self.nth(1) == Colon && self.nth(2) == RightBrace {
            self.start(BraceExpression);
            self.bump();
            self.bump();
            self.bump();
            self.finish();
            return Parsed::new(Shape::Other, 1);
        }
        self.elements(BraceExpression, RightBrace, |parser| {
            let start = parser.checkpoint();
            let key = parser.expression().height;
            if !parser.eat(Colon) {
                return key;
            }
            let value = parser.expression().height;
            parser.start_at(start, MapEntry);
            parser.finish();
            key.max(value) + 1
        })
    }

    fn elements(
        &mut self,
        kind: SyntaxKind,
        closing: SyntaxKind,
        element: fn(&mut Self) -> u32,
    ) -> Parsed {
        let mut height = 0;
        self.bracketed(kind, closing, |parser| {
            height = height.max(element(parser));
            if parser.at(ForKeyword) {
                height = height.max(parser.comprehension());
            }
        });
        Parsed::new(Shape::Other, height + 1)
    }

    /// `for x in xs if c by k`.
    fn comprehension(&mut self) -> u32 {
        self.start(ComprehensionClause);
        self.bump();
        let mut height = self.iteration();
        if self.eat(IfKeyword) {
            height = height.max(self.condition().height);
        }
        if self.eat_word("by") {
            height = height.max(self.expression().height);
        }
        self.finish();
        height + 1
    }

    /// `x in xs` or `k, v in map`; the height of the collection.
    pub(super) fn iteration(&mut self) -> u32 {
        self.start(LoopVariables);
        self.pattern();
        if self.eat(Comma) {
            self.pattern();
        }
        self.finish();
        let is_foreign = self.at_word("of");
        if is_foreign {
            self.replace_word("the collection stands after `in`", "in");
        }
        if is_foreign || self.expect(InKeyword) {
            self.expression().height
        } else {
            0
        }
    }

    /// A name, or names for the parts of a tuple: `x` or `(a, b)`.
    pub(super) fn pattern(&mut self) {
        match self.at(LeftParen) {
            true => self.bracketed(TuplePattern, RightParen, Self::name),
            false => self.name(),
        }
    }
}
