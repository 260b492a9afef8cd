//! The values of a TOML text with the position of each, without interpretation.
//!
//! The `toml` crate finds tokens and builds its own tree with spans; ours also remembers which text a value came from,
//! so that values of the command line and of a fault file can be added to the tree of the scenario, and problems are
//! reported where they were written.

use super::report::{Origin, Report};
use std::collections::BTreeMap;
use toml::de::{DeTable, DeValue};

/// A value and where it was written.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    /// Where.
    pub origin: Origin,
    /// The value.
    pub value: Value,
}

/// A value.
#[derive(Clone, Debug)]
pub(crate) enum Value {
    /// A text.
    Text(String),
    /// A whole number.
    Integer(i64),
    /// Any other number.
    Float(f64),
    /// Yes or no.
    Flag(bool),
    /// Several values.
    List(Vec<Node>),
    /// Named values.
    Table(Table),
    /// Something that no field takes: a date, or a whole number out of range; as written.
    Other(&'static str, String),
}

/// Named values, each with the place of its name.
pub(crate) type Table = BTreeMap<String, Entry>;

/// A named value.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    /// Where the name was written.
    pub name_origin: Origin,
    /// The value.
    pub node: Node,
}

impl Value {
    /// The value as a person wrote it, or what kind of thing it is.
    pub fn describe(&self) -> String {
        match self {
            Value::Text(text) => format!("{text:?}"),
            Value::Integer(number) => number.to_string(),
            Value::Float(number) if number.is_nan() => "nan".to_string(),
            Value::Float(number) => format!("{number:?}"),
            Value::Flag(flag) => flag.to_string(),
            Value::List(_) => "a list".to_string(),
            Value::Table(_) => "a table".to_string(),
            Value::Other(kind, text) => format!("the {kind} {text}"),
        }
    }
}

impl Node {
    /// An empty table.
    pub fn empty(origin: Origin) -> Node {
        Node {
            origin,
            value: Value::Table(Table::new()),
        }
    }
}

/// Parses a whole document; syntax errors go to the report.
pub(crate) fn parse_document(text: &str, start: Origin, report: &Report) -> Option<Node> {
    match DeTable::parse(text) {
        Ok(table) => Some(Node {
            origin: start,
            value: Value::Table(convert_table(table.get_ref(), start)),
        }),
        Err(error) => {
            let offset = error.span().map_or(0, |span| span.start);
            report.problem(at(start, offset), "", syntax_message(error.message()));
            None
        }
    }
}

/// Parses the value of a command-line option: TOML, or a text without quotes.
pub(crate) fn parse_value(text: &str, start: Origin) -> Node {
    let parsed = DeValue::parse(text).map(|value| convert(value.get_ref(), start));
    let digits = |c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '_');
    let value = match parsed {
        // The parser takes `1_000s` for a number.
        Ok(Value::Other("number", _)) if !text.chars().all(digits) => Value::Text(text.to_string()),
        Err(_) | Ok(Value::Other("date", _)) => Value::Text(text.to_string()),
        Ok(value) => value,
    };
    let mut node = Node {
        origin: start,
        value,
    };
    // A place inside an option's value would mean nothing to a person.
    flatten_origins(&mut node, start);
    node
}

fn flatten_origins(node: &mut Node, origin: Origin) {
    node.origin = origin;
    match &mut node.value {
        Value::List(list) => list
            .iter_mut()
            .for_each(|node| flatten_origins(node, origin)),
        Value::Table(table) => {
            for entry in table.values_mut() {
                entry.name_origin = origin;
                flatten_origins(&mut entry.node, origin);
            }
        }
        _ => {}
    }
}

fn at(start: Origin, offset: usize) -> Origin {
    Origin {
        offset: offset.try_into().unwrap_or(u32::MAX),
        ..start
    }
}

fn syntax_message(message: &str) -> String {
    format!("this is not TOML: {message}")
}

// The parser refuses texts nested more than 80 deep, so the recursion here is bounded.
fn convert_table(table: &DeTable<'_>, start: Origin) -> Table {
    let entry = |(name, value): (&toml::Spanned<_>, &toml::Spanned<_>)| {
        let name: &toml::Spanned<toml::de::DeString<'_>> = name;
        let node = node(value, start);
        let name_origin = at(start, name.span().start);
        (name.get_ref().to_string(), Entry { name_origin, node })
    };
    table.iter().map(entry).collect()
}

fn node(value: &toml::Spanned<DeValue<'_>>, start: Origin) -> Node {
    Node {
        origin: at(start, value.span().start),
        value: convert(value.get_ref(), start),
    }
}

fn convert(value: &DeValue<'_>, start: Origin) -> Value {
    match value {
        DeValue::String(text) => Value::Text(text.to_string()),
        DeValue::Integer(integer) => match i64::from_str_radix(integer.as_str(), integer.radix()) {
            Ok(number) => Value::Integer(number),
            Err(_) => Value::Other("number", integer.to_string()),
        },
        // Too large a number becomes infinite, which no field takes.
        DeValue::Float(float) => match float.as_str().parse() {
            Ok(number) => Value::Float(number),
            Err(_) => Value::Other("number", float.to_string()),
        },
        DeValue::Boolean(flag) => Value::Flag(*flag),
        DeValue::Datetime(date) => Value::Other("date", date.to_string()),
        DeValue::Array(list) => Value::List(list.iter().map(|value| node(value, start)).collect()),
        DeValue::Table(table) => Value::Table(convert_table(table, start)),
    }
}
