//! From tokens to the tree: a recursive descent that never fails.
//!
//! Every token goes into the tree in order, so the tree's text is the source. What cannot be understood
//! goes into nodes of the kind `Error`, up to the end of its line; then it goes on. Each function that
//! parses something either takes a token or leaves the work to one that does, so that it always ends.

mod action;
mod block;
mod collection;
mod declaration;
mod expression;
mod item;
mod operand;
mod property;
mod record;
mod recovery;
mod shared;
mod slips;
mod statement;
mod types;

use alloc::string::String;
use alloc::vec::Vec;

use rowan::{Checkpoint, GreenNode, GreenNodeBuilder, Language as _};

use super::SyntaxKind::{self, *};
use super::kind::Language;
use super::layout::Lexeme;
use super::lexer::Tokens;
use crate::diagnostic::{Code, Diagnostic, Span};

/// How deep the tree may be, counting what has parts: enough for any program that a person wrote, and
/// little enough that whoever walks the tree needs little stack.
pub const MAX_DEPTH: u32 = 200;

/// The tree of a text and what is wrong with it.
pub(crate) fn parse(
    text: &str,
    tokens: &Tokens,
    lexemes: &[Lexeme],
    diagnostics: &mut Vec<Diagnostic>,
) -> GreenNode {
    let mut parser = Parser {
        text,
        tokens,
        lexemes,
        position: 0,
        flushed: 0,
        depth: 0,
        last_error: None,
        last_report: None,
        unpaired: unpaired(diagnostics),
        equals_compare: false,
        builder: GreenNodeBuilder::new(),
        diagnostics,
    };
    item::source_file(&mut parser);
    parser.builder.finish()
}

/// Where the brackets start that are reported already.
fn unpaired(diagnostics: &[Diagnostic]) -> Vec<u32> {
    let unbalanced = diagnostics
        .iter()
        .filter(|diagnostic| diagnostic.code == Code::UnbalancedBracket);
    let spans = |diagnostic: &Diagnostic| {
        let labels: Vec<Span> = diagnostic.labels.iter().map(|label| label.span).collect();
        labels.into_iter().chain([diagnostic.span])
    };
    let mut starts: Vec<u32> = unbalanced.flat_map(spans).map(|span| span.start).collect();
    starts.sort_unstable();
    starts
}

struct Parser<'a> {
    text: &'a str,
    tokens: &'a Tokens,
    lexemes: &'a [Lexeme],
    /// The next lexeme.
    position: usize,
    /// How many tokens are in the tree.
    flushed: usize,
    /// How many nested things are being parsed.
    depth: u32,
    /// Where something unexpected was reported last.
    last_error: Option<usize>,
    /// Where the last problem that was reported ends.
    last_report: Option<u32>,
    /// Where brackets without a partner start, which are reported already.
    unpaired: Vec<u32>,
    /// Whether a condition is being parsed, in which `=` can only be meant to compare.
    equals_compare: bool,
    builder: GreenNodeBuilder<'static>,
    diagnostics: &'a mut Vec<Diagnostic>,
}

impl<'a> Parser<'a> {
    /// The kind of the next lexeme.
    fn current(&self) -> SyntaxKind {
        self.nth(0)
    }

    /// The kind of the lexeme after `ahead` others.
    fn nth(&self, ahead: usize) -> SyntaxKind {
        self.lexemes
            .get(self.position + ahead)
            .map_or(EndOfFile, |lexeme| lexeme.kind)
    }

    fn at(&self, kind: SyntaxKind) -> bool {
        self.current() == kind
    }

    /// Whether the next lexeme is the name `word`.
    fn at_word(&self, word: &str) -> bool {
        self.at(Identifier) && self.span().of(self.text) == word
    }

    /// Where the next lexeme is.
    fn span(&self) -> Span {
        self.nth_span(0)
    }

    /// Where the lexeme after `ahead` others is.
    fn nth_span(&self, ahead: usize) -> Span {
        let Some(lexeme) = self.lexemes.get(self.position + ahead) else {
            return Span::empty(self.text.len() as u32);
        };
        let span = self.tokens.span(lexeme.index as usize);
        if matches!(lexeme.kind, Indent | Dedent) {
            Span::empty(span.start)
        } else {
            span
        }
    }

