//! Habits from other languages, and their fixes.

use alloc::format;

use super::{Code, Diagnostic, Parser, Span, SyntaxKind, SyntaxKind::*};
use crate::diagnostic::closest;
use crate::syntax::literal;

/// The treatment of a colon at the end of a header.
#[derive(Clone, Copy)]
pub(super) enum Colon {
    /// It goes.
    Remove,
    /// `then` takes its place, if a statement follows on the line.
    Then,
}

/// Takes the colon that Python and Koord put at the end of a header.
pub(super) fn header_colon(parser: &mut Parser<'_>, colon: Colon) {
    if !parser.at(SyntaxKind::Colon) {
        return;
    }
    let span = parser.span();
    parser.bump();
    let problem = Diagnostic::new(Code::HeaderColon, span, "no colon is needed here");
    let needs_then = matches!(colon, Colon::Then) && !parser.at_line_end();
    parser.report(if needs_then {
        problem.replace("write `then`", span, " then")
    } else {
        problem.replace("remove it", span, "")
    });
}

/// The words that begin a declaration.
pub(super) const DECLARATIONS: &[&str] = &[
    "program",
    "library",
    "import",
    "enum",
    "record",
    "message",
    "param",
    "const",
    "allread",
    "allwrite",
    "stable",
    "function",
    "role",
    "invariant",
    "always",
    "eventually",
];

/// StarL's counterpart of a word that begins a declaration in another language.
pub(super) fn foreign_declaration(word: &str) -> Option<&'static str> {
    Some(match word {
        "def" | "fn" | "func" | "fun" => "function",
        "agent" | "automaton" => "program",
        "module" => "library",
        "use" | "include" => "import",
        "struct" | "class" | "type" => "record",
        "sharedsw" => "allread",
        "sharedmw" | "shared" => "allwrite",
        "constant" | "final" => "const",
        "parameter" => "param",
        "persistent" | "durable" => "stable",
        "property" | "safety" | "require" | "ensure" | "assert" => "invariant",
        "liveness" => "eventually",
        _ => return closest(word, DECLARATIONS.iter().copied()),
    })
}

/// Words that other languages put before a variable's name, and that say nothing of its type.
const UNTYPED: &[&str] = &[
    "var", "local", "state", "val", "mut", "global", "public", "private", "static",
];

/// Whether a word stands before a variable's name in other languages.
pub(super) fn is_variable_word(word: &str) -> bool {
    UNTYPED.contains(&word)
        || matches!(
            word,
            "int" | "float" | "double" | "bool" | "boolean" | "string"
        )
        || word.starts_with(|first: char| first.is_ascii_uppercase())
}

/// Whether a word before a variable's name says nothing of its type.
fn is_untyped(word: &str) -> bool {
    UNTYPED.contains(&word) || matches!(word, "let" | "const")
}

/// The type that other languages call so.
pub(super) fn type_of(word: &str) -> &str {
    literal::type_meant(word).unwrap_or(word)
}

/// Reports `Int x` or `var x`, with the two words next, and takes the first of them.
pub(super) fn foreign_variable(parser: &mut Parser<'_>, keyword: &str) {
    let (word, name) = (parser.span(), parser.nth_span(1));
    let text = parser.word();
    let after_name = parser.nth(2);
    let form = if keyword.is_empty() {
        "`x: Int = 0`"
    } else {
        "`let x = 0`"
    };
    let what = if keyword.is_empty() {
        "a variable of the state"
    } else {
        "a local variable"
    };
    let problem = Diagnostic::new(
        Code::ForeignDeclaration,
        word.to(name),
        format!("{what} is written {form}"),
    );
    let name_text = name.of(parser.text);
    let fix = if is_untyped(text) {
        // Without `let`, a variable needs its type.
        let ty = super::declaration::type_ahead(parser, 3).filter(|_| after_name == Equal);
        match ty {
            _ if !keyword.is_empty() || after_name == SyntaxKind::Colon => {
                Some(format!("{keyword}{name_text}"))
            }
            ty => ty.map(|ty| format!("{name_text}: {ty}")),
        }
    } else {
        Some(format!("{keyword}{name_text}: {}", type_of(text)))
    };
    parser.report(match fix {
        Some(fix) => problem.replace(format!("write `{fix}`"), word.to(name), fix),
        None => problem,
    });
    if is_untyped(text) {
        parser.start(Error);
        parser.bump();
        parser.finish();
    } else {
        super::types::any(parser);
    }
}

