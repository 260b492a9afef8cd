//! Headers, parameters, constants, variables, bindings, functions, `init` and roles.

use alloc::format;
use alloc::string::String;

use super::expression::Shape;
use super::form::by_meaning;
use super::item::Place;
use super::slips::{HeaderColon, foreign_declaration};
use super::{Code, Diagnostic, Parser, Span, SyntaxKind, SyntaxKind::*};

impl Parser<'_> {
    /// Whether the word that is next begins a declaration rather than naming something: another word follows.
    pub(super) fn is_contextual(&self) -> bool {
        let next = self.nth(1);
        let bracket = next == LeftBracket && self.word() == "allread" || self.word() == "allwrite";
        let alone = matches!(next, Newline | EndOfFile | Dedent);
        next == Identifier
            || next.is_keyword() && !matches!(next, AndKeyword | OrKeyword | InKeyword)
            || alone
            || bracket && next == LeftBracket
    }

    /// `program Name` or `library Name`.
    pub(super) fn header(&mut self) {
        self.bump();
        self.name();
        self.header_colon(HeaderColon::Remove);
    }

    /// `import name`.
    pub(super) fn import(&mut self) {
        self.bump();
        self.name();
        let rest = self.end_of_last();
        if self.at_word("as") || self.at_word("from") {
            let message = "a library is imported as a whole, by its name";
            self.drop_rest(rest, message, |_| "".into());
        } else if self.at(Comma) {
            let message = "each library is imported on a line of its own";
            self.drop_rest(rest, message, |rest| {
                let names = rest
                    .split(',')
                    .map(str::trim)
                    .filter(|name| !name.is_empty());
                names.map(|name| format!("\nimport {name}")).collect()
            });
        }
    }

    /// `from name import something`.
    pub(super) fn import_from(&mut self) {
        let (word, library) = (self.span(), self.nth_span(1));
        let rest = Span::new(library.end, library.end);
        self.bump();
        self.name();
        self.skip_to_line_end();
        let form = format!("import {}", library.of(self.text));
        let span = Span::new(word.start, self.end_of_last().max(rest.end));
        let message = "a library is imported as a whole";
        let problem = Diagnostic::new(Code::ForeignDeclaration, word, message);
        let note = format!(
            "its declarations are named `{}.something`",
            library.of(self.text)
        );
        self.report(problem.note(note).write(span, form));
    }

    /// Reports what follows on the line, after the byte `end`, and what should stand there.
    fn drop_rest(&mut self, end: u32, message: &str, meant: fn(&str) -> String) {
        let first = self.span();
        self.skip_to_line_end();
        let rest = Span::new(end, self.end_of_last());
        let meant = meant(rest.of(self.text));
        let form = match meant.trim() {
            "" => "remove the rest of the line".into(),
            meant => format!("write `{}`", meant.replace('\n', "`, `")),
        };
        let problem = Diagnostic::new(Code::ForeignDeclaration, first, message);
        self.report(problem.replace(form, rest, meant));
    }

    /// `param name: Type in from..before = default`.
    pub(super) fn parameter(&mut self) {
        self.bump();
        self.name();
        let place = Span::empty(self.end_of_last());
        if let Some(ty) = self.type_ahead(1).filter(|_| self.at(Equal)) {
            let problem = Diagnostic::new(Code::Unexpected, place, "the parameter needs a type");
            let form = format!(": {ty}");
            self.report(problem.write(place, form));
            self.initial_value();
        } else if self.expect(Colon) {
            self.any_type();
            self.range();
            self.initial_value();
        }
    }

    /// `in from..before`, if that is next.
    fn range(&mut self) {
        if self.at(InKeyword) {
            self.start(ParameterRange);
            self.bump();
            self.expression();
            self.finish();
        }
    }

    /// `const name = value`, or with its type.
    pub(super) fn constant(&mut self) {
        self.bump();
        self.name();
        if self.eat(Colon) {
            self.any_type();
        }
        if self.expect(Equal) {
            self.expression();
        }
    }

    /// `name: Type`, and a range and a value if it has them.
    pub(super) fn variable(&mut self) {
        self.name();
        self.expect(Colon);
        if let Some(ty) = self.type_ahead(1).filter(|_| self.at(Equal)) {
            let place = Span::empty(self.end_of_last());
            let problem = Diagnostic::new(Code::Unexpected, place, "the variable needs a type");
            self.report(problem.write(place, format!(" {ty}")));
        } else {
            self.any_type();
        }
        self.range();
        self.initial_value();
    }

    /// `name: Type = value`, of which the type and the value may be missing.
    fn name_and_value(&mut self) {
        self.name();
        if self.eat(Colon) {
            self.any_type();
        }
        self.initial_value();
    }

    /// `= value`, if that is next.
    pub(super) fn initial_value(&mut self) {
        if self.eat(Equal) {
            self.expression();
        }
    }

    /// `let x = 1` where a variable of the state is declared.
    pub(super) fn let_variable(&mut self) {
        let span = self.span();
        let message = "a variable of the state is declared without `let`, with its type";
        let problem = Diagnostic::new(Code::ForeignDeclaration, span, message);
        let typed = self.nth(2) == Colon;
        let until_name = Span::new(span.start, self.nth_span(1).start);
        let until_value = span.to(self.nth_span(1));
        let named = self.nth_span(1).of(self.text);
        self.report(match self.type_ahead(3) {
            _ if typed => problem.replace("remove `let`", until_name, ""),
            Some(ty) => {
                let form = format!("{named}: {ty}");
                problem.write(until_value, form)
            }
            None => problem.note("such as `x: Int = 0`"),
        });
        self.bump();
        self.name_and_value();
    }

    /// `Int x = 1` or `var x = 1`.
    pub(super) fn foreign_variable(&mut self) {
        self.foreign_variable_word("");
        self.name_and_value();
    }

    /// `name = Primitive(arguments)`.
    pub(super) fn binding(&mut self) {
        let named = self.span();
        self.name();
        self.bump();
        let (first, constructor) = (self.current(), self.span());
        let shape = self.expression().shape;
        if matches!(shape, Shape::Call | Shape::Broken) {
            return;
        }
        let text = named.of(self.text);
        let message = format!("the variable `{text}` needs a type");
        let problem = Diagnostic::new(Code::ForeignDeclaration, named, message)
            .expected("`name: Type = value`")
            .note("only a primitive is bound without one, as in `motion = ReachAvoid()`");
        let place = Span::empty(named.end);
        let value = Span::new(constructor.start, self.end_of_last());
        let is_primitive = value
            .of(self.text)
            .starts_with(|c: char| c.is_ascii_uppercase());
        self.report(match type_of(first).filter(|_| self.at_line_end()) {
            _ if shape == Shape::Target && is_primitive => {
                let form = format!("write `{}()`", value.of(self.text));
                problem.replace(form, Span::empty(value.end), "()")
            }
            Some(ty) => problem.replace(format!("write `{text}: {ty}`"), place, format!(": {ty}")),
            None => problem,
        });
    }

    /// The type of the value after `ahead` lexemes, if it is a literal that ends its line.
    pub(super) fn type_ahead(&self, ahead: usize) -> Option<&'static str> {
        let ends = matches!(
            self.nth(ahead + 1),
            Newline | EndOfFile | Dedent | Semicolon
        );
        type_of(self.nth(ahead)).filter(|_| ends)
    }

    /// `function name(a: T) -> V`, with a block or `= value`.
    pub(super) fn function(&mut self) {
        self.bump();
        self.function_from_name();
    }

    /// Whether a name, brackets and `->` are next.
    pub(super) fn is_function_without_word(&self) -> bool {
        let end = (1..).find(|ahead| matches!(self.nth(*ahead), RightParen | Newline | EndOfFile));
        end.is_some_and(|end| self.nth(end) == RightParen && self.nth(end + 1) == Arrow)
    }

    /// `name(a: T) -> V`, which begins with `function`.
    pub(super) fn function_without_word(&mut self) {
        let named = self.span();
        let message = "the declaration of a function begins with `function`";
        let problem = Diagnostic::new(Code::ForeignDeclaration, named, message);
        self.report(problem.write(Span::empty(named.start), "function "));
        self.function_from_name();
    }

    fn function_from_name(&mut self) {
        let reported = self.diagnostics.len();
        self.name();
        self.parameters();
        if self.at(Colon) && self.nth(1) == Identifier {
            let message = "the type of the result stands after `->`";
            self.report_operator(self.span(), message, " ->");
            self.bump();
            self.any_type();
        } else if self.eat(Arrow) {
            self.any_type();
        } else {
            // Where its parameters lack their types too, that is said.
            if self.diagnostics.len() == reported {
                self.unexpected("`->` and the type of the result");
                let note =
                    "statements that run by themselves are an action: `name()`, and under it `eff`";
                let last = self.diagnostics.last_mut().into_iter();
                last.for_each(|last| last.notes.push(note.into()));
            }
            if self.at(Colon) && self.nth(1) == Newline {
                self.bump_error();
            }
        }
        if self.eat(Equal) {
            self.expression();
        } else {
            self.indented("a function");
        }
    }

    /// `(a: T, b: T)`.
    pub(super) fn parameters(&mut self) {
        if !self.at(LeftParen) {
            return self.unexpected("parameters in brackets, as in `(x: Int)`");
        }
        self.bracketed(ParameterList, RightParen, |parser| {
            parser.typed_name(Parameter);
        });
    }

    /// Whether the `init` that is next is the block, not a name.
    pub(super) fn is_init(&self) -> bool {
        match self.nth(1) {
            Colon => self.nth(2) == Newline && !matches!(self.nth(4), PreKeyword | EffKeyword),
            Newline => !matches!(self.nth(3), PreKeyword | EffKeyword),
            next => matches!(
                next,
                Identifier | IfKeyword | ForKeyword | LetKeyword | ReturnKeyword
            ),
        }
    }

    /// `init`, with statements on its line or indented.
    pub(super) fn init(&mut self) {
        self.bump();
        self.block_after_word("`init`", false);
    }

    /// `role name`, with what only its robots do.
    pub(super) fn role(&mut self) {
        self.bump();
        self.name();
        self.header_colon(HeaderColon::Remove);
        if !self.expect_block("a role") {
            return;
        }
        self.start(RoleBody);
        self.bump();
        self.inside_indentation(|parser| parser.items(Place::Role));
        self.finish();
    }

    /// `action name()`, which is written `name()`.
    pub(super) fn foreign_action(&mut self) {
        let span = Span::new(self.span().start, self.nth_span(1).start);
        let message = "an action begins with its name";
        let problem = Diagnostic::new(Code::ForeignDeclaration, span, message);
        self.report(problem.replace("remove this word", span, ""));
        self.bump_error();
        self.action();
    }

    /// A declaration that begins with the word of another language, or a misspelt one.
    pub(super) fn foreign_word(&mut self) {
        let span = self.span();
        let Some(meant) = foreign_declaration(self.word()) else {
            return;
        };
        let message = format!("{} does not begin a declaration", self.found());
        let problem = Diagnostic::new(Code::ForeignDeclaration, span, message);
        self.report(problem.replace(format!("did you mean `{meant}`?"), span, meant));
        if let Some((_, parse)) = by_meaning(meant) {
            parse(self);
        }
    }
}

/// The type of what begins with the literal.
fn type_of(literal: SyntaxKind) -> Option<&'static str> {
    Some(match literal {
        IntegerLiteral => "Int",
        FloatLiteral | LengthLiteral | AngleLiteral => "Float",
        DurationLiteral => "Duration",
        StringLiteral => "String",
        TrueKeyword | FalseKeyword => "Bool",
        _ => return None,
    })
}
