//! The parts of a file: the header and declarations, one after another.

use alloc::format;

use rowan::Checkpoint;

use super::form::form;
use super::{Code, Diagnostic, Parser, Span, SyntaxKind, SyntaxKind::*};
use super::{block, slips, stable, statement};

/// Where a declaration stands.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    /// In the file itself.
    File,
    /// In a role.
    Role,
}

/// The whole file.
pub(super) fn source_file(parser: &mut Parser<'_>) {
    // Comments before anything else are part of the file too.
    parser
        .builder
        .start_node(rowan::SyntaxKind(SourceFile as u16));
    missing_header(parser);
    items(parser, Place::File);
    while !parser.at(EndOfFile) {
        parser.bump();
    }
    parser.flush_trivia();
    parser.finish();
}

fn missing_header(parser: &mut Parser<'_>) {
    let word = if parser.at(Identifier) {
        parser.word()
    } else {
        ""
    };
    if matches!(
        word,
        "program" | "library" | "agent" | "automaton" | "module"
    ) || parser.at(Indent)
    {
        return;
    }
    let start = parser.span().start;
    let problem = Diagnostic::new(
        Code::MissingHeader,
        Span::empty(start),
        "a file begins with `program` or `library` and its name",
    );
    parser.report(problem.replace(
        "begin with `program Name`",
        Span::empty(start),
        "program Name\n\n",
    ));
}

/// Declarations to the end of the file or of the block.
pub(super) fn items(parser: &mut Parser<'_>, place: Place) {
    loop {
        match parser.current() {
            Dedent | EndOfFile => return,
            Newline | Semicolon => parser.bump(),
            Indent if place == Place::File => {
                block::unexpected_indentation(parser, |parser| indented_items(parser, Place::File));
            }
            Indent => {
                block::unexpected_indentation(parser, |parser| indented_items(parser, Place::Role));
            }
            _ => {
                item(parser, place);
                parser.end_line();
            }
        }
    }
}

/// Declarations that are indented for no reason; other lines that are, are left alone.
fn indented_items(parser: &mut Parser<'_>, place: Place) {
    if form(parser).is_some() {
        return items(parser, place);
    }
    while !matches!(parser.current(), Dedent | EndOfFile) {
        if parser.at(Indent) {
            parser.skip_block();
        } else {
            parser.bump();
        }
    }
}

fn item(parser: &mut Parser<'_>, place: Place) {
    let first = parser.position;
    let start = parser.checkpoint_with_documentation();
    let at = parser.span();
    if let Some((kind, parse)) = form(parser) {
        check_place(parser, kind, place, first, at);
        if kind == VariableDeclaration {
            stable::check_place(parser, place);
        }
        parse(parser);
        parser.start_at(start, kind);
        parser.finish();
    } else {
        other(parser, start);
    }
}

/// Reports a declaration that cannot stand where it does.
fn check_place(parser: &mut Parser<'_>, kind: SyntaxKind, place: Place, first: usize, at: Span) {
    let in_role = matches!(
        kind,
        InitDeclaration
            | ActionDeclaration
            | HandlerDeclaration
            | VariableDeclaration
            | BindingDeclaration
    );
    let word = at.of(parser.text);
    if place == Place::Role && !in_role {
        let problem = Diagnostic::new(
            Code::Misplaced,
            at,
            format!("`{word}` is not allowed in a role"),
        );
        parser.report(problem.note(
            "a role contains variables, `init`, actions and handlers; declare the rest outside",
        ));
    } else if matches!(kind, ProgramHeader | LibraryHeader) && first > 0 {
        let problem = Diagnostic::new(
            Code::Misplaced,
            at,
            format!("`{word}` can only be the first line"),
        );
        parser.report(problem.note("a file holds one program or one library"));
    }
}

/// Text that is not a declaration.
fn other(parser: &mut Parser<'_>, start: Checkpoint) {
    match parser.current() {
        PreKeyword | EffKeyword => {
            let problem = Diagnostic::new(
                Code::Misplaced,
                parser.span(),
                format!("{} is outside of an action", parser.found()),
            );
            parser.report(
                problem.note("it stands indented under the name of an action, as in `pick()`"),
            );
            parser.skip_line_and_block();
        }
        _ if is_statement(parser) => {
            let problem = Diagnostic::new(
                Code::Misplaced,
                parser.span(),
                "a statement cannot stand here",
            );
            let note = "statements belong in `init`, in the `eff` of an action, in a handler or a function";
            parser.report(problem.note(note));
            statement::statement(parser, statement::Place::OwnLine);
            parser.start_at(start, Error);
            parser.finish();
        }
        _ => {
            parser.unexpected("a declaration");
            parser.skip_line_and_block();
        }
    }
}

fn is_statement(parser: &Parser<'_>) -> bool {
    match parser.current() {
        IfKeyword | ForKeyword | ReturnKeyword => true,
        Identifier => {
            let next = parser.nth(1);
            next.is_assignment()
                || matches!(next, Dot | LeftParen | LeftBracket | PlusPlus | Bang)
                || (parser.word() == "atomic" && next == Newline)
                || slips::foreign_statement(parser).is_some()
        }
        _ => false,
    }
}

/// The name of the declaration.
pub(super) fn name(parser: &mut Parser<'_>) {
    if parser.current().is_keyword() {
        let message = format!("{} is a keyword and cannot be a name", parser.found());
        let problem = Diagnostic::new(Code::KeywordAsName, parser.span(), message);
        let other = format!("{}_", parser.word());
        let span = parser.span();
        parser.report(problem.replace("choose another name", span, other));
    } else if !parser.at(Identifier) {
        return parser.unexpected("a name");
    }
    parser.start(Name);
    parser.bump();
    parser.finish();
}