/// The message about a statement of another language, if the word at its start is one.
pub(super) fn foreign_statement(parser: &Parser<'_>) -> Option<&'static str> {
    let next = parser.nth(1);
    let alone = matches!(next, Newline | Semicolon | Dedent | EndOfFile);
    let heads =
        !next.is_assignment() && !matches!(next, Dot | LeftBracket | SyntaxKind::Colon) && !alone;
    Some(match parser.word() {
        "while" | "loop" | "repeat" | "until" if heads && !calls(parser) => {
            "every activation ends: write an action, which runs again while its guard holds, or a `for`"
        }
        "loop" | "repeat" if alone => {
            "every activation ends: write an action, which runs again while its guard holds, or a `for`"
        }
        "switch" | "match" | "case" if heads && !calls(parser) => "write `if` and `elif`",
        "unless" if heads && !calls(parser) => "write `if not (condition)`",
        "throw" | "raise" if heads && !calls(parser) => {
            "`fail(\"reason\")` stops the robot's program"
        }
        "del" | "delete" if heads && !calls(parser) => {
            "`m.remove(key)` removes a key of a map, and `xs.remove_at(i)` an element of a list"
        }
        "yield" | "await" if heads && !calls(parser) => {
            "nothing waits in an effect: write `pre condition for 5s`, or `every 5s`, in an action"
        }
        "end" | "endif" | "fi" | "endfor" | "endwhile" | "done" if alone => {
            "a block ends with its indentation: remove this line"
        }
        "break" | "continue" if alone => {
            "a `for` always iterates over its whole collection: use an `if` in it, or `return`"
        }
        "pass" | "skip" if alone => "leave the block out",
        "assert" if heads && !calls(parser) => {
            "declare a property, `always name: condition`, which is judged on every run"
        }
        "try" | "except" | "catch" if alone || next == SyntaxKind::Colon => {
            "a run-time error stops the robot's program: test before, for example with `if some`"
        }
        _ => return None,
    })
}

/// Whether the word that is next is called: brackets follow it, and nothing is indented under it.
fn calls(parser: &Parser<'_>) -> bool {
    parser.nth(1) == LeftParen && {
        let end = (1..)
            .find(|ahead| matches!(parser.nth(*ahead), Newline | Semicolon | EndOfFile | Dedent));
        end.is_some_and(|end| parser.nth(end - 1) == RightParen && parser.nth(end + 1) != Indent)
    }
}

/// Adds what helps if what cannot stand here is the syntax of another language.
pub(super) fn with_habit(parser: &Parser<'_>, expected: &str, problem: Diagnostic) -> Diagnostic {
    let (current, before) = (parser.current(), before(parser));
    let (kind_before, word_before) = before;
    if parser.at_word("is") {
        let is_negated = parser.nth(1) == NotKeyword;
        let operator = if is_negated { "!=" } else { "==" };
        let span = match is_negated {
            true => parser.span().to(parser.nth_span(1)),
            false => parser.span(),
        };
        return problem.replace(format!("write `{operator}`"), span, operator);
    }
    if current == SyntaxKind::Colon && expected == "`then`" {
        return problem.replace("write `then`", parser.span(), " then");
    }
    let word = parser.word();
    let note = match (current, expected) {
        (IfKeyword, expected) if expected == Newline.name() => {
            "a statement with a condition is `if condition then statement`"
        }
        (LetKeyword, "a value") => "`if some y = x` names the value of an optional",
        (Ellipsis, _) => "a range is `a..b`, and ends before `b`",
        (Identifier, _) if word == "to" => "a range is `a..b`, and ends before `b`",
        (Question, _) if parser.nth(1) == Dot => {
            "an optional is tested: `if some y = x` names its value, and `x ?? default` replaces a missing one"
        }
        (LeftBrace, _) if expected == "an indented block" => return problem,
        (StringLiteral, _) if is_formatted_text(parser) => {
            "write `log(\"x is {}\", x)`, or `\"x is \" + String(x)`"
        }
        (LeftBrace, _) if word_before.starts_with(|c: char| c.is_ascii_uppercase()) => {
            "a record is made by a call, as in `Pair(x = 1, y = 2)`"
        }
        (_, "`else`") if parser.at_line_end() => {
            "a choice needs both values; for `a` implies `b`, write `not (a) or b`"
        }
        (Colon, "`]`") => "a part of a list is `xs.slice(start, end)`",
        (Comma, "`=`") => "the names of the parts of a tuple are in brackets: `let (a, b) = pair`",
        (Equal, _) if parser.nth(1) == Greater => {
            "functions are not values: declare one with `function`"
        }
        (Identifier, _) if word == "as" => "`Float(x)`, `Int(x)` and `String(x)` convert a value",
        (_, "a declaration") if word == "every" => {
            "an action repeats something: `name()`, and under it `every 5s` and `eff`"
        }
        (DurationLiteral, _) if word_before == "after" => {
            "keep the moment in a variable, `since: Time = now`, and compare `now - since > 5s`, or write \
             `pre condition for 5s`"
        }
        (Identifier, _) if word_before == "typeof" => "every name has the type of its declaration",
        (Question, _) => "a choice of two values is written `if condition then a else b`",
        (Star, _) if kind_before == Some(Star) => "a power is written `pow(x, 2.0)` or `x * x`",
        (Equal, _) if kind_before == Some(DotDot) => "`a..b` ends before `b`: write `a..b + 1`",
        (LeftBracket, "a type") => "a list of Ints is written `List[Int]`",
        (RightBracket, "a type") => "a list of Points is written `List[Point]`",
        (Arrow, _) => "a function begins with `function`; an action has no result",
        (Comma, expected) if expected == Newline.name() => "write an assignment for each variable",
        (Identifier, _) if word_before == "lambda" => {
            "functions are not values: declare one with `function`"
        }
        (Equal, _) if opens_loop(parser) => "`for i in 0..n` counts from 0 to below `n`",
        _ => return problem,
    };
    problem.note(note)
}

/// Whether `for (i` precedes the next lexeme.
fn opens_loop(parser: &Parser<'_>) -> bool {
    let kinds = [3, 2, 1].map(|back| {
        let at = parser.position.checked_sub(back)?;
        parser.lexemes.get(at).map(|lexeme| lexeme.kind)
    });
    kinds == [ForKeyword, LeftParen, Identifier].map(Some)
}

/// The lexeme before the next one, and its text.
fn before<'a>(parser: &Parser<'a>) -> (Option<SyntaxKind>, &'a str) {
    let Some(lexeme) = (parser.position.checked_sub(1)).and_then(|at| parser.lexemes.get(at))
    else {
        return (None, "");
    };
    let span = parser.tokens.span(lexeme.index as usize);
    (Some(lexeme.kind), span.of(parser.text))
}

/// Whether the text that is next has the letter `f` of Python directly before it.
pub(super) fn is_formatted_text(parser: &Parser<'_>) -> bool {
    let start = parser.span().start;
    parser.at(StringLiteral)
        && matches!(before(parser), (Some(Identifier), "f" | "r" | "b" | "F"))
        && parser.end_of_last() == start
}

/// Reports an operator of another language, and how it is written here.
pub(super) fn foreign_operator(
    parser: &mut Parser<'_>,
    span: Span,
    message: &str,
    fix: (&str, &str),
) {
    let problem = Diagnostic::new(Code::ForeignOperator, span, message);
    parser.report(problem.replace(fix.0, span, fix.1));
}
