//! Words and symbols of other languages that stand where StarL has its own: operators, clauses, loops, quantifiers.
//!
//! Each is reported with its fix, and then parsed as what it stands for.

use alloc::format;

use super::expression::power;
use super::{Code, Diagnostic, Parser, Span, SyntaxKind, SyntaxKind::*};
use crate::diagnostic::Edit;

/// An operator of another language.
pub(super) struct Operator {
    /// The kind of StarL's operator; `->` for an implication, which StarL writes with `not` and `or`.
    pub kind: SyntaxKind,
    /// How many lexemes it has.
    pub length: usize,
}

impl Parser<'_> {
    /// The operator of another language after a value and `ahead` other lexemes, if it is one.
    pub(super) fn foreign_operator(&self, ahead: usize) -> Option<Operator> {
        let next = self.nth(ahead + 1);
        let span = self.nth_span(ahead);
        let touches = span.end == self.nth_span(ahead + 1).start;
        let (kind, length) = match self.nth(ahead) {
            Identifier if !self.starts_operand(ahead + 1) => return None,
            Identifier => match span.of(self.text) {
                "is" if next == NotKeyword => (NotEqual, 2),
                "is" | "equals" => (EqualEqual, 1),
                "xor" => (NotEqual, 1),
                "mod" => (Percent, 1),
                "div" => (Slash, 1),
                "implies" => (Arrow, 1),
                _ => return None,
            },
            Arrow if self.equals_compare => (Arrow, 1),
            Equal if self.equals_compare && next == Greater && touches => (Arrow, 2),
            EqualEqual if next == Greater && touches => (Arrow, 2),
            _ => return None,
        };
        Some(Operator { kind, length })
    }

    /// Takes the operator of another language that is next, after what starts at the byte `left`.
    pub(super) fn take_operator(&mut self, operator: &Operator, left: u32) {
        let span = self.span().to(self.nth_span(operator.length - 1));
        let written = span.of(self.text);
        if operator.kind == Arrow {
            let message = format!("there is no operator `{written}`");
            let problem = Diagnostic::new(Code::ForeignOperator, span, message);
            let before = Span::new(self.end_of_last(), span.end);
            let edits = [
                Edit::new(Span::empty(left), "not ("),
                Edit::new(before, ") or"),
            ];
            let message = "write `not (a) or b` for `a` implies `b`";
            self.report(problem.edits(message, edits));
        } else if let Some(meant) = operator.kind.text() {
            let message = format!("`{written}` is written `{meant}`");
            self.report_operator(span, &message, meant);
        }
        (0..operator.length).for_each(|_| self.bump());
    }

    /// Whether `if c else b` is next, which Python puts after a value.
    pub(super) fn is_condition_after_value(&self) -> bool {
        if !self.at(IfKeyword) {
            return false;
        }
        let mut open = 0_u32;
        for ahead in 1.. {
            match self.nth(ahead) {
                ElseKeyword if open == 0 => return true,
                Newline | Semicolon | Indent | Dedent | EndOfFile | ThenKeyword => return false,
                Comma if open == 0 => return false,
                kind if kind.closing().is_some() => open += 1,
                kind if kind.is_closing() && open == 0 => return false,
                kind if kind.is_closing() => open -= 1,
                _ => {}
            }
        }
        false
    }

    /// Reports `a if c else b`, whose value `a` starts at the byte `start`.
    pub(super) fn condition_after_value(&mut self, start: u32) {
        let (end, word) = (self.end_of_last(), self.span());
        self.bump();
        let first = self.span();
        self.condition();
        let asked = Span::new(first.start, self.end_of_last().max(first.start));
        let otherwise = self.span();
        if !self.eat(ElseKeyword) {
            return self.unexpected("`else`");
        }
        self.expression();
        let before = format!("if {} then ", asked.of(self.text));
        let edits = [
            Edit::new(Span::empty(start), before),
            Edit::new(Span::new(end, otherwise.end), " else"),
        ];
        let message = "the condition of a choice stands before its values";
        let problem = Diagnostic::new(Code::ForeignOperator, word, message);
        self.report(problem.edits("write `if condition then a else b`", edits));
    }

    /// Takes the word for `within` that is next, if there is one.
    pub(super) fn deadline(&mut self) -> bool {
        let is_word = self.at(InKeyword) || matches!(self.word(), "before" | "until");
        if is_word && self.starts_operand(1) {
            self.replace_word("a deadline begins with `within`", "within");
            return true;
        }
        false
    }

    /// The clause of an action that the next word stands for: `pre` or `eff`.
    pub(super) fn foreign_clause(&self) -> Option<SyntaxKind> {
        let next = self.nth(1);
        let opens = next.is_keyword() || next.is_literal();
        if !opens && !matches!(next, Identifier | Colon | Newline) {
            return None;
        }
        match self.word() {
            "guard" | "when" | "requires" | "precondition" => Some(PreKeyword),
            "effect" | "do" | "effects" => Some(EffKeyword),
            _ => None,
        }
    }

    /// Reports the word that is next, and takes it, where `meant` should stand.
    pub(super) fn replace_word(&mut self, message: &str, meant: &str) {
        self.report_operator(self.span(), message, meant);
        self.bump_error();
    }

    /// Reports the word that is next, and takes it, where nothing should stand.
    pub(super) fn remove_word(&mut self, message: &str) {
        let span = Span::new(self.span().start, self.nth_span(1).start);
        let problem = Diagnostic::new(Code::ForeignOperator, self.span(), message);
        self.report(problem.replace("remove this word", span, ""));
        self.bump_error();
    }

    /// The quantifier that the next words stand for, and how many they are.
    pub(super) fn foreign_quantifier(&self) -> Option<(&'static str, usize)> {
        match (self.current(), self.word()) {
            (ForKeyword, _) if matches!(self.nth_span(1).of(self.text), "all" | "every") => {
                Some(("forall", 2))
            }
            (Identifier, "all" | "every" | "each") => Some(("forall", 1)),
            (Identifier, "any" | "exist") => Some(("exists", 1)),
            _ => None,
        }
    }

    /// Reports the quantifier, and takes all of its words but the last.
    pub(super) fn take_quantifier(&mut self, meant: &str, length: usize) {
        let span = self.span().to(self.nth_span(length - 1));
        let message = format!("`{}` is written `{meant}`", span.of(self.text));
        self.report_operator(span, &message, meant);
        (1..length).for_each(|_| self.bump_error());
    }

    /// Takes the words that other languages put after `for`; whether a loop of C took the whole line.
    pub(super) fn loop_words(&mut self) -> bool {
        if self.at_word("each") && self.nth(1) == Identifier {
            self.remove_word("`for` needs no `each`");
        }
        let counts = |at: usize| self.nth(at) == Identifier && self.nth(at + 1) == Equal;
        let in_brackets = self.at(LeftParen);
        if !counts(0) && !(in_brackets && (counts(1) || self.nth(1) == LetKeyword || counts(2))) {
            return false;
        }
        let message = "a loop goes over a collection or a range";
        let problem = Diagnostic::new(Code::ForeignStatement, self.span(), message);
        self.report(problem.note("`for i in 0..n` counts from 0 to below `n`"));
        self.start(Error);
        while !matches!(self.current(), Newline | Dedent | EndOfFile) {
            self.bump();
        }
        if self.at_block() {
            self.bump();
            self.skip_block();
        }
        self.finish();
        true
    }

    /// `++x`, which takes the whole statement.
    pub(super) fn step_before(&mut self) {
        let (operator, place) = (self.span(), self.nth_span(1).start);
        self.bump_error();
        self.binary(power::SIGN);
        let target = Span::new(place, self.end_of_last().max(place));
        let form = format!("{} += 1", target.of(self.text));
        let whole = operator.to(target);
        let message = "there is no operator `++`";
        self.report_operator(whole, message, &form);
    }
}
