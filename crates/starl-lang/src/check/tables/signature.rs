//! Signatures as text: `distance(a: Point, b: Point) -> Float`.
//!
//! `name(parameters) -> result` is called, `name: type` is used by its name alone. A parameter written `name?: type`
//! may be omitted. `...` as the last parameter means any number of values, `name = ...` for any number of named ones. A
//! capital letter is any type, the same throughout: `T` any at all, `N` Int or Float, `M` also Duration and Time, `O`
//! whatever `<` compares, `F` Float or RobotId. `Message` is any message, `Model` a literal text with the path of a model's file, `Any` any
//! value. `List[T].add(x: T)` is a method of lists.

use alloc::boxed::Box;
use alloc::vec::Vec;

/// A signature that was read from its text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Signature {
    /// The receiver's type, for a method.
    pub receiver: Option<Shape>,
    /// Its name.
    pub name: &'static str,
    /// Whether it is called, rather than used by its name alone.
    pub is_call: bool,
    /// Its parameters.
    pub parameters: Vec<Parameter>,
    /// Whether any number of values may follow.
    pub takes_values: bool,
    /// Whether any number of named values may follow.
    pub takes_fields: bool,
    /// The type of the result.
    pub result: Shape,
}

/// A parameter of a signature.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parameter {
    /// Its name.
    pub name: &'static str,
    /// Its type.
    pub shape: Shape,
    /// Whether it may be left out.
    pub is_optional: bool,
}

/// A type in a signature, which may contain letters for other types.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Shape {
    /// No value.
    Nothing,
    /// Any value.
    Any,
    /// Any message.
    Message,
    /// The path of a model's file, a String.
    Model,
    /// Any type that the letter allows, the same wherever the letter stands.
    Letter(u8),
    /// A type by its name.
    Named(&'static str),
    /// `List[T]`
    List(Box<Self>),
    /// `Set[T]`
    Set(Box<Self>),
    /// `Map[K, V]`
    Map(Box<Self>, Box<Self>),
    /// `T?`
    Optional(Box<Self>),
}

impl Signature {
    /// Reads a signature of the tables.
    ///
    /// # Panics
    /// The text is not a signature.
    #[must_use]
    pub fn read(text: &'static str) -> Self {
        let mut reader = Reader { text, at: 0 };
        let mut signature = Self {
            receiver: None,
            name: "",
            is_call: false,
            parameters: Vec::new(),
            takes_values: false,
            takes_fields: false,
            result: Shape::Nothing,
        };
        if text
            .split('(')
            .next()
            .is_some_and(|head| head.contains('.'))
        {
            signature.receiver = Some(reader.shape());
            reader.expect(".");
        }
        signature.name = reader.word();
        signature.is_call = reader.eat("(");
        if signature.is_call {
            while !reader.eat(")") {
                reader.parameter(&mut signature);
                reader.eat(",");
            }
        }
        if reader.eat(if signature.is_call { "->" } else { ":" }) {
            signature.result = reader.shape();
        }
        assert!(reader.rest().is_empty(), "text after a signature: {text}");
        signature
    }

    /// The name in a signature without a receiver.
    #[must_use]
    pub fn name_of(text: &'static str) -> &'static str {
        let end = text.find(['(', ':']).unwrap_or(text.len());
        &text[..end]
    }
}

struct Reader {
    text: &'static str,
    at: usize,
}

impl Reader {
    fn rest(&mut self) -> &'static str {
        let text = self.text;
        let rest = &text[self.at..];
        self.at += rest.len() - rest.trim_start().len();
        &text[self.at..]
    }

    fn eat(&mut self, token: &str) -> bool {
        let found = self.rest().starts_with(token);
        if found {
            self.at += token.len();
        }
        found
    }

    fn expect(&mut self, token: &str) {
        assert!(self.eat(token), "{token} is missing in {}", self.text);
    }

    fn word(&mut self) -> &'static str {
        let rest = self.rest();
        let is_part = |character: char| character == '_' || character.is_ascii_alphanumeric();
        let end = rest.find(|character| !is_part(character));
        let word = &rest[..end.unwrap_or(rest.len())];
        assert!(!word.is_empty(), "a word is missing in {}", self.text);
        self.at += word.len();
        word
    }

    fn parameter(&mut self, signature: &mut Signature) {
        if self.eat("...") {
            signature.takes_values = true;
            return;
        }
        let name = self.word();
        if self.eat("=") {
            self.expect("...");
            signature.takes_fields = true;
            return;
        }
        let is_optional = self.eat("?");
        self.expect(":");
        let shape = self.shape();
        signature.parameters.push(Parameter {
            name,
            shape,
            is_optional,
        });
    }

    fn shape(&mut self) -> Shape {
        let word = self.word();
        let mut parts = Vec::new();
        if self.eat("[") {
            while !self.eat("]") {
                parts.push(Box::new(self.shape()));
                self.eat(",");
            }
        }
        let mut parts = parts.into_iter();
        let shape = match (word, parts.next(), parts.next()) {
            ("List", Some(part), None) => Shape::List(part),
            ("Set", Some(part), None) => Shape::Set(part),
            ("Map", Some(key), Some(value)) => Shape::Map(key, value),
            ("Any", ..) => Shape::Any,
            ("Message", ..) => Shape::Message,
            ("Model", ..) => Shape::Model,
            _ if word.len() == 1 => Shape::Letter(word.as_bytes()[0]),
            _ => Shape::Named(word),
        };
        if self.eat("?") {
            Shape::Optional(Box::new(shape))
        } else {
            shape
        }
    }
}
