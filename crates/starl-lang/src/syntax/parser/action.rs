//! Actions: what a robot does while a guard holds.

use alloc::format;
use alloc::vec::Vec;

use super::expression::power;
use super::slips::HeaderColon;
use super::statement::Place;
use super::{Code, Diagnostic, Parser, Span, SyntaxKind::*};
use crate::diagnostic::Edit;

impl Parser<'_> {
    /// Whether a name with brackets, of which the first is after `open` lexemes, is the header of an action: nothing is
    /// between the brackets, or something is indented below.
    pub(super) fn is_action_header(&self, open: usize) -> bool {
        if self.nth(open + 1) == RightParen {
            return matches!(
                self.nth(open + 2),
                Newline | Colon | EndOfFile | PreKeyword | EffKeyword | Dedent
            );
        }
        let end = self.line_end(open);
        self.nth(end) == Newline && self.nth(end + 1) == Indent
    }

    /// `name()`, and indented under it `pre` and `eff`.
    pub(super) fn action(&mut self) {
        let named = self.span();
        self.name();
        if self.at(LeftParen) {
            self.no_parameters();
            self.header_colon(HeaderColon::Remove);
        } else {
            let colon = if self.at(Colon) {
                self.span()
            } else {
                Span::empty(named.end)
            };
            let message = "an action is written with brackets after its name";
            let problem = Diagnostic::new(Code::KoordAction, named, message);
            let form = format!("write `{}()`", named.of(self.text));
            self.report(problem.replace(form, Span::new(named.end, colon.end), "()"));
            self.eat(Colon);
        }
        if self.at_block() {
            self.start(ActionBody);
            self.bump();
            self.inside_indentation(Self::clauses);
            self.finish();
        } else {
            self.clauses_without_indentation();
        }
    }

    /// The brackets after an action's name, between which nothing can stand.
    fn no_parameters(&mut self) {
        let open = self.span();
        self.start(ParameterList);
        self.bump();
        if !self.at(RightParen) && !self.at_line_end() {
            let first = self.span();
            self.start(Error);
            while !self.at(RightParen) && !self.at_line_end() {
                self.bump();
            }
            self.finish();
            let span = Span::new(first.start, self.end_of_last());
            let problem =
                Diagnostic::new(Code::ActionParameters, span, "an action has no parameters");
            let note = "`some x = ...` in the `pre` names a value for the effect";
            self.report(problem.note(note).replace("remove them", span, ""));
        }
        self.close(RightParen, open);
        self.finish();
    }

    /// The clauses of an action that are not indented under its name.
    fn clauses_without_indentation(&mut self) {
        let on_line = matches!(self.current(), PreKeyword | EffKeyword);
        let follows = self.at(Newline) && matches!(self.nth(1), PreKeyword | EffKeyword);
        if !on_line && !follows {
            self.expect_block("an action");
            return;
        }
        let header_end = self.end_of_last();
        let reported = self.diagnostics.len();
        self.start(ActionBody);
        let first = if on_line {
            self.span()
        } else {
            self.nth_span(1)
        };
        while matches!(self.current(), PreKeyword | EffKeyword)
            || self.at(Newline) && matches!(self.nth(1), PreKeyword | EffKeyword)
        {
            self.eat(Newline);
            self.clause();
        }
        self.finish();
        let message = "this belongs to the action and must be indented under it";
        let problem = Diagnostic::new(Code::MissingBlock, first, message)
            .label(Span::empty(header_end), "the action");
        let problem = if follows {
            let edits = self.indent_lines(first.start, self.end_of_last());
            problem.edits("indent it by 4 spaces", edits)
        } else {
            problem
        };
        self.diagnostics.insert(reported, problem);
    }

    /// Parses the clauses that are indented under an action's name.
    fn clauses(&mut self) {
        let mut seen = Seen::default();
        self.clauses_here(&mut seen);
        if seen.eff.is_none() && !seen.reported {
            let place = Span::empty(self.end_of_last());
            let message = "this action does nothing: it has no `eff`";
            let problem = Diagnostic::new(Code::MissingEff, place, message);
            self.report(problem.expected("`eff` and statements"));
        }
    }

    fn clauses_here(&mut self, seen: &mut Seen) {
        loop {
            match self.current() {
                Dedent | EndOfFile => return,
                Newline | Semicolon => self.bump(),
                Indent => self.unexpected_indentation(|parser| parser.clauses_here(seen)),
                PreKeyword | EffKeyword => {
                    seen.check(self);
                    self.clause();
                    match self.at(EffKeyword) {
                        true => self.split_line(),
                        false => self.end_line(),
                    }
                }
                _ if self.at_every() => {
                    self.every();
                    self.end_line();
                }
                Identifier if self.foreign_clause().is_some() => {
                    self.clause();
                    seen.reported = true;
                    self.end_line();
                }
                _ => self.outside_eff(seen),
            }
        }
    }

    /// Reports an `eff` on the line of the guard.
    fn split_line(&mut self) {
        let (end, word) = (self.end_of_last(), self.span());
        let start = self.start_of_line(word.start) as usize;
        let line = &self.text[start..word.start as usize];
        let column = line.len() - line.trim_start().len();
        let gap = Span::new(end, word.start);
        let form = format!("\n{}", " ".repeat(column));
        let problem = Diagnostic::new(Code::Unexpected, word, "`eff` begins a line");
        self.report(problem.replace("put it on the next line", gap, form));
    }

    /// `pre` and a condition, perhaps with `for` and a time, or `eff` and statements.
    fn clause(&mut self) {
        let foreign = self.foreign_clause();
        let is_guard = foreign.unwrap_or(self.current()) == PreKeyword;
        self.start(if is_guard { PreClause } else { EffClause });
        if foreign.is_some() {
            let (meant, message) = match is_guard {
                true => ("pre", "the guard of an action follows `pre`"),
                false => ("eff", "the statements of an action follow `eff`"),
            };
            self.replace_word(message, meant);
        } else {
            self.bump();
        }
        if is_guard {
            self.header_colon(HeaderColon::Remove);
            self.condition();
            if self.at(ForKeyword) {
                self.hold();
            }
        } else {
            self.block_after_word("`eff`", true);
        }
        self.finish();
    }

    /// `for` and a time, which end the guard.
    fn hold(&mut self) {
        let start = self.end_of_last();
        self.bump();
        self.binary(power::COMPARISON);
        if !matches!(self.current(), AndKeyword | OrKeyword) {
            return;
        }
        let time = Span::new(start, self.end_of_last());
        let joined = self.span();
        let is_and = self.at(AndKeyword);
        self.skip_to_line_end();
        let rest = Span::new(joined.start, self.end_of_last());
        let problem = Diagnostic::new(Code::Unexpected, time, "`for` and its time end the guard");
        let whole = Span::new(self.start_of_line(start), rest.end).of(self.text);
        let form = "put them after the whole condition";
        self.report(if is_and && !whole.contains(" or ") {
            let edits = [
                Edit::new(time, ""),
                Edit::new(Span::empty(rest.end), time.of(self.text)),
            ];
            problem.edits(form, edits)
        } else {
            problem.note(form)
        });
    }

    /// Whether `every` and a time are next, rather than a statement that begins with a name.
    fn at_every(&self) -> bool {
        let next = self.nth(1);
        self.at_word("every") && !next.is_assignment() && !matches!(next, Dot | Newline | Semicolon)
    }

    /// `every` and a time.
    fn every(&mut self) {
        self.start(EveryClause);
        self.bump();
        self.expression();
        self.finish();
    }

    /// Statements of an action that stand outside its `eff`.
    fn outside_eff(&mut self, seen: &mut Seen) {
        let first = self.span();
        self.start(EffClause);
        self.start(Block);
        let mut lines = 0;
        while !matches!(
            self.current(),
            Dedent | EndOfFile | PreKeyword | EffKeyword | Indent
        ) {
            if self.at(Newline) || self.at(Semicolon) {
                self.bump();
                continue;
            }
            self.statement(Place::OwnLine);
            self.end_line();
            lines += 1;
        }
        self.finish();
        self.finish();
        if core::mem::replace(&mut seen.reported, true) {
            return;
        }
        let span = Span::new(first.start, self.end_of_last().max(first.start));
        let message = "the statements of an action follow `eff`";
        let problem = Diagnostic::new(Code::MissingEff, first, message);
        self.report(match seen.eff {
            Some(eff) => problem.label(eff, "its `eff` is here; indent the statement under it"),
            None => problem.edits("put `eff` before them", self.put_eff(span, lines)),
        });
    }

    /// The edits that put `eff` before statements: on the line of a single one, above several.
    fn put_eff(&self, span: Span, lines: u32) -> Vec<Edit> {
        let start = Span::empty(span.start);
        if lines <= 1 {
            return Vec::from([Edit::new(start, "eff ")]);
        }
        let line = self.start_of_line(span.start);
        let indentation = Span::new(line, span.start).of(self.text);
        let mut edits = self.indent_lines(span.start, span.end);
        if let Some(edit) = edits.first_mut() {
            *edit = Edit::new(start, format!("eff\n{indentation}    "));
        }
        edits
    }
}

/// Which clauses an action has so far.
#[derive(Default)]
struct Seen {
    pre: Option<Span>,
    eff: Option<Span>,
    reported: bool,
}

impl Seen {
    /// Reports the clause that is next if it cannot follow those before it.
    fn check(&mut self, parser: &mut Parser<'_>) {
        let (span, is_pre) = (parser.span(), parser.at(PreKeyword));
        let again = if is_pre { self.pre } else { self.eff };
        if let Some(first) = again {
            let message = format!("an action has only one {}", parser.found());
            let note = if is_pre {
                "join the conditions with `and`"
            } else {
                "put the statements together"
            };
            let problem = Diagnostic::new(Code::ClauseOrder, span, message);
            parser.report(problem.label(first, "the first one").note(note));
        } else if let (true, Some(eff)) = (is_pre, self.eff) {
            let problem = Diagnostic::new(Code::ClauseOrder, span, "`pre` stands before `eff`");
            parser.report(problem.label(eff, "`eff` is here"));
        }
        let slot = if is_pre { &mut self.pre } else { &mut self.eff };
        slot.get_or_insert(span);
    }
}