    /// The text of the next lexeme.
    fn word(&self) -> &'a str {
        self.span().of(self.text)
    }

    /// Where the last lexeme with text ended.
    fn end_of_last(&self) -> u32 {
        let before = self.lexemes[..self.position.min(self.lexemes.len())]
            .iter()
            .rev();
        let last = before
            .into_iter()
            .find(|lexeme| !matches!(lexeme.kind, Indent | Dedent | Newline));
        last.map_or(0, |last| self.tokens.span(last.index as usize).end)
    }

    /// Whether the next lexeme ends what stands on a line.
    fn at_line_end(&self) -> bool {
        matches!(
            self.current(),
            Newline | Semicolon | Indent | Dedent | EndOfFile
        )
    }

    /// Puts the next lexeme into the tree.
    fn bump(&mut self) {
        let Some(lexeme) = self.lexemes.get(self.position) else {
            return;
        };
        self.flush(lexeme.index as usize);
        self.position += 1;
        if !matches!(lexeme.kind, Indent | Dedent) {
            self.token(lexeme.kind);
        }
    }

    /// Takes the next lexeme if it is of this kind.
    fn eat(&mut self, kind: SyntaxKind) -> bool {
        let found = self.at(kind);
        if found {
            self.bump();
        }
        found
    }

    /// Takes the next lexeme, or reports that it is missing.
    fn expect(&mut self, kind: SyntaxKind) -> bool {
        let found = self.eat(kind);
        if !found {
            self.unexpected(kind.name());
        }
        found
    }

    /// Puts tokens into the tree, all trivia, up to the one at `index`.
    fn flush(&mut self, index: usize) {
        while self.flushed < index {
            let kind = self.tokens.kind(self.flushed);
            self.token(if kind == Newline { LineBreak } else { kind });
        }
    }

    fn token(&mut self, kind: SyntaxKind) {
        let text = self.tokens.span(self.flushed).of(self.text);
        self.builder.token(Language::kind_to_raw(kind), text);
        self.flushed += 1;
    }

    /// Puts the trivia before the next lexeme into the tree.
    fn flush_trivia(&mut self) {
        let next = self
            .lexemes
            .get(self.position)
            .map_or(self.tokens.len(), |lexeme| lexeme.index as usize);
        self.flush(next);
    }

    /// Starts a node with the next lexeme.
    fn start(&mut self, kind: SyntaxKind) {
        self.flush_trivia();
        self.builder.start_node(Language::kind_to_raw(kind));
    }

    /// A place before the next lexeme, where a node can be started later.
    fn checkpoint(&mut self) -> Checkpoint {
        self.flush_trivia();
        self.builder.checkpoint()
    }

    /// A place before the comments that document what comes next.
    fn checkpoint_with_documentation(&mut self) -> Checkpoint {
        let next = self
            .lexemes
            .get(self.position)
            .map_or(self.tokens.len(), |lexeme| lexeme.index as usize);
        let (mut start, mut lines) = (next, 0);
        for index in (self.flushed..next).rev() {
            match self.tokens.kind(index) {
                DocComment => (start, lines) = (index, 0),
                Newline if lines == 0 => lines = 1,
                Whitespace => {}
                _ => break,
            }
        }
        self.flush(start);
        self.builder.checkpoint()
    }

    fn start_at(&mut self, checkpoint: Checkpoint, kind: SyntaxKind) {
        self.builder
            .start_node_at(checkpoint, Language::kind_to_raw(kind));
    }

    fn finish(&mut self) {
        self.builder.finish_node();
    }

    fn report(&mut self, diagnostic: Diagnostic) {
        self.last_report = Some(diagnostic.span.end);
        self.diagnostics.push(diagnostic);
    }

    /// Reports that something else must stand here; once for each place.
    fn unexpected(&mut self, expected: &str) {
        let start = self.span().start;
        let known = self.unpaired.binary_search(&start).is_ok() && !self.at_line_end();
        let known = known || self.follows_unknown();
        if self.last_error.replace(self.position) == Some(self.position) || known {
            return;
        }
        let found = self.found();
        let (span, message) = if self.at_line_end() {
            (
                Span::empty(self.end_of_last()),
                alloc::format!("{expected} is missing"),
            )
        } else {
            (self.span(), alloc::format!("{found} cannot stand here"))
        };
        let code = Code::Unexpected;
        self.report(
            Diagnostic::new(code, span, message)
                .expected(expected)
                .found(found),
        );
    }

    /// Whether a character without meaning, which is reported, is right before what comes next.
    fn follows_unknown(&self) -> bool {
        let next = self
            .lexemes
            .get(self.position)
            .map_or(self.tokens.len(), |lexeme| lexeme.index as usize);
        let mut before = (0..next).rev().map(|index| self.tokens.kind(index));
        before.find(|kind| *kind != Whitespace) == Some(Unknown)
    }

    /// What the next lexeme is called where a person is told of it.
    fn found(&self) -> String {
        match self.current() {
            kind if kind.text().is_some() => kind.name().into(),
            kind @ (Newline | Indent | Dedent | EndOfFile) => kind.name().into(),
            _ => alloc::format!("`{}`", self.word()),
        }
    }
}
