//! Operands: literals, names, calls, elements, fields, brackets, and the forms that begin with a keyword.

use alloc::format;

use rowan::Checkpoint;

use super::expression::{Parsed, Shape, power};
use super::types::SHORT_TUPLE;
use super::{Code, Diagnostic, MAX_DEPTH, Parser, Span, SyntaxKind::*};
use crate::syntax::literal;

impl Parser<'_> {
    /// An operand with its suffixes: fields, arguments, indices, `!`.
    pub(super) fn postfix(&mut self, start: Checkpoint) -> Parsed {
        let mut parsed = self.operand();
        loop {
            let kind = match self.current() {
                Dot => FieldExpression,
                LeftParen => CallExpression,
                LeftBracket => IndexExpression,
                Bang => UnwrapExpression,
                _ => return parsed,
            };
            if parsed.height + self.depth >= MAX_DEPTH {
                self.too_deep();
                return Parsed::BROKEN;
            }
            let mut height = 0;
            match kind {
                FieldExpression => {
                    self.bump();
                    self.field_name();
                }
                CallExpression => height = self.arguments(),
                IndexExpression => height = self.index(),
                _ => self.bump(),
            }
            self.start_at(start, kind);
            self.finish();
            let shape = match (kind, parsed.shape) {
                (_, Shape::Broken) => Shape::Broken,
                (CallExpression, _) => Shape::Call,
                (FieldExpression | IndexExpression, Shape::Target) => Shape::Target,
                _ => Shape::Other,
            };
            parsed = Parsed::new(shape, parsed.height.max(height) + 1);
        }
    }

    /// The name or the number after a dot; a keyword there can only be meant as a name.
    fn field_name(&mut self) {
        if self.eat(IntegerLiteral) {
            return;
        }
        if self.current().is_keyword() {
            let message = format!("{} is a keyword and cannot be a name", self.found());
            self.report(Diagnostic::new(Code::KeywordAsName, self.span(), message));
            self.bump();
        } else {
            self.expect(Identifier);
        }
    }

    fn index(&mut self) -> u32 {
        let open = self.span();
        self.bump();
        let parsed = self.expression();
        if !self.at(RightBracket) && !self.at_line_end() {
            self.unexpected(RightBracket.name());
            self.skip_element();
        }
        self.close(RightBracket, open);
        parsed.height
    }

    fn operand(&mut self) -> Parsed {
        match self.current() {
            kind if kind.is_literal() => self.number_or_other_literal(),
            Identifier | ForKeyword if self.is_quantifier() => self.quantifier(),
            Identifier if matches!(self.word(), "new" | "await") && self.nth(1) == Identifier => {
                self.remove_word("a value begins with its name");
                self.operand()
            }
            Identifier => {
                self.start(NameExpression);
                self.bump();
                self.finish();
                Parsed::new(Shape::Target, 1)
            }
            LeftParen => self.parenthesized(),
            LeftBracket => self.list(),
            LeftBrace => self.braces(),
            SomeKeyword => self.some(),
            IfKeyword => self.conditional(),
            _ => {
                self.unexpected("a value");
                Parsed::BROKEN
            }
        }
    }

    /// A literal; with a number also the unit that stands apart from it.
    fn number_or_other_literal(&mut self) -> Parsed {
        let (is_plain, number) = (
            matches!(self.current(), IntegerLiteral | FloatLiteral),
            self.span(),
        );
        self.start(LiteralExpression);
        self.bump();
        if is_plain
            && self.at(Identifier)
            && let Some(name) = literal::unit_meant(self.word())
        {
            let unit = self.span();
            let message = "a number and its unit are one word";
            let problem = Diagnostic::new(Code::UnitApart, number.to(unit), message);
            let form = format!("write `{}{name}`", number.of(self.text));
            self.report(problem.replace(form, Span::new(number.end, unit.end), name));
            self.bump_error();
        }
        self.finish();
        Parsed::new(Shape::Other, 1)
    }

    /// `(a)` or `(a, b)`.
    fn parenthesized(&mut self) -> Parsed {
        let (open, start) = (self.span(), self.checkpoint());
        self.bump();
        let mut parsed = self.binary(0);
        let comma = self.span();
        let mut kind = ParenthesizedExpression;
        if self.eat(Comma) {
            if self.at(RightParen) {
                let problem = Diagnostic::new(Code::ShortTuple, comma, SHORT_TUPLE);
                self.report(problem.replace("remove the comma", comma, ""));
            } else {
                kind = TupleExpression;
            }
            self.separated(RightParen, open, |parser| {
                parsed.height = parsed.height.max(parser.expression().height);
            });
        } else {
            if !self.at(RightParen) && !self.at_line_end() {
                self.unexpected(RightParen.name());
                self.skip_element();
            }
            self.close(RightParen, open);
        }
        self.start_at(start, kind);
        self.finish();
        parsed.enclosed()
    }

    /// `some x = optional`.
    fn some(&mut self) -> Parsed {
        self.start(SomeExpression);
        let word = self.span();
        self.bump();
        let name = self.at(Identifier).then(|| self.span());
        self.pattern();
        let parsed = if let Some(name) = name
            && (matches!(self.current(), AndKeyword | OrKeyword | ThenKeyword)
                || self.at_line_end())
        {
            let meant = format!("{} != none", name.of(self.text));
            let message = "`some x = ...` names the value that is there";
            self.report_operator(word.to(name), message, &meant);
            Parsed::BROKEN
        } else if self.expect(Equal) {
            self.binary(power::COMPARISON)
        } else {
            Parsed::BROKEN
        };
        self.finish();
        parsed.enclosed()
    }

    /// `if c then a else b`.
    fn conditional(&mut self) -> Parsed {
        self.start(ConditionalExpression);
        self.bump();
        let mut height = self.condition().height;
        if self.expect(ThenKeyword) {
            height = height.max(self.expression().height);
            if self.expect(ElseKeyword) {
                height = height.max(self.expression().height);
            }
        }
        self.finish();
        Parsed::new(Shape::Other, height + 1)
    }

    /// Whether `forall` or `exists` is next, with a name after it.
    fn is_quantifier(&self) -> bool {
        let length = match self.foreign_quantifier() {
            // `all(x) in xs` calls a function.
            Some((_, length)) if self.nth(length) == Identifier => length,
            Some(_) => return false,
            None if matches!(self.word(), "forall" | "exists") => 1,
            None => return false,
        };
        self.runs_over(length)
            || self.nth(length) == Identifier && matches!(self.nth(length + 1), Comma | Colon)
    }

    /// Whether `x in`, `k, v in` or the same with tuples of names is after the next `length` words.
    fn runs_over(&self, length: usize) -> bool {
        let is_name =
            |at: &usize| matches!(self.nth(*at), Identifier | Comma | LeftParen | RightParen);
        let end = (length..).find(|at| !is_name(at)).unwrap_or_default();
        end > length && self.nth(end) == InKeyword
    }

    /// `forall r, s: condition` or `forall x in xs: condition`.
    fn quantifier(&mut self) -> Parsed {
        let foreign = self.foreign_quantifier();
        let is_over_collection = self.runs_over(foreign.map_or(1, |(_, length)| length));
        self.start(QuantifierExpression);
        if let Some((meant, length)) = foreign {
            self.take_quantifier(meant, length);
        }
        self.bump();
        let mut height = 0;
        if is_over_collection {
            height = self.iteration();
        } else {
            self.name();
            while self.eat(Comma) {
                self.name();
            }
        }
        self.expect(Colon);
        height = height.max(self.condition().height);
        self.finish();
        Parsed::new(Shape::Other, height + 1)
    }
}
