//! The lines of the result.

use super::indent::Continuation;
use super::piece::{Content, Declaration, Piece};
use super::space;
use starl_lang::syntax::SyntaxKind::*;

/// A line, or a declaration that stays as it is.
pub(super) struct Line {
    /// How many spaces it is indented.
    pub indentation: usize,
    /// The text of the line, without the comment after it.
    pub text: String,
    /// The comment at its end, if something is before that.
    pub comment: Option<String>,
    /// How far the comment is from the text.
    pub comment_gap: usize,
    /// Whether an empty line is before it.
    pub blank: bool,
    /// How many blocks it is in.
    pub depth: usize,
    /// If a declaration starts on it, which.
    pub starts: Option<Declaration>,
    /// Its sort.
    pub sort: Sort,
}

/// The sort of a line, as far as the lines around it depend on it.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Sort {
    /// Only a comment.
    Comment,
    /// The second or a later part of something with parts, such as `else`.
    Part,
    /// A line that continues the one above.
    Continuation,
    /// Anything else.
    Other,
    /// A declaration with errors.
    Verbatim,
}

/// The lines that the pieces make.
pub(super) fn lines(pieces: Vec<Piece>) -> Vec<Line> {
    let mut lines: Vec<Line> = Vec::new();
    let mut continuation = Continuation::default();
    let mut before: Option<Content> = None;
    for piece in pieces {
        let starts_line = piece.breaks > 0 || before.is_none();
        if starts_line {
            let indentation = continuation.indentation(&piece);
            lines.push(line(&piece, indentation));
        }
        let Some(line) = lines.last_mut() else {
            continue;
        };
        continuation.pass(&piece, line.indentation);
        line.starts = line.starts.or(piece.starts);
        match &before {
            _ if starts_line => line.text.push_str(piece.content.text()),
            _ if matches!(piece.content.kind(), Some(Comment | DocComment))
                && line.comment.is_none() =>
            {
                line.comment = Some(piece.content.text().into());
            }
            Some(before) => {
                // After a comment between marks, which is an error, the line continues.
                let comment = line.comment.take();
                if let Some(comment) = &comment {
                    line.text.push_str("  ");
                    line.text.push_str(comment);
                }
                if comment.is_some() || space::between(before, &piece.content) {
                    line.text.push(' ');
                }
                line.text.push_str(piece.content.text());
            }
            None => {}
        }
        before = Some(piece.content);
    }
    lines
}

fn line(first: &Piece, indentation: usize) -> Line {
    let sort = match first.content.kind() {
        None => Sort::Verbatim,
        Some(kind) if kind.is_trivia() && first.continues => Sort::Continuation,
        Some(kind) if kind.is_trivia() => Sort::Comment,
        Some(_) if first.continues => Sort::Continuation,
        Some(ElifKeyword | ElseKeyword | EffKeyword) => Sort::Part,
        Some(_) => Sort::Other,
    };
    Line {
        indentation: if sort == Sort::Verbatim {
            0
        } else {
            indentation
        },
        text: String::new(),
        comment: None,
        comment_gap: 2,
        blank: first.breaks > 1,
        depth: first.depth,
        starts: None,
        sort,
    }
}

/// The text of the lines.
pub(super) fn write(lines: &[Line]) -> String {
    let mut text = String::new();
    for line in lines {
        if line.blank {
            text.push('\n');
        }
        text.extend(std::iter::repeat_n(' ', line.indentation));
        text.push_str(&line.text);
        if let Some(comment) = &line.comment {
            text.extend(std::iter::repeat_n(' ', line.comment_gap));
            text.push_str(comment);
        }
        text.push('\n');
    }
    text
}
