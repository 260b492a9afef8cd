//! The parts of a file: the header and declarations, one after another.

use alloc::format;

use rowan::Checkpoint;

use super::statement::Place as StatementPlace;
use super::{Code, Diagnostic, Parser, Span, SyntaxKind, SyntaxKind::*};

/// Where a declaration stands.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    /// In the file itself.
    File,
    /// In a role.
    Role,
}

impl Parser<'_> {
    /// The whole file.
    pub(super) fn source_file(&mut self) {
        // Comments before anything else are part of the file too.
        self.builder
            .start_node(rowan::SyntaxKind(SourceFile as u16));
        self.missing_header();
        self.items(Place::File);
        while !self.at(EndOfFile) {
            self.bump();
        }
        self.flush_trivia();
        self.finish();
    }

    fn missing_header(&mut self) {
        let word = if self.at(Identifier) { self.word() } else { "" };
        if matches!(
            word,
            "program" | "library" | "agent" | "automaton" | "module"
        ) || self.at(Indent)
        {
            return;
        }
        let start = self.span().start;
        let message = "a file begins with `program` or `library` and its name";
        let problem = Diagnostic::new(Code::MissingHeader, Span::empty(start), message);
        self.report(problem.replace(
            "begin with `program Name`",
            Span::empty(start),
            "program Name\n\n",
        ));
    }

    /// Declarations to the end of the file or of the block.
    pub(super) fn items(&mut self, place: Place) {
        loop {
            match self.current() {
                Dedent | EndOfFile => return,
                Newline | Semicolon => self.bump(),
                Indent => self.unexpected_indentation(|parser| parser.indented_items(place)),
                _ => {
                    self.item(place);
                    self.end_line();
                }
            }
        }
    }

    /// Declarations that are indented for no reason; other lines that are, are left alone.
    fn indented_items(&mut self, place: Place) {
        if self.form().is_some() {
            return self.items(place);
        }
        while !matches!(self.current(), Dedent | EndOfFile) {
            if self.at(Indent) {
                self.skip_block();
            } else {
                self.bump();
            }
        }
    }

    fn item(&mut self, place: Place) {
        let first = self.position;
        let start = self.checkpoint_with_documentation();
        let at = self.span();
        if let Some((kind, parse)) = self.form() {
            self.check_place(kind, place, first, at);
            if kind == VariableDeclaration {
                self.check_stable_place(place);
            }
            parse(self);
            self.start_at(start, kind);
            self.finish();
        } else {
            self.not_a_declaration(start);
        }
    }

    /// Reports a declaration that cannot stand where it does.
    fn check_place(&mut self, kind: SyntaxKind, place: Place, first: usize, at: Span) {
        let in_role = matches!(
            kind,
            InitDeclaration
                | ActionDeclaration
                | HandlerDeclaration
                | VariableDeclaration
                | BindingDeclaration
        );
        let word = at.of(self.text);
        if place == Place::Role && !in_role {
            let message = format!("`{word}` is not allowed in a role");
            let problem = Diagnostic::new(Code::Misplaced, at, message);
            self.report(problem.note(
                "a role contains variables, `init`, actions and handlers; declare the rest outside",
            ));
        } else if matches!(kind, ProgramHeader | LibraryHeader) && first > 0 {
            let message = format!("`{word}` can only be the first line");
            let problem = Diagnostic::new(Code::Misplaced, at, message);
            self.report(problem.note("a file holds one program or one library"));
        }
    }

    /// Text that is not a declaration.
    fn not_a_declaration(&mut self, start: Checkpoint) {
        match self.current() {
            PreKeyword | EffKeyword => {
                let problem = Diagnostic::new(
                    Code::Misplaced,
                    self.span(),
                    format!("{} is outside of an action", self.found()),
                );
                self.report(
                    problem.note("it stands indented under the name of an action, as in `pick()`"),
                );
                self.skip_line_and_block();
            }
            _ if self.is_statement() => {
                let message = "a statement cannot stand here";
                let problem = Diagnostic::new(Code::Misplaced, self.span(), message);
                let note = "statements belong in `init`, in the `eff` of an action, in a handler or a function";
                self.report(problem.note(note));
                self.statement(StatementPlace::OwnLine);
                self.start_at(start, Error);
                self.finish();
            }
            _ => {
                self.unexpected("a declaration");
                self.skip_line_and_block();
            }
        }
    }

    fn is_statement(&self) -> bool {
        match self.current() {
            IfKeyword | ForKeyword | ReturnKeyword => true,
            Identifier => {
                let next = self.nth(1);
                next.is_assignment()
                    || matches!(next, Dot | LeftParen | LeftBracket | PlusPlus | Bang)
                    || (self.word() == "atomic" && next == Newline)
                    || self.foreign_statement().is_some()
            }
            _ => false,
        }
    }

    /// The name of the declaration.
    pub(super) fn name(&mut self) {
        if self.current().is_keyword() {
            let message = format!("{} is a keyword and cannot be a name", self.found());
            let problem = Diagnostic::new(Code::KeywordAsName, self.span(), message);
            let other = format!("{}_", self.word());
            let span = self.span();
            self.report(problem.replace("choose another name", span, other));
        } else if !self.at(Identifier) {
            return self.unexpected("a name");
        }
        self.start(Name);
        self.bump();
        self.finish();
    }
}
