//! How far a line is indented.

use super::piece::Piece;
use starl_lang::syntax::SyntaxKind::*;

/// How many spaces a block is indented.
pub(super) const STEP: usize = 4;

/// The state of a construct that began in a line above and continues.
#[derive(Default)]
pub(super) struct Continuation {
    /// The indentation of the line in which it began.
    base: usize,
    /// Whether a block follows it, from which its further lines must stand apart.
    heads_block: bool,
    /// The indentation of the lines in which the open brackets are.
    brackets: Vec<usize>,
}

impl Continuation {
    /// The indentation of the line that begins with the piece.
    pub fn indentation(&mut self, first: &Piece) -> usize {
        let kind = first.content.kind();
        if !first.continues {
            self.base = first.depth * STEP;
            self.heads_block = matches!(kind, Some(IfKeyword | ElifKeyword | ForKeyword));
            self.brackets.clear();
            return self.base;
        }
        match self.brackets.last() {
            Some(line) if kind.is_some_and(|kind| kind.is_closing()) => *line,
            Some(line) => line + STEP,
            None if self.heads_block => self.base + 2 * STEP,
            None => self.base + STEP,
        }
    }

    /// Notes a piece of a line that is indented so.
    pub fn pass(&mut self, piece: &Piece, indentation: usize) {
        let Some(kind) = piece.content.kind() else {
            return;
        };
        if kind.closing().is_some() {
            self.brackets.push(indentation);
        } else if kind.is_closing() {
            self.brackets.pop();
        }
    }
}
