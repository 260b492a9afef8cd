//! Actions: what a robot does while a guard holds.

use alloc::format;
use alloc::vec::Vec;

use super::item::name;
use super::slips::{self, Colon as HeaderColon};
use super::{Code, Diagnostic, Parser, Span, SyntaxKind::*};
use super::{block, expression, statement, words};
use crate::diagnostic::{Edit, Fix};

/// Whether a name with brackets, which is next, is the header of an action: nothing is between the
/// brackets, or something is indented below.
pub(super) fn is_header(parser: &Parser<'_>) -> bool {
    is_header_at(parser, 1)
}

/// The same, with the opening bracket after `open` other lexemes.
pub(super) fn is_header_at(parser: &Parser<'_>, open: usize) -> bool {
    if parser.nth(open + 1) == RightParen {
        return matches!(
            parser.nth(open + 2),
            Newline | Colon | EndOfFile | PreKeyword | EffKeyword | Dedent
        );
    }
    let end = (open..)
        .find(|ahead| matches!(parser.nth(*ahead), Newline | Semicolon | EndOfFile | Dedent));
    end.is_some_and(|end| parser.nth(end) == Newline && parser.nth(end + 1) == Indent)
}

/// `name()`, and indented under it `pre` and `eff`.
pub(super) fn action(parser: &mut Parser<'_>) {
    let named = parser.span();
    name(parser);
    if parser.at(LeftParen) {
        no_parameters(parser);
        slips::header_colon(parser, HeaderColon::Remove);
    } else {
        let colon = if parser.at(Colon) {
            parser.span()
        } else {
            Span::empty(named.end)
        };
        let problem = Diagnostic::new(
            Code::KoordAction,
            named,
            "an action is written with brackets after its name",
        );
        let form = format!("write `{}()`", named.of(parser.text));
        parser.report(problem.replace(form, Span::new(named.end, colon.end), "()"));
        parser.eat(Colon);
    }
    if parser.at(Newline) && parser.nth(1) == Indent {
        parser.start(ActionBody);
        parser.bump();
        let entered = parser.deeper(|parser| {
            parser.bump();
            clauses(parser);
        });
        if entered.is_some() {
            parser.eat(Dedent);
        }
        parser.finish();
    } else {
        without_indentation(parser);
    }
}

/// The brackets after an action's name, between which nothing can stand.
fn no_parameters(parser: &mut Parser<'_>) {
    let open = parser.span();
    parser.start(ParameterList);
    parser.bump();
    if !parser.at(RightParen) && !parser.at_line_end() {
        let first = parser.span();
        parser.start(Error);
        while !parser.at(RightParen) && !parser.at_line_end() {
            parser.bump();
        }
        parser.finish();
        let span = Span::new(first.start, parser.end_of_last());
        let problem = Diagnostic::new(Code::ActionParameters, span, "an action has no parameters");
        let note = "`some x = ...` in the `pre` names a value for the effect";
        parser.report(problem.note(note).replace("remove them", span, ""));
    }
    parser.close(RightParen, open);
    parser.finish();
}

/// The clauses of an action that are not indented under its name.
fn without_indentation(parser: &mut Parser<'_>) {
    let on_line = matches!(parser.current(), PreKeyword | EffKeyword);
    let follows = parser.at(Newline) && matches!(parser.nth(1), PreKeyword | EffKeyword);
    if !on_line && !follows {
        block::opens_block(parser, "an action");
        return;
    }
    let header_end = parser.end_of_last();
    let reported = parser.diagnostics.len();
    parser.start(ActionBody);
    let first = if on_line {
        parser.span()
    } else {
        parser.nth_span(1)
    };
    while matches!(parser.current(), PreKeyword | EffKeyword)
        || parser.at(Newline) && matches!(parser.nth(1), PreKeyword | EffKeyword)
    {
        parser.eat(Newline);
        clause(parser);
    }
    parser.finish();
    let problem = Diagnostic::new(
        Code::MissingBlock,
        first,
        "this belongs to the action and must be indented under it",
    )
    .label(Span::empty(header_end), "the action");
    let problem = if follows {
        let edits = parser.indent_lines(first.start, parser.end_of_last());
        problem.fix(Fix {
            message: "indent it by 4 spaces".into(),
            edits,
        })
    } else {
        problem
    };
    parser.diagnostics.insert(reported, problem);
}

/// Parses the clauses that are indented under an action's name.
fn clauses(parser: &mut Parser<'_>) {
    let mut seen = Seen::default();
    clauses_here(parser, &mut seen);
    if seen.eff.is_none() && !seen.reported {
        let place = Span::empty(parser.end_of_last());
        let problem = Diagnostic::new(
            Code::MissingEff,
            place,
            "this action does nothing: it has no `eff`",
        );
        parser.report(problem.expected("`eff` and statements"));
    }
}

fn clauses_here(parser: &mut Parser<'_>, seen: &mut Seen) {
    loop {
        match parser.current() {
            Dedent | EndOfFile => return,
            Newline | Semicolon => parser.bump(),
            Indent => block::unexpected_indentation(parser, |parser| clauses_here(parser, seen)),
            PreKeyword | EffKeyword => {
                seen.check(parser);
                clause(parser);
                match parser.at(EffKeyword) {
                    true => split_line(parser),
                    false => parser.end_line(),
                }
            }
            _ if at_every(parser) => {
                every(parser);
                parser.end_line();
            }
            Identifier if words::clause(parser).is_some() => {
                clause(parser);
                seen.reported = true;
                parser.end_line();
            }
            _ => outside_eff(parser, seen),
        }
    }
}

