//! The same program in another layout: other indentation, spaces, line breaks and empty lines, and with
//! comments in all places.

use super::Choices;
use starl_lang::syntax::{SyntaxKind, parse};

/// Operators at whose end a line may continue in the next one.
const OPERATORS: &[&str] = &[
    "+", "*", "/", "%", "==", "!=", "<", "<=", ">", ">=", "and", "or", "??", ",",
];

/// The program that these bytes made, with white space and line breaks that the bytes determine.
pub fn other(text: &str, bytes: &[u8]) -> String {
    let mut choices = Choices::new(bytes);
    // Other choices than those that made the beginning of the program.
    for _ in 0..bytes.len() / 3 {
        choices.below(2);
    }
    let mut layout = Layout {
        choices: &mut choices,
        text: String::new(),
        columns: vec![0],
        column: 0,
        depth: 0,
    };
    let ends = ["\n", "\r\n"][layout.choices.below(8) / 7];
    let parsed = parse(text);
    let tokens = parsed
        .syntax()
        .descendants_with_tokens()
        .filter_map(|one| one.into_token());
    let mut starts_line = true;
    let mut last = String::new();
    for token in tokens {
        let word = token.text();
        if starts_line {
            let spaces = if token.kind() == SyntaxKind::Whitespace {
                word.len()
            } else {
                0
            };
            layout.indent(spaces / 4);
        }
        match token.kind() {
            SyntaxKind::Newline | SyntaxKind::LineBreak => layout.end_line(),
            SyntaxKind::Whitespace if starts_line => {}
            SyntaxKind::Whitespace => layout.space(&last),
            _ => {
                layout.word(word);
                last = word.to_string();
            }
        }
        starts_line = matches!(token.kind(), SyntaxKind::Newline | SyntaxKind::LineBreak);
    }
    layout.text.replace('\n', ends)
}

struct Layout<'a, 'b> {
    choices: &'a mut Choices<'b>,
    text: String,
    /// The columns of the blocks that are open.
    columns: Vec<usize>,
    /// The column of the line.
    column: usize,
    /// How many brackets are open.
    depth: usize,
}

impl Layout<'_, '_> {
    fn indent(&mut self, level: usize) {
        while self.columns.len() <= level {
            let deeper = 1 + (self.choices.below(6) + 3) % 6;
            self.columns
                .push(self.columns.last().copied().unwrap_or(0) + deeper);
        }
        self.columns.truncate(level + 1);
        self.column = self.columns[level];
        self.text += &" ".repeat(self.column);
    }

    fn word(&mut self, word: &str) {
        if matches!(word, ")" | "]" | "}") {
            self.depth = self.depth.saturating_sub(1);
            self.loosen(16);
        }
        self.text += word;
        if matches!(word, "(" | "[" | "{") {
            self.depth += 1;
            self.loosen(16);
        }
    }

    /// Perhaps some space in brackets, where none has to be.
    fn loosen(&mut self, times: usize) {
        match self.choices.below(times) {
            13 => self.text.push(' '),
            14 => self.line_break(0),
            15 => {
                self.text += " // within";
                self.line_break(0);
            }
            _ => {}
        }
    }

    /// Continues in a new line, indented at least this far.
    fn line_break(&mut self, least: usize) {
        let column = least + self.choices.below(12);
        self.text.push('\n');
        self.text += &" ".repeat(column);
    }

    /// The space between two words.
    fn space(&mut self, last: &str) {
        let goes_on = self.depth > 0 || OPERATORS.contains(&last);
        let least = if self.depth > 0 { 0 } else { self.column + 1 };
        match self.choices.below(24) {
            20 => self.text += "   ",
            21 | 22 if goes_on => self.line_break(least),
            23 if goes_on => {
                self.text += "  // goes on";
                self.line_break(least);
            }
            _ => self.text.push(' '),
        }
    }

    fn end_line(&mut self) {
        match self.choices.below(16) {
            12 => self.text += "  ",
            13 | 14 => self.text += " // said",
            15 => self.text += "//",
            _ => {}
        }
        self.text.push('\n');
        match self.choices.below(16) {
            13 => self.text += "\n\n\n",
            14 => {
                let column = self.choices.below(10);
                self.text += &format!("{}// apart\n", " ".repeat(column));
            }
            15 => {
                let column = self.column;
                self.text += &format!("\n{}// here, \"too\"\n", " ".repeat(column));
            }
            _ => {}
        }
    }
}
