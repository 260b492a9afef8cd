//! The parser: a recursive descent from tokens to the tree that never fails.
//!
//! Every token goes into the tree in order, so the tree's text is the source. Text that cannot be parsed goes into
//! nodes of the kind `Error`, up to the end of its line; then parsing continues. Each function that parses something
//! either takes a token or leaves the work to one that does, so that it always ends.
//!
//! The rules of a grammar refer to each other in circles. Therefore the functions are methods of the parser, which
//! share one namespace: a file has those of one part of the language and imports only types and tables of others.

mod action;
mod assignment;
mod block;
mod collection;
mod declaration;
mod expression;
mod form;
mod handler;
mod item;
mod koord;
mod operand;
mod property;
mod record;
mod recovery;
mod report;
mod shared;
mod slips;
mod stable;
mod statement;
mod tree;
mod types;
mod words;

use alloc::vec::Vec;

use rowan::{GreenNode, GreenNodeBuilder};

use super::SyntaxKind::{self, *};
use super::layout::Lexeme;
use super::lexer::Tokens;
use crate::diagnostic::{Code, Diagnostic, Span};

/// The greatest depth of the tree, counting nodes with parts: enough for any program written by hand, and small enough
/// that recursive walks need little stack.
pub const MAX_DEPTH: u32 = 200;

/// The tree of a text and its problems.
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
    parser.source_file();
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

    /// The kind of the lexeme before the next one.
    fn previous(&self) -> Option<SyntaxKind> {
        let before = self.lexemes.get(self.position.checked_sub(1)?)?;
        Some(before.kind)
    }

    /// The number of the token with which the next lexeme begins.
    fn next_token(&self) -> usize {
        let next = self.lexemes.get(self.position);
        next.map_or(self.tokens.len(), |lexeme| lexeme.index as usize)
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

    /// Whether an indented block is under the line that ends here.
    fn at_block(&self) -> bool {
        self.at(Newline) && self.nth(1) == Indent
    }

    /// How many lexemes stand before the end of the line or statement, at least `from`.
    fn line_end(&self, from: usize) -> usize {
        let ends =
            |ahead: &usize| matches!(self.nth(*ahead), Newline | Semicolon | Dedent | EndOfFile);
        (from..).find(ends).unwrap_or(from)
    }

    /// Whether the bracket that starts here lacks its partner, which is reported.
    fn is_unpaired(&self, start: u32) -> bool {
        self.unpaired.binary_search(&start).is_ok()
    }

    /// Whether the next lexeme ends what stands on a line.
    fn at_line_end(&self) -> bool {
        matches!(
            self.current(),
            Newline | Semicolon | Indent | Dedent | EndOfFile
        )
    }
}
