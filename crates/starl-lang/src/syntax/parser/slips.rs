//! Habits from other languages, and their fixes.

use alloc::format;

use super::{Code, Diagnostic, Parser, Span, SyntaxKind, SyntaxKind::*};
use crate::diagnostic::closest;
use crate::syntax::literal;

/// The treatment of a colon at the end of a header.
#[derive(Clone, Copy)]
pub(super) enum HeaderColon {
    /// It goes.
    Remove,
    /// `then` takes its place, if a statement follows on the line.
    Then,
}

impl<'a> Parser<'a> {
    /// Takes the colon that Python and Koord put at the end of a header.
    pub(super) fn header_colon(&mut self, colon: HeaderColon) {
        if !self.at(Colon) {
            return;
        }
        let span = self.span();
        self.bump();
        let problem = Diagnostic::new(Code::HeaderColon, span, "no colon is needed here");
        let needs_then = matches!(colon, HeaderColon::Then) && !self.at_line_end();
        self.report(if needs_then {
            problem.write(span, " then")
        } else {
            problem.replace("remove it", span, "")
        });
    }

    /// Reports `Int x` or `var x`, with the two words next, and takes the first of them.
    pub(super) fn foreign_variable_word(&mut self, keyword: &str) {
        let (word, name) = (self.span(), self.nth_span(1));
        let text = self.word();
        let after_name = self.nth(2);
        let message = match keyword {
            "" => "a variable of the state is written `x: Int = 0`",
            _ => "a local variable is written `let x = 0`",
        };
        let problem = Diagnostic::new(Code::ForeignDeclaration, word.to(name), message);
        let name_text = name.of(self.text);
        let fix = if is_untyped(text) {
            // Without `let`, a variable needs its type.
            let ty = self.type_ahead(3).filter(|_| after_name == Equal);
            match ty {
                _ if !keyword.is_empty() || after_name == Colon => {
                    Some(format!("{keyword}{name_text}"))
                }
                ty => ty.map(|ty| format!("{name_text}: {ty}")),
            }
        } else {
            Some(format!("{keyword}{name_text}: {}", type_of(text)))
        };
        self.report(match fix {
            Some(fix) => problem.write(word.to(name), fix),
            None => problem,
        });
        if is_untyped(text) {
            self.bump_error();
        } else {
            self.any_type();
        }
    }

