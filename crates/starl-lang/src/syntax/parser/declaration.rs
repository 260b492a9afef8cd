//! Headers, parameters, constants, variables, bindings, functions, `init` and roles.

use alloc::format;
use alloc::string::String;

use super::item::{self, name};
use super::slips::{self, Colon as HeaderColon};
use super::{Code, Diagnostic, Parser, Span, SyntaxKind, SyntaxKind::*};
use super::{action, block, expression, form, record, types};

/// Whether the word that is next begins a declaration rather than naming something: another word follows.
pub(super) fn contextual(parser: &Parser<'_>) -> bool {
    let next = parser.nth(1);
    let bracket = next == LeftBracket && parser.word() == "allread" || parser.word() == "allwrite";
    let alone = matches!(next, Newline | EndOfFile | Dedent);
    next == Identifier
        || next.is_keyword() && !matches!(next, AndKeyword | OrKeyword | InKeyword)
        || alone
        || bracket && next == LeftBracket
}

/// `program Name` or `library Name`.
pub(super) fn header(parser: &mut Parser<'_>) {
    parser.bump();
    name(parser);
    slips::header_colon(parser, HeaderColon::Remove);
}

/// `import name`.
pub(super) fn import(parser: &mut Parser<'_>) {
    parser.bump();
    name(parser);
    let rest = parser.end_of_last();
    if parser.at_word("as") || parser.at_word("from") {
        let message = "a library is imported as a whole, by its name";
        drop_rest(parser, rest, message, |_| "".into());
    } else if parser.at(Comma) {
        let message = "each library is imported on a line of its own";
        drop_rest(parser, rest, message, |rest| {
            let names = rest
                .split(',')
                .map(str::trim)
                .filter(|name| !name.is_empty());
            names.map(|name| format!("\nimport {name}")).collect()
        });
    }
}

/// `from name import something`.
pub(super) fn import_from(parser: &mut Parser<'_>) {
    let (word, library) = (parser.span(), parser.nth_span(1));
    let rest = Span::new(library.end, library.end);
    parser.bump();
    name(parser);
    parser.skip_to_line_end();
    let form = format!("import {}", library.of(parser.text));
    let span = Span::new(word.start, parser.end_of_last().max(rest.end));
    let message = "a library is imported as a whole";
    let problem = Diagnostic::new(Code::ForeignDeclaration, word, message);
    let note = format!(
        "its declarations are named `{}.something`",
        library.of(parser.text)
    );
    parser.report(
        problem
            .note(note)
            .replace(format!("write `{form}`"), span, form),
    );
}

/// Reports what follows on the line, after the byte `end`, and what should stand there.
fn drop_rest(parser: &mut Parser<'_>, end: u32, message: &str, meant: fn(&str) -> String) {
    let first = parser.span();
    parser.skip_to_line_end();
    let rest = Span::new(end, parser.end_of_last());
    let meant = meant(rest.of(parser.text));
    let form = match meant.trim() {
        "" => "remove the rest of the line".into(),
        meant => format!("write `{}`", meant.replace('\n', "`, `")),
    };
    let problem = Diagnostic::new(Code::ForeignDeclaration, first, message);
    parser.report(problem.replace(form, rest, meant));
}

/// `param name: Type in from..before = default`.
pub(super) fn parameter(parser: &mut Parser<'_>) {
    parser.bump();
    name(parser);
    let place = Span::empty(parser.end_of_last());
    if let Some(ty) = type_ahead(parser, 1).filter(|_| parser.at(Equal)) {
        let problem = Diagnostic::new(Code::Unexpected, place, "the parameter needs a type");
        let form = format!(": {ty}");
        parser.report(problem.replace(format!("write `{form}`"), place, form));
        value(parser);
    } else if parser.expect(Colon) {
        types::any(parser);
        range(parser);
        value(parser);
    }
}

/// `in from..before`, if that is next.
fn range(parser: &mut Parser<'_>) {
    if parser.at(InKeyword) {
        parser.start(ParameterRange);
        parser.bump();
        expression::expression(parser);
        parser.finish();
    }
}

/// `const name = value`, or with its type.
pub(super) fn constant(parser: &mut Parser<'_>) {
    parser.bump();
    name(parser);
    if parser.eat(Colon) {
        types::any(parser);
    }
    if parser.expect(Equal) {
        expression::expression(parser);
    }
}