/// Reports an `eff` on the line of the guard.
fn split_line(parser: &mut Parser<'_>) {
    let (end, word) = (parser.end_of_last(), parser.span());
    let start = parser.start_of_line(word.start) as usize;
    let line = &parser.text[start..word.start as usize];
    let column = line.len() - line.trim_start().len();
    let gap = Span::new(end, word.start);
    let form = format!("\n{}", " ".repeat(column));
    let problem = Diagnostic::new(Code::Unexpected, word, "`eff` begins a line");
    parser.report(problem.replace("put it on the next line", gap, form));
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

/// `pre` and a condition, perhaps with `for` and a time, or `eff` and statements.
fn clause(parser: &mut Parser<'_>) {
    let foreign = words::clause(parser);
    let is_guard = foreign.unwrap_or(parser.current()) == PreKeyword;
    parser.start(if is_guard { PreClause } else { EffClause });
    if foreign.is_some() {
        let (meant, message) = match is_guard {
            true => ("pre", "the guard of an action follows `pre`"),
            false => ("eff", "the statements of an action follow `eff`"),
        };
        words::replace(parser, message, meant);
    } else {
        parser.bump();
    }
    if is_guard {
        slips::header_colon(parser, HeaderColon::Remove);
        expression::condition(parser);
        if parser.at(ForKeyword) {
            hold(parser);
        }
    } else {
        block::after_word(parser, "`eff`", true);
    }
    parser.finish();
}

/// `for` and a time, which end the guard.
fn hold(parser: &mut Parser<'_>) {
    let start = parser.end_of_last();
    parser.bump();
    expression::binary(parser, expression::power::COMPARISON);
    if !matches!(parser.current(), AndKeyword | OrKeyword) {
        return;
    }
    let time = Span::new(start, parser.end_of_last());
    let joined = parser.span();
    let is_and = parser.at(AndKeyword);
    parser.start(Error);
    while !parser.at_line_end() {
        parser.bump();
    }
    parser.finish();
    let rest = Span::new(joined.start, parser.end_of_last());
    let problem = Diagnostic::new(Code::Unexpected, time, "`for` and its time end the guard");
    let whole = Span::new(parser.start_of_line(start), rest.end).of(parser.text);
    let form = "put them after the whole condition";
    parser.report(if is_and && !whole.contains(" or ") {
        let edits = [
            Edit::new(time, ""),
            Edit::new(Span::empty(rest.end), time.of(parser.text)),
        ];
        problem.fix(Fix {
            message: form.into(),
            edits: edits.into(),
        })
    } else {
        problem.note(form)
    });
}

/// Whether `every` and a time are next, rather than a statement that begins with a name.
fn at_every(parser: &Parser<'_>) -> bool {
    let next = parser.nth(1);
    parser.at_word("every") && !next.is_assignment() && !matches!(next, Dot | Newline | Semicolon)
}

/// `every` and a time.
fn every(parser: &mut Parser<'_>) {
    parser.start(EveryClause);
    parser.bump();
    expression::expression(parser);
    parser.finish();
}

/// Statements of an action that stand outside its `eff`.
fn outside_eff(parser: &mut Parser<'_>, seen: &mut Seen) {
    let first = parser.span();
    parser.start(EffClause);
    parser.start(Block);
    let mut lines = 0;
    while !matches!(
        parser.current(),
        Dedent | EndOfFile | PreKeyword | EffKeyword | Indent
    ) {
        if parser.at(Newline) || parser.at(Semicolon) {
            parser.bump();
            continue;
        }
        statement::statement(parser, statement::Place::OwnLine);
        parser.end_line();
        lines += 1;
    }
    parser.finish();
    parser.finish();
    if core::mem::replace(&mut seen.reported, true) {
        return;
    }
    let span = Span::new(first.start, parser.end_of_last().max(first.start));
    let problem = Diagnostic::new(
        Code::MissingEff,
        first,
        "the statements of an action follow `eff`",
    );
    parser.report(match seen.eff {
        Some(eff) => problem.label(eff, "its `eff` is here; indent the statement under it"),
        None => problem.fix(Fix {
            message: "put `eff` before them".into(),
            edits: put_eff(parser, span, lines),
        }),
    });
}

/// The edits that put `eff` before statements: on the line of a single one, above several.
fn put_eff(parser: &Parser<'_>, span: Span, lines: u32) -> Vec<Edit> {
    let start = Span::empty(span.start);
    if lines <= 1 {
        return Vec::from([Edit::new(start, "eff ")]);
    }
    let line = parser.start_of_line(span.start);
    let indentation = Span::new(line, span.start).of(parser.text);
    let mut edits = parser.indent_lines(span.start, span.end);
    if let Some(edit) = edits.first_mut() {
        *edit = Edit::new(start, format!("eff\n{indentation}    "));
    }
    edits
}