    /// The message about a statement of another language, if the word at its start is one.
    pub(super) fn foreign_statement(&self) -> Option<&'static str> {
        let next = self.nth(1);
        let alone = matches!(next, Newline | Semicolon | Dedent | EndOfFile);
        let heads = !next.is_assignment() && !matches!(next, Dot | LeftBracket | Colon) && !alone;
        Some(match self.word() {
            "while" | "loop" | "repeat" | "until" if heads && !self.is_call() => {
                "every activation ends: write an action, which runs again while its guard holds, or a `for`"
            }
            "loop" | "repeat" if alone => {
                "every activation ends: write an action, which runs again while its guard holds, or a `for`"
            }
            "switch" | "match" | "case" if heads && !self.is_call() => "write `if` and `elif`",
            "unless" if heads && !self.is_call() => "write `if not (condition)`",
            "throw" | "raise" if heads && !self.is_call() => {
                "`fail(\"reason\")` stops the robot's program"
            }
            "del" | "delete" if heads && !self.is_call() => {
                "`m.remove(key)` removes a key of a map, and `xs.remove_at(i)` an element of a list"
            }
            "yield" | "await" if heads && !self.is_call() => {
                "nothing waits in an effect: write `pre condition for 5s`, or `every 5s`, in an action"
            }
            "end" | "endif" | "fi" | "endfor" | "endwhile" | "done" if alone => {
                "a block ends with its indentation: remove this line"
            }
            "break" | "continue" if alone => {
                "a `for` always iterates over its whole collection: use an `if` in it, or `return`"
            }
            "pass" | "skip" if alone => "leave the block out",
            "assert" if heads && !self.is_call() => {
                "declare a property, `always name: condition`, which is judged on every run"
            }
            "try" | "except" | "catch" if alone || next == Colon => {
                "a run-time error stops the robot's program: test before, for example with `if some`"
            }
            _ => return None,
        })
    }

    /// Whether the word that is next is called: brackets follow it, and nothing is indented under it.
    fn is_call(&self) -> bool {
        let end = self.line_end(1);
        let closes = self.nth(end - 1) == RightParen && self.nth(end + 1) != Indent;
        self.nth(1) == LeftParen && closes
    }

    /// Adds what helps if what cannot stand here is the syntax of another language.
    pub(super) fn with_habit(&self, expected: &str, problem: Diagnostic) -> Diagnostic {
        let (current, before) = (self.current(), self.lexeme_before());
        let (kind_before, word_before) = before;
        if self.at_word("is") {
            let is_negated = self.nth(1) == NotKeyword;
            let operator = if is_negated { "!=" } else { "==" };
            let span = match is_negated {
                true => self.span().to(self.nth_span(1)),
                false => self.span(),
            };
            return problem.write(span, operator);
        }
        if current == Colon && expected == "`then`" {
            return problem.write(self.span(), " then");
        }
        let word = self.word();
        let note = match (current, expected) {
            (IfKeyword, expected) if expected == Newline.name() => {
                "a statement with a condition is `if condition then statement`"
            }
            (LetKeyword, "a value") => "`if some y = x` names the value of an optional",
            (Ellipsis, _) => "a range is `a..b`, and ends before `b`",
            (Identifier, _) if word == "to" => "a range is `a..b`, and ends before `b`",
            (Question, _) if self.nth(1) == Dot => {
                "an optional is tested: `if some y = x` names its value, and `x ?? default` replaces a missing one"
            }
            (LeftBrace, _) if expected == "an indented block" => return problem,
            (StringLiteral, _) if self.is_formatted_text() => {
                "write `log(\"x is {}\", x)`, or `\"x is \" + String(x)`"
            }
            (LeftBrace, _) if word_before.starts_with(|c: char| c.is_ascii_uppercase()) => {
                "a record is made by a call, as in `Pair(x = 1, y = 2)`"
            }
            (_, "`else`") if self.at_line_end() => {
                "a choice needs both values; for `a` implies `b`, write `not (a) or b`"
            }
            (Colon, "`]`") => "a part of a list is `xs.slice(start, end)`",
            (Comma, "`=`") => {
                "the names of the parts of a tuple are in brackets: `let (a, b) = pair`"
            }
            (Equal, _) if self.nth(1) == Greater => {
                "functions are not values: declare one with `function`"
            }
            (Identifier, _) if word == "as" => {
                "`Float(x)`, `Int(x)` and `String(x)` convert a value"
            }
            (_, "a declaration") if word == "every" => {
                "an action repeats something: `name()`, and under it `every 5s` and `eff`"
            }
            (DurationLiteral, _) if word_before == "after" => {
                "keep the moment in a variable, `since: Time = now`, and compare `now - since > 5s`, or write \
             `pre condition for 5s`"
            }
            (Identifier, _) if word_before == "typeof" => {
                "every name has the type of its declaration"
            }
            (Question, _) => "a choice of two values is written `if condition then a else b`",
            (Star, _) if kind_before == Some(Star) => "a power is written `pow(x, 2.0)` or `x * x`",
            (Equal, _) if kind_before == Some(DotDot) => "`a..b` ends before `b`: write `a..b + 1`",
            (LeftBracket, "a type") => "a list of Ints is written `List[Int]`",
            (RightBracket, "a type") => "a list of Points is written `List[Point]`",
            (Arrow, _) => "a function begins with `function`; an action has no result",
            (Comma, expected) if expected == Newline.name() => {
                "write an assignment for each variable"
            }
            (Identifier, _) if word_before == "lambda" => {
                "functions are not values: declare one with `function`"
            }
            (Equal, _) if self.opens_loop() => "`for i in 0..n` counts from 0 to below `n`",
            _ => return problem,
        };
        problem.note(note)
    }

    /// Whether `for (i` precedes the next lexeme.
    fn opens_loop(&self) -> bool {
        let kinds = [3, 2, 1].map(|back| {
            let at = self.position.checked_sub(back)?;
            self.lexemes.get(at).map(|lexeme| lexeme.kind)
        });
        kinds == [ForKeyword, LeftParen, Identifier].map(Some)
    }

    /// The lexeme before the next one, and its text.
    fn lexeme_before(&self) -> (Option<SyntaxKind>, &'a str) {
        let Some(lexeme) = (self.position.checked_sub(1)).and_then(|at| self.lexemes.get(at))
        else {
            return (None, "");
        };
        let span = self.tokens.span(lexeme.index as usize);
        (Some(lexeme.kind), span.of(self.text))
    }

    /// Whether the text that is next has the letter `f` of Python directly before it.
    pub(super) fn is_formatted_text(&self) -> bool {
        let start = self.span().start;
        self.at(StringLiteral)
            && matches!(
                self.lexeme_before(),
                (Some(Identifier), "f" | "r" | "b" | "F")
            )
            && self.end_of_last() == start
    }

    /// Reports an operator of another language, and how it is written here.
    pub(super) fn report_operator(&mut self, span: Span, message: &str, meant: &str) {
        let problem = Diagnostic::new(Code::ForeignOperator, span, message);
        self.report(problem.write(span, meant));
    }
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
