//! A problem of an input, with its place and a suggested fix.
//!
//! Invariant: every problem names a place a person can go to: a file with line and column, or a
//! command-line option.

use serde::{Deserialize, Serialize};
use std::fmt;

/// Where a value was written.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Place {
    /// In a file.
    File {
        /// Its name, as it was given.
        name: String,
        /// Counted from 1.
        line: u32,
        /// In characters, counted from 1.
        column: u32,
    },
    /// On the command line: `--set network.loss`.
    Option(String),
}

/// One thing that is wrong with an input.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Problem {
    /// Where.
    pub place: Place,
    /// The field, as a dotted path such as `robots.0.count`; empty if the text is not a field, as in a world file.
    pub field: String,
    /// The problem.
    pub message: String,
    /// The suggested fix.
    pub help: Option<String>,
}

/// All problems of an input, at least one, in the order of the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problems(pub Vec<Problem>);

/// A text on one line: characters that would change what a terminal does are escaped.
#[derive(Clone, Copy, Debug)]
pub struct OneLine<'a>(pub &'a str);

impl fmt::Display for OneLine<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for part in self.0.split_inclusive(char::is_control) {
            let shown = part.trim_end_matches(char::is_control);
            write!(f, "{shown}{}", part[shown.len()..].escape_debug())?;
        }
        Ok(())
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::File { name, line, column } => {
                write!(f, "{}:{line}:{column}", OneLine(name))
            }
            Place::Option(option) => write!(f, "{}", OneLine(option)),
        }
    }
}

impl fmt::Display for Problem {
    /// On one line: `race.toml:14:8: network.loss: 1.5 is not a probability; give a number from 0
    /// to 1`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.place)?;
        let named_already = match &self.place {
            Place::Option(option) => option.ends_with(&self.field),
            Place::File { .. } => self.field.is_empty(),
        };
        if !named_already {
            write!(f, "{}: ", OneLine(&self.field))?;
        }
        write!(f, "{}", OneLine(&self.message))?;
        match &self.help {
            Some(help) => write!(f, "; {}", OneLine(help)),
            None => Ok(()),
        }
    }
}

impl fmt::Display for Problems {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, problem) in self.0.iter().enumerate() {
            if index > 0 {
                writeln!(f)?;
            }
            write!(f, "{problem}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Problem {}

impl std::error::Error for Problems {}

impl From<Problem> for Problems {
    fn from(problem: Problem) -> Problems {
        Problems(vec![problem])
    }
}

/// Line and column, both from 1, of a byte offset in a text; offsets beyond the end count as the end.
pub(crate) fn line_and_column(text: &str, offset: usize) -> (u32, u32) {
    let mut end = offset.min(text.len());
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    let before = &text[..end];
    let start_of_line = before.rfind('\n').map_or(0, |at| at + 1);
    let line = 1 + before.matches('\n').count();
    let column = 1 + before[start_of_line..].chars().count();
    (line as u32, column as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_problem_is_on_one_line_and_leaves_the_terminal_as_it_is() {
        let problem = Problem {
            place: Place::File {
                name: "a\u{1b}[31m\nb.wpt".into(),
                line: 1,
                column: 2,
            },
            field: String::new(),
            message: "there is no file \u{9b}A \u{e4}".into(),
            help: Some("it's \"c\td\"".into()),
        };
        let shown = "a\\u{1b}[31m\\nb.wpt:1:2: there is no file \\u{9b}A \u{e4}; it's \"c\\td\"";
        assert_eq!(problem.to_string(), shown);
    }
}
