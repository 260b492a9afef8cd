//! The inputs of a scenario, as plain data that a trace can contain.

use crate::fields::{Place, Problem};
use serde::{Deserialize, Serialize};
use starl_core::FileError;
use std::cell::RefCell;
use std::collections::BTreeMap;

/// A text with the name that errors call it by.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Source {
    /// The file's name.
    pub name: String,
    /// Its content.
    pub text: String,
}

/// A field set on the command line.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Override {
    /// The option as errors name it: `--set network.loss`, `--seed`.
    pub option: String,
    /// The field's dotted path; elements of lists by their index from 0.
    pub path: String,
    /// The value, as in the file; a text needs no quotes.
    pub value: String,
}

/// The inputs to read.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Request {
    /// The scenario file.
    pub source: Source,
    /// Fields to set, in this order.
    pub overrides: Vec<Override>,
    /// Another fleet: `create=2,drone=2`, models with how many of each.
    pub robots: Option<String>,
    /// Faults to add: a text with `[[fault]]` and `[fault_rates]` as in a scenario.
    pub faults: Option<Source>,
}

/// All inputs of a scenario.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Inputs {
    /// The request.
    pub request: Request,
    /// The files it named, by path.
    pub files: BTreeMap<String, Content>,
}

/// The content of a file; as text if it is text, so that people can read it in a trace.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Content {
    /// UTF-8.
    Text(String),
    /// Two hexadecimal digits a byte.
    Hex(String),
}

/// Brings the files that a scenario names.
pub trait Loader {
    /// The content of the file at this path, relative to the scenario's own.
    ///
    /// # Errors
    /// Why it cannot be read.
    fn load(&self, path: &str) -> Result<Vec<u8>, FileError>;
}

impl Source {
    /// A text called `name`.
    pub fn new(name: impl Into<String>, text: impl Into<String>) -> Source {
        Source {
            name: name.into(),
            text: text.into(),
        }
    }
}

impl Override {
    /// The argument of `--set`: `network.loss=0.2`.
    ///
    /// # Errors
    /// If there is no `=` in it.
    pub fn set(assignment: &str) -> Result<Override, Problem> {
        match assignment.split_once('=') {
            Some((path, value)) => {
                let (path, value) = (path.trim(), value.trim());
                Ok(Override::named(&format!("--set {path}"), path, value))
            }
            None => Err(Problem {
                place: Place::Option(format!("--set {assignment}")),
                field: String::new(),
                message: "there is no value".to_string(),
                help: Some("write it like --set network.loss=0.2".to_string()),
            }),
        }
    }

    /// An option of its own that sets the field at `path`, such as `--seed`.
    pub fn named(option: &str, path: &str, value: &str) -> Override {
        Override {
            option: option.to_string(),
            path: path.to_string(),
            value: value.to_string(),
        }
    }
}

impl Request {
    /// A scenario as it is.
    pub fn new(source: Source) -> Request {
        Request {
            source,
            overrides: Vec::new(),
            robots: None,
            faults: None,
        }
    }
}

impl Content {
    pub(super) fn of(bytes: &[u8]) -> Content {
        match std::str::from_utf8(bytes) {
            Ok(text) => Content::Text(text.to_string()),
            Err(_) => Content::Hex(bytes.iter().map(|byte| format!("{byte:02x}")).collect()),
        }
    }

    fn bytes(&self) -> Result<Vec<u8>, FileError> {
        match self {
            Content::Text(text) => Ok(text.as_bytes().to_vec()),
            Content::Hex(text) => {
                let digit = |c: u8| char::from(c).to_digit(16).map(|digit| digit as u8);
                let byte = |pair: &[u8]| match pair {
                    &[high, low] => Some(digit(high)? << 4 | digit(low)?),
                    _ => None,
                };
                let bytes: Option<Vec<u8>> = text.as_bytes().chunks(2).map(byte).collect();
                bytes.ok_or_else(|| FileError::Unreadable("its recorded content is damaged".into()))
            }
        }
    }
}

impl Loader for Inputs {
    fn load(&self, path: &str) -> Result<Vec<u8>, FileError> {
        match self.files.get(path) {
            Some(content) => content.bytes(),
            None => Err(FileError::Unreadable("it was not recorded".into())),
        }
    }
}

/// Remembers what a loader brought.
pub(super) struct Recorder<'a> {
    loader: &'a dyn Loader,
    files: RefCell<BTreeMap<String, Content>>,
}

impl<'a> Recorder<'a> {
    pub fn new(loader: &'a dyn Loader) -> Recorder<'a> {
        Recorder {
            loader,
            files: RefCell::default(),
        }
    }

    pub fn load(&self, path: &str) -> Result<Vec<u8>, FileError> {
        let bytes = self.loader.load(path)?;
        self.files
            .borrow_mut()
            .insert(path.to_string(), Content::of(&bytes));
        Ok(bytes)
    }

    pub fn brought(self) -> BTreeMap<String, Content> {
        self.files.into_inner()
    }
}
