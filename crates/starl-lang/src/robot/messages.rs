//! The encoding of messages: a tag that identifies the message, then its fields.
//!
//! The tag is a hash of the message's name and of the types of its fields, so that robots whose programs declare the
//! same message can exchange it, whatever else their programs contain. Bytes are untrusted: anything except a message
//! of the program is ignored.

use super::shape::Declared;
use crate::machine::{Bytecode, Layout, Object, ObjectType, Origin, Program, Type};
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt::{self, Write};
use starl_core::{Digest, Payload};

/// Bytes of a tag.
const TAG: usize = 4;

/// A message that the program sends.
#[derive(Clone, Debug)]
pub struct Outgoing {
    tag: u32,
    kind: Type,
    layout: Layout,
}

impl Outgoing {
    /// The message with this name and record type.
    pub fn new(declared: &Declared, name: &str, kind: &Type) -> Outgoing {
        let fields: Vec<&Type> = match kind {
            Type::Record(fields) => fields.iter().map(|(_, field)| field).collect(),
            _ => Vec::new(),
        };
        Outgoing {
            tag: tag(declared, name, &fields),
            kind: kind.clone(),
            layout: Layout::of([kind]),
        }
    }

    /// How many scalars and objects its fields take.
    pub fn width(&self) -> (usize, usize) {
        (self.layout.scalars.len(), self.layout.objects.len())
    }

    /// The message as bytes; none if these are not its fields.
    pub fn encode(
        &self,
        program: &Program,
        scalars: &[u64],
        objects: &[Object],
    ) -> Option<Payload> {
        let fields = program.encode(core::slice::from_ref(&self.kind), scalars, objects)?;
        let mut payload = Payload::from_slice(&self.tag.to_le_bytes());
        payload.extend_from_slice(&fields);
        Some(payload)
    }
}

/// A message that the program handles.
#[derive(Clone, Debug)]
struct Incoming {
    tag: u32,
    fields: Vec<Type>,
    /// Its handlers, in the order of the text.
    handlers: Vec<u32>,
}

/// The messages that a program handles.
#[derive(Clone, Debug, Default)]
pub struct Inbox(Vec<Incoming>);

/// A message or an order that arrived.
pub struct Arrival<'a> {
    /// Its handlers.
    pub handlers: &'a [u32],
    /// The scalars of its fields.
    pub scalars: Vec<u64>,
    /// The objects of its fields.
    pub objects: Vec<Object>,
}

impl Inbox {
    /// Those of a program; none if a handler does not begin with the sender.
    pub fn of(bytecode: &Bytecode, declared: &Declared) -> Option<Inbox> {
        let mut inbox = Inbox::default();
        for (index, handler) in bytecode.handlers.iter().enumerate() {
            if handler.origin != Origin::Message {
                continue;
            }
            let function = bytecode.functions.get(handler.function as usize)?;
            let (Type::Robot, fields) = function.arguments.split_first()? else {
                return None;
            };
            let tag = tag(declared, &handler.event, &fields.iter().collect::<Vec<_>>());
            let known = inbox.0.iter_mut().find(|known| known.tag == tag);
            match known {
                Some(known) if known.fields == fields => known.handlers.push(index as u32),
                Some(_) => return None, // one tag for two messages
                None => inbox.0.push(Incoming {
                    tag,
                    fields: fields.into(),
                    handlers: Vec::from([index as u32]),
                }),
            }
        }
        Some(inbox)
    }

    /// The handlers of the message at the end of these bytes; none if there is no message of the program. A primitive's
    /// message ends with the program's message.
    pub fn at_end_of(&self, program: &Program, bytes: &[u8]) -> Option<&[u32]> {
        let mut ends = (0..bytes.len()).filter_map(|start| bytes.get(start..));
        ends.find_map(|end| Some(self.decode(program, end)?.handlers))
    }

    /// Decodes a message; none if the bytes are not a message of the program.
    pub fn decode(&self, program: &Program, bytes: &[u8]) -> Option<Arrival<'_>> {
        let (tag, fields) = bytes.split_first_chunk::<TAG>()?;
        let tag = u32::from_le_bytes(*tag);
        let incoming = self.0.iter().find(|incoming| incoming.tag == tag)?;
        let (scalars, objects) = program.decode(&incoming.fields, fields)?;
        Some(Arrival {
            handlers: &incoming.handlers,
            scalars,
            objects,
        })
    }
}

/// The tag of something that has a name and values of these types, such as a message.
pub(super) fn tag(types: &Declared, name: &str, fields: &[&Type]) -> u32 {
    let mut text = String::from(name);
    for field in fields {
        // Writing to a string does not fail.
        let _ = text
            .write_char(' ')
            .and_then(|()| spell(&mut text, types, field));
    }
    let mut digest = Digest::default();
    digest.bytes(text.as_bytes());
    let value = digest.value();
    (value ^ (value >> 32)) as u32
}

/// A type is written as far as this, bytes: one that is made of others over and over could be written
/// without end.
const LONGEST: usize = 1 << 16;

/// Writes a type without the program's own numbers and names of types.
fn spell(out: &mut String, types: &Declared, kind: &Type) -> fmt::Result {
    if out.len() > LONGEST {
        return Ok(());
    }
    match kind {
        Type::Enum(index) => write!(out, "{{{}}}", types.variants(*index).join(" ")),
        Type::Optional(value) => {
            spell(out, types, value)?;
            out.write_char('?')
        }
        Type::Record(fields) => {
            out.write_char('(')?;
            for (name, field) in fields {
                write!(out, "{name}:")?;
                spell(out, types, field)?;
            }
            out.write_char(')')
        }
        Type::Object(index) => match types.object(*index) {
            Some(ObjectType::List(element)) => {
                out.write_str("List ")?;
                spell(out, types, element)
            }
            Some(ObjectType::Set(element)) => {
                out.write_str("Set ")?;
                spell(out, types, element)
            }
            Some(ObjectType::Map(key, value)) => {
                out.write_str("Map ")?;
                spell(out, types, key)?;
                out.write_char(' ')?;
                spell(out, types, value)
            }
            Some(plain) => write!(out, "{plain}"),
            None => Ok(()),
        },
        plain => write!(out, "{plain}"),
    }
}