/// `name: Type`, and a range and a value if it has them.
pub(super) fn variable(parser: &mut Parser<'_>) {
    name(parser);
    parser.expect(Colon);
    if let Some(ty) = type_ahead(parser, 1).filter(|_| parser.at(Equal)) {
        let place = Span::empty(parser.end_of_last());
        let problem = Diagnostic::new(Code::Unexpected, place, "the variable needs a type");
        parser.report(problem.replace(format!("write `{ty}`"), place, format!(" {ty}")));
    } else {
        types::any(parser);
    }
    range(parser);
    value(parser);
}

/// `= value`, if that is next.
pub(super) fn value(parser: &mut Parser<'_>) {
    if parser.eat(Equal) {
        expression::expression(parser);
    }
}

/// `let x = 1` where a variable of the state is declared.
pub(super) fn let_variable(parser: &mut Parser<'_>) {
    let span = parser.span();
    let problem = Diagnostic::new(
        Code::ForeignDeclaration,
        span,
        "a variable of the state is declared without `let`, with its type",
    );
    let typed = parser.nth(2) == Colon;
    let until_name = Span::new(span.start, parser.nth_span(1).start);
    let until_value = span.to(parser.nth_span(1));
    let named = parser.nth_span(1).of(parser.text);
    parser.report(match type_ahead(parser, 3) {
        _ if typed => problem.replace("remove `let`", until_name, ""),
        Some(ty) => {
            let form = format!("{named}: {ty}");
            problem.replace(format!("write `{form}`"), until_value, form)
        }
        None => problem.note("such as `x: Int = 0`"),
    });
    parser.bump();
    name(parser);
    if parser.eat(Colon) {
        types::any(parser);
    }
    value(parser);
}

/// `Int x = 1` or `var x = 1`.
pub(super) fn foreign_variable(parser: &mut Parser<'_>) {
    slips::foreign_variable(parser, "");
    name(parser);
    if parser.eat(Colon) {
        types::any(parser);
    }
    value(parser);
}

/// `name = Primitive(arguments)`.
pub(super) fn binding(parser: &mut Parser<'_>) {
    let named = parser.span();
    name(parser);
    parser.bump();
    let (first, constructor) = (parser.current(), parser.span());
    let shape = expression::expression(parser);
    if matches!(shape, expression::Shape::Call | expression::Shape::Broken) {
        return;
    }
    let text = named.of(parser.text);
    let message = format!("the variable `{text}` needs a type");
    let problem = Diagnostic::new(Code::ForeignDeclaration, named, message)
        .expected("`name: Type = value`")
        .note("only a primitive is bound without one, as in `motion = ReachAvoid()`");
    let place = Span::empty(named.end);
    let value = Span::new(constructor.start, parser.end_of_last());
    let is_primitive = value
        .of(parser.text)
        .starts_with(|c: char| c.is_ascii_uppercase());
    parser.report(match type_of(first).filter(|_| parser.at_line_end()) {
        _ if shape == expression::Shape::Target && is_primitive => {
            let form = format!("write `{}()`", value.of(parser.text));
            problem.replace(form, Span::empty(value.end), "()")
        }
        Some(ty) => problem.replace(format!("write `{text}: {ty}`"), place, format!(": {ty}")),
        None => problem,
    });
}

