//! Blocks by indentation: the levels that are open, and where each begins and ends.

use alloc::format;
use alloc::vec::Vec;

use super::super::SyntaxKind::*;
use super::super::lexer::Tokens;
use super::{Lexeme, Line};
use crate::diagnostic::{Code, Diagnostic, Edit, Span};

/// A tab goes to the next multiple of this many columns.
const TAB: u32 = 4;

/// How many columns the white space takes that starts at `column`.
pub(super) fn width(space: &str, column: u32) -> u32 {
    let end = space.bytes().fold(column, |at, byte| match byte {
        b'\t' => (at / TAB + 1) * TAB,
        b' ' => at + 1,
        // A byte order mark or a carriage return.
        _ => at,
    });
    end - column
}

/// Opens and closes blocks before a line, by its indentation.
pub(super) fn place(
    text: &str,
    tokens: &Tokens,
    line: &Line,
    levels: &mut Vec<u32>,
    lexemes: &mut Vec<Lexeme>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    // Trivia between the line before and this one; a block that opens holds all of it.
    let gap = lexemes.last().map_or(0, after);
    let top = levels.last().copied().unwrap_or(0);
    if line.column > top {
        levels.push(line.column);
        lexemes.push(Lexeme {
            kind: Indent,
            index: gap as u32,
        });
        return;
    }
    let column = nearest(line.column, levels);
    if column != line.column {
        diagnostics.push(uneven(text, tokens, line, column));
    }
    while levels.last().is_some_and(|level| *level > column) {
        let level = levels.pop().unwrap_or(0);
        let index = end_of_block(text, tokens, gap, line.first, level) as u32;
        lexemes.push(Lexeme {
            kind: Dedent,
            index,
        });
    }
}

/// Closes the blocks that are open at the end of the text.
pub(super) fn close(text: &str, tokens: &Tokens, mut levels: Vec<u32>, lexemes: &mut Vec<Lexeme>) {
    let gap = lexemes.last().map_or(0, after);
    while levels.len() > 1 {
        let level = levels.pop().unwrap_or(0);
        let index = end_of_block(text, tokens, gap, tokens.len(), level) as u32;
        lexemes.push(Lexeme {
            kind: Dedent,
            index,
        });
    }
}

/// The open level next to the column; of two the deeper.
fn nearest(column: u32, levels: &[u32]) -> u32 {
    let distance = |level: &u32| (level.abs_diff(column), u32::MAX - *level);
    levels.iter().copied().min_by_key(distance).unwrap_or(0)
}

/// The token after what the parser saw.
fn after(lexeme: &Lexeme) -> usize {
    lexeme.index as usize + usize::from(!matches!(lexeme.kind, Indent | Dedent))
}

/// Where a block ends: before the first comment between `from` and `to` that is indented less than it.
fn end_of_block(text: &str, tokens: &Tokens, from: usize, to: usize, level: u32) -> usize {
    // Tokens on the last line of the block belong to it.
    let starts_line = from == 0 || tokens.kind(from - 1) == Newline;
    let (mut end, mut column, mut inside) = (from, 0, !starts_line);
    for index in from..to {
        match tokens.kind(index) {
            Newline => {
                if inside {
                    end = index + 1;
                }
                (column, inside) = (0, false);
            }
            Whitespace => column += width(tokens.span(index).of(text), column),
            _ if inside || column >= level => inside = true,
            _ => return end,
        }
    }
    if inside { to } else { end }
}

fn uneven(text: &str, tokens: &Tokens, line: &Line, column: u32) -> Diagnostic {
    let first = tokens.span(line.first);
    let start = text[..first.start as usize]
        .rfind('\n')
        .map_or(0, |at| at + 1) as u32;
    let span = Span::new(start, first.start);
    Diagnostic::new(
        Code::UnevenIndentation,
        span,
        "this indentation matches no line above",
    )
    .expected(format!("{column} spaces, as in the block that is nearest"))
    .found(format!("{}", line.column))
    .replace(
        format!("indent it by {column} spaces"),
        span,
        " ".repeat(column as usize),
    )
}

/// Reports the tabs in indentations: once, with a fix for all.
pub(super) fn report_tabs(text: &str, tokens: &Tokens, diagnostics: &mut Vec<Diagnostic>) {
    let mut edits = Vec::new();
    let mut line_starts = true;
    for (index, kind) in tokens.kinds().iter().enumerate() {
        let span = tokens.span(index);
        if line_starts && *kind == Whitespace && span.of(text).contains('\t') {
            let spaces = width(span.of(text), 0) as usize;
            edits.push(Edit::new(span, " ".repeat(spaces)));
        }
        line_starts = *kind == Newline;
    }
    let Some(first) = edits.first() else { return };
    let message = match edits.len() {
        1 => "this line is indented with a tab".into(),
        count => format!("{count} lines are indented with tabs; this is the first"),
    };
    let problem = Diagnostic::new(Code::TabIndentation, first.span, message);
    diagnostics.push(problem.edits("indent with 4 spaces for each tab", edits));
}
