//! Collects the problems found while an input is read, so that all of them are reported together.

use super::problem::{Place, Problem, Problems, line_and_column};
use std::cell::RefCell;
use std::fmt::Display;

/// Where a value came from: an offset in one of the texts that are being read. Ordered as the texts
/// are read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Origin {
    /// Which text, by its number in the report.
    pub text: u32,
    /// Byte offset in the file.
    pub offset: u32,
}

/// A text that values come from.
enum Text {
    /// A file: its name and what it holds.
    File { name: String, text: String },
    /// A command-line option, such as `--set network.loss`.
    Option(String),
}

/// The texts being read and their problems.
#[derive(Default)]
pub(crate) struct Report {
    texts: RefCell<Vec<Text>>,
    problems: RefCell<Vec<(Origin, Problem)>>,
}

impl Report {
    /// Adds a file; returns the origin of its beginning.
    pub fn file(&self, name: &str, text: &str) -> Origin {
        self.add(Text::File {
            name: name.to_string(),
            text: text.to_string(),
        })
    }

    /// Adds a command-line option.
    pub fn option(&self, option: &str) -> Origin {
        self.add(Text::Option(option.to_string()))
    }

    fn add(&self, text: Text) -> Origin {
        let mut texts = self.texts.borrow_mut();
        texts.push(text);
        Origin {
            text: texts.len() as u32 - 1,
            offset: 0,
        }
    }

    /// The position of this origin for messages.
    pub fn place(&self, origin: Origin) -> Place {
        match self.texts.borrow().get(origin.text as usize) {
            Some(Text::File { name, text }) => {
                let (line, column) = line_and_column(text, origin.offset as usize);
                Place::File {
                    name: name.clone(),
                    line,
                    column,
                }
            }
            Some(Text::Option(option)) => Place::Option(option.clone()),
            None => Place::Option("command line".to_string()),
        }
    }

    /// Notes a problem.
    pub fn problem(&self, origin: Origin, field: &str, message: impl Display) {
        self.push(origin, field, message.to_string(), None);
    }

    /// Adds a problem with a suggested fix.
    pub fn problem_with_help(
        &self,
        origin: Origin,
        field: &str,
        message: impl Display,
        help: impl Display,
    ) {
        self.push(origin, field, message.to_string(), Some(help.to_string()));
    }

    /// Adds a problem that a parser has found, with its suggested fix if it has one.
    pub fn complain(&self, origin: Origin, field: &str, (message, help): (String, Option<String>)) {
        self.push(origin, field, message, help);
    }

    fn push(&self, origin: Origin, field: &str, message: String, help: Option<String>) {
        let place = self.place(origin);
        let problem = Problem {
            place,
            field: field.to_string(),
            message,
            help,
        };
        self.problems.borrow_mut().push((origin, problem));
    }

    /// How many problems there are so far.
    pub fn count(&self) -> usize {
        self.problems.borrow().len()
    }

    /// The problems in the order of the texts, or the value if there are none.
    pub fn finish<T>(self, value: T) -> Result<T, Problems> {
        let mut problems = self.problems.into_inner();
        if problems.is_empty() {
            return Ok(value);
        }
        problems.sort();
        problems.dedup();
        Err(Problems(
            problems.into_iter().map(|(_, problem)| problem).collect(),
        ))
    }
}