/// The type of the value after `ahead` lexemes, if it is a literal that ends its line.
pub(super) fn type_ahead(parser: &Parser<'_>, ahead: usize) -> Option<&'static str> {
    let ends = matches!(
        parser.nth(ahead + 1),
        Newline | EndOfFile | Dedent | Semicolon
    );
    type_of(parser.nth(ahead)).filter(|_| ends)
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

/// `function name(a: T) -> V`, with a block or `= value`.
pub(super) fn function(parser: &mut Parser<'_>) {
    parser.bump();
    function_from_name(parser);
}

/// Whether a name, brackets and `->` are next.
pub(super) fn is_function_without_word(parser: &Parser<'_>) -> bool {
    let end = (1..).find(|ahead| matches!(parser.nth(*ahead), RightParen | Newline | EndOfFile));
    end.is_some_and(|end| parser.nth(end) == RightParen && parser.nth(end + 1) == Arrow)
}

/// `name(a: T) -> V`, which begins with `function`.
pub(super) fn function_without_word(parser: &mut Parser<'_>) {
    let named = parser.span();
    let message = "the declaration of a function begins with `function`";
    let problem = Diagnostic::new(Code::ForeignDeclaration, named, message);
    parser.report(problem.replace("write `function`", Span::empty(named.start), "function "));
    function_from_name(parser);
}

fn function_from_name(parser: &mut Parser<'_>) {
    let reported = parser.diagnostics.len();
    name(parser);
    parameters(parser);
    if parser.at(Colon) && parser.nth(1) == Identifier {
        let span = parser.span();
        slips::foreign_operator(
            parser,
            span,
            "the type of the result stands after `->`",
            ("write `->`", " ->"),
        );
        parser.bump();
        types::any(parser);
    } else if parser.eat(Arrow) {
        types::any(parser);
    } else {
        // Where its parameters lack their types too, that is said.
        if parser.diagnostics.len() == reported {
            parser.unexpected("`->` and the type of the result");
            let note =
                "statements that run by themselves are an action: `name()`, and under it `eff`";
            let last = parser.diagnostics.last_mut().into_iter();
            last.for_each(|last| last.notes.push(note.into()));
        }
        if parser.at(Colon) && parser.nth(1) == Newline {
            parser.start(Error);
            parser.bump();
            parser.finish();
        }
    }
    if parser.eat(Equal) {
        expression::expression(parser);
    } else {
        block::indented(parser, "a function");
    }
}

/// `(a: T, b: T)`.
pub(super) fn parameters(parser: &mut Parser<'_>) {
    let open = parser.span();
    if !parser.at(LeftParen) {
        return parser.unexpected("parameters in brackets, as in `(x: Int)`");
    }
    parser.start(ParameterList);
    parser.bump();
    parser.separated(RightParen, open, |parser| {
        record::typed_name(parser, Parameter)
    });
    parser.finish();
}

/// Whether the `init` that is next is the block, not a name.
pub(super) fn is_init(parser: &Parser<'_>) -> bool {
    match parser.nth(1) {
        Colon => parser.nth(2) == Newline && !matches!(parser.nth(4), PreKeyword | EffKeyword),
        Newline => !matches!(parser.nth(3), PreKeyword | EffKeyword),
        next => matches!(
            next,
            Identifier | IfKeyword | ForKeyword | LetKeyword | ReturnKeyword
        ),
    }
}

/// `init`, with statements on its line or indented.
pub(super) fn init(parser: &mut Parser<'_>) {
    parser.bump();
    block::after_word(parser, "`init`", false);
}

/// `role name`, with what only its robots do.
pub(super) fn role(parser: &mut Parser<'_>) {
    parser.bump();
    name(parser);
    slips::header_colon(parser, HeaderColon::Remove);
    if !block::opens_block(parser, "a role") {
        return;
    }
    parser.start(RoleBody);
    parser.bump();
    let entered = parser.deeper(|parser| {
        parser.bump();
        item::items(parser, item::Place::Role);
    });
    if entered.is_some() {
        parser.eat(Dedent);
    }
    parser.finish();
}

/// `action name()`, which is written `name()`.
pub(super) fn foreign_action(parser: &mut Parser<'_>) {
    let span = Span::new(parser.span().start, parser.nth_span(1).start);
    let problem = Diagnostic::new(
        Code::ForeignDeclaration,
        span,
        "an action begins with its name",
    );
    parser.report(problem.replace("remove this word", span, ""));
    parser.start(Error);
    parser.bump();
    parser.finish();
    action::action(parser);
}

/// A declaration that begins with the word of another language, or a misspelt one.
pub(super) fn foreign_word(parser: &mut Parser<'_>) {
    let span = parser.span();
    let Some(meant) = slips::foreign_declaration(parser.word()) else {
        return;
    };
    let message = format!("{} does not begin a declaration", parser.found());
    let problem = Diagnostic::new(Code::ForeignDeclaration, span, message);
    parser.report(problem.replace(format!("did you mean `{meant}`?"), span, meant));
    if let Some((_, parse)) = form::by_meaning(meant) {
        parse(parser);
    }
}
