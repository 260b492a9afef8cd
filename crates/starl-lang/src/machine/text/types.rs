//! Types in the machine's text form: `Int`, `enum0`, `type2`, `Point?`, `{x: Int, y: Point}`.

use crate::machine::types::{ObjectType, Type};
use alloc::boxed::Box;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

const PLAIN: [(&str, Type); 7] = [
    ("Bool", Type::Bool),
    ("Int", Type::Int),
    ("Float", Type::Float),
    ("Time", Type::Time),
    ("Duration", Type::Duration),
    ("Robot", Type::Robot),
    ("Point", Type::Point),
];

/// How deeply records may be written within one another.
const DEEPEST: u32 = 32;

impl fmt::Display for Type {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Type::Enum(index) => write!(f, "enum{index}"),
            Type::Object(index) => write!(f, "type{index}"),
            Type::Optional(value) => write!(f, "{value}?"),
            Type::Record(fields) => {
                f.write_str("{")?;
                for (index, (name, kind)) in fields.iter().enumerate() {
                    let comma = if index == 0 { "" } else { ", " };
                    write!(f, "{comma}{name}: {kind}")?;
                }
                f.write_str("}")
            }
            plain => {
                let name = PLAIN.iter().find(|(_, kind)| kind == plain);
                f.write_str(name.map_or("", |(name, _)| name))
            }
        }
    }
}

impl fmt::Display for ObjectType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ObjectType::Text => f.write_str("Text"),
            ObjectType::Area => f.write_str("Area"),
            ObjectType::Obstacles => f.write_str("Obstacles"),
            ObjectType::List(element) => write!(f, "List[{element}]"),
            ObjectType::Set(element) => write!(f, "Set[{element}]"),
            ObjectType::Map(key, value) => write!(f, "Map[{key}, {value}]"),
        }
    }
}

/// A place in a line of text.
pub(in crate::machine) struct Cursor<'a> {
    rest: &'a str,
}

impl<'a> Cursor<'a> {
    pub fn new(text: &'a str) -> Cursor<'a> {
        Cursor { rest: text.trim() }
    }

    /// The unread rest.
    pub fn rest(&self) -> &'a str {
        self.rest
    }

    /// Reads this piece of text if it is next.
    pub fn eat(&mut self, text: &str) -> bool {
        match self.rest.strip_prefix(text) {
            Some(rest) => {
                self.rest = rest.trim_start();
                true
            }
            None => false,
        }
    }

    /// Reads up to the next space.
    pub fn word(&mut self) -> Option<&'a str> {
        let end = self
            .rest
            .find(char::is_whitespace)
            .unwrap_or(self.rest.len());
        self.take(end)
    }

    /// Reads letters, digits and underscores.
    fn name(&mut self) -> Option<&'a str> {
        let other = |c: char| !c.is_alphanumeric() && c != '_';
        self.take(self.rest.find(other).unwrap_or(self.rest.len()))
    }

    fn take(&mut self, end: usize) -> Option<&'a str> {
        let (taken, rest) = self.rest.split_at(end);
        self.rest = rest.trim_start();
        (!taken.is_empty()).then_some(taken)
    }

    /// Reads a number with a word before it: `type3`.
    pub fn numbered<T: core::str::FromStr>(&mut self, prefix: &str) -> Option<T> {
        self.word()?.strip_prefix(prefix)?.parse().ok()
    }

    /// Reads types between parentheses.
    pub fn types(&mut self) -> Option<Vec<Type>> {
        let mut types = Vec::new();
        if !self.eat("(") {
            return None;
        }
        while !self.eat(")") {
            if !types.is_empty() && !self.eat(",") {
                return None;
            }
            types.push(self.kind(0)?);
        }
        Some(types)
    }

    /// Reads a type.
    pub fn kind(&mut self, depth: u32) -> Option<Type> {
        if depth > DEEPEST {
            return None;
        }
        let mut kind = if self.eat("{") {
            let mut fields = Vec::new();
            while !self.eat("}") {
                if !fields.is_empty() && !self.eat(",") {
                    return None;
                }
                let name = String::from(self.name()?);
                if !self.eat(":") {
                    return None;
                }
                fields.push((name, self.kind(depth + 1)?));
            }
            Type::Record(fields)
        } else {
            plain(self.name()?)?
        };
        let mut marks = 0;
        while self.eat("?") {
            marks += 1;
            if marks > DEEPEST {
                return None;
            }
            kind = Type::Optional(Box::new(kind));
        }
        Some(kind)
    }

    /// Reads an object type.
    pub fn object(&mut self) -> Option<ObjectType> {
        let object = match self.name()? {
            "Text" => return Some(ObjectType::Text),
            "Area" => return Some(ObjectType::Area),
            "Obstacles" => return Some(ObjectType::Obstacles),
            "List" => ObjectType::List(self.bracketed()?),
            "Set" => ObjectType::Set(self.bracketed()?),
            "Map" => {
                let key = self.bracketed()?;
                let value = self.eat(",").then(|| self.kind(0))??;
                ObjectType::Map(key, value)
            }
            _ => return None,
        };
        self.eat("]").then_some(object)
    }

    fn bracketed(&mut self) -> Option<Type> {
        self.eat("[").then(|| self.kind(0))?
    }
}

fn plain(name: &str) -> Option<Type> {
    if let Some((_, kind)) = PLAIN.iter().find(|(plain, _)| *plain == name) {
        return Some(kind.clone());
    }
    if let Some(index) = name.strip_prefix("enum") {
        return index.parse().ok().map(Type::Enum);
    }
    name.strip_prefix("type")?.parse().ok().map(Type::Object)
}
