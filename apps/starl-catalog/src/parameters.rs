//! Reads the parameters that a scenario gives to a program: each has a name and a kind, and those
//! that no program asks for are reported, not ignored.

use starl_core::Duration;
use starl_sim::engine::Complaint;
use starl_sim::scenario::Parameter;
use std::collections::BTreeMap;

/// The parameters given to one program, taken one by one.
pub struct Parameters<'a> {
    given: &'a BTreeMap<String, Parameter>,
    known: Vec<&'static str>,
    complaint: Option<Complaint>,
}

impl<'a> Parameters<'a> {
    /// The parameters of a group of robots.
    pub(crate) fn new(given: &'a BTreeMap<String, Parameter>) -> Parameters<'a> {
        Parameters {
            given,
            known: Vec::new(),
            complaint: None,
        }
    }

    /// The value built from the parameters, if all of them are known and valid.
    pub(crate) fn finish<T>(self, built: T) -> Result<T, Complaint> {
        let unknown = self
            .given
            .keys()
            .find(|name| !self.known.contains(&name.as_str()));
        if let Some(name) = unknown {
            let help = match self.known.is_empty() {
                true => "it takes none".to_string(),
                false => format!("it takes {}", self.known.join(", ")),
            };
            return Err(complaint(name, "the program has no such parameter", help));
        }
        match self.complaint {
            Some(complaint) => Err(complaint),
            None => Ok(built),
        }
    }

    /// A positive length in metres.
    pub fn length(&mut self, name: &'static str, default: f64) -> f64 {
        self.read(
            name,
            default,
            "a length above zero, such as \"75mm\"",
            |value| match *value {
                Parameter::Float(number) if number.is_finite() && number > 0.0 => Some(number),
                Parameter::Int(number) if number > 0 => Some(number as f64),
                _ => None,
            },
        )
    }

    /// A span of time above zero.
    pub fn duration(&mut self, name: &'static str, default: Duration) -> Duration {
        self.read(
            name,
            default,
            "a time above zero, such as \"250ms\"",
            |value| match *value {
                Parameter::Duration(span) if !span.is_zero() => Some(span),
                _ => None,
            },
        )
    }

    /// A whole number from 0.
    pub fn count(&mut self, name: &'static str, default: u32) -> u32 {
        self.read(
            name,
            default,
            "a whole number from 0",
            |value| match *value {
                Parameter::Int(number) => u32::try_from(number).ok(),
                _ => None,
            },
        )
    }

    /// A number from 0 to 1.
    pub fn fraction(&mut self, name: &'static str, default: f64) -> f64 {
        self.read(
            name,
            default,
            "a number from 0 to 1",
            |value| match *value {
                Parameter::Float(number) if (0.0..=1.0).contains(&number) => Some(number),
                Parameter::Int(number @ 0..=1) => Some(number as f64),
                _ => None,
            },
        )
    }

    /// Any number.
    pub fn number(&mut self, name: &'static str, default: f64) -> f64 {
        self.read(name, default, "a number", |value| match *value {
            Parameter::Float(number) if number.is_finite() => Some(number),
            Parameter::Int(number) => Some(number as f64),
            _ => None,
        })
    }

    /// Yes or no.
    pub fn flag(&mut self, name: &'static str, default: bool) -> bool {
        self.read(name, default, "true or false", |value| match *value {
            Parameter::Bool(flag) => Some(flag),
            _ => None,
        })
    }

    /// One of several words, each with its value.
    pub fn choice<T: Copy>(
        &mut self,
        name: &'static str,
        default: T,
        choices: &[(&'static str, T)],
    ) -> T {
        let words: Vec<&str> = choices.iter().map(|choice| choice.0).collect();
        let expected = format!("one of {}", words.join(", "));
        self.read(name, default, &expected, |value| match value {
            Parameter::Text(text) => choices
                .iter()
                .find(|choice| choice.0 == text)
                .map(|choice| choice.1),
            _ => None,
        })
    }

    fn read<T>(
        &mut self,
        name: &'static str,
        default: T,
        expected: &str,
        read: impl FnOnce(&Parameter) -> Option<T>,
    ) -> T {
        self.known.push(name);
        let Some(value) = self.given.get(name) else {
            return default;
        };
        read(value).unwrap_or_else(|| {
            let message = format!("{} does not fit", describe(value));
            let help = format!("give {expected}");
            self.complaint
                .get_or_insert(complaint(name, &message, help));
            default
        })
    }
}

pub(crate) fn complaint(name: &str, message: &str, help: String) -> Complaint {
    Complaint {
        field: format!("parameters.{name}"),
        message: message.to_string(),
        help,
    }
}

pub(crate) fn describe(value: &Parameter) -> String {
    match value {
        Parameter::Bool(flag) => flag.to_string(),
        Parameter::Int(number) => number.to_string(),
        Parameter::Float(number) => number.to_string(),
        Parameter::Text(text) => format!("{text:?}"),
        Parameter::Duration(span) => format!("\"{span}\""),
        Parameter::List(list) => format!("a list of {}", list.len()),
    }
}
