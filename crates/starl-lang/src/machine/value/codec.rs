//! Values as bytes, for messages between robots.
//!
//! The types are known on both sides, so that bytes hold values alone, as the postcard format has
//! them: Ints as variable-length zigzag numbers, Floats in eight bytes, other scalars as
//! variable-length numbers, lengths before texts and collections, records as their fields. So a message
//! of scalars and texts has the same bytes as that of a native program with the same struct.
//!
//! Bytes are untrusted: anything except a value of the type is rejected.

use crate::machine::program::Program;
use crate::machine::types::{Layout, ObjectType, Parts, Type};
use crate::machine::value::object::{Block, Body, List, Map, Object};
use alloc::vec::Vec;
use core::cmp::Ordering;
use starl_core::{Area, Payload, message};

impl Program {
    /// Values of these types, one after the other, as bytes; none if there are too few scalars or
    /// objects for the types.
    pub fn encode(&self, kinds: &[Type], scalars: &[u64], objects: &[Object]) -> Option<Payload> {
        let mut writer = Writer {
            program: self,
            scalars: scalars.iter(),
            objects: objects.iter(),
            out: Payload::new(),
        };
        kinds.iter().try_for_each(|kind| writer.value(kind))?;
        Some(writer.out)
    }

    /// The values of these types that the bytes hold; none if they hold anything else.
    pub fn decode(&self, kinds: &[Type], bytes: &[u8]) -> Option<(Vec<u64>, Vec<Object>)> {
        let mut reader = Reader {
            program: self,
            bytes,
            scalars: Vec::new(),
            objects: Vec::new(),
        };
        kinds.iter().try_for_each(|kind| reader.value(kind))?;
        let whole = reader.bytes.is_empty();
        whole.then_some((reader.scalars, reader.objects))
    }
}

struct Writer<'a> {
    program: &'a Program,
    scalars: core::slice::Iter<'a, u64>,
    objects: core::slice::Iter<'a, Object>,
    out: Payload,
}

impl Writer<'_> {
    fn value(&mut self, kind: &Type) -> Option<()> {
        match kind {
            Type::Object(index) => {
                let kind = self.program.bytecode.types.get(usize::from(*index))?;
                let object = self.objects.next()?;
                return self.object(kind, object);
            }
            Type::Record(fields) => {
                return fields.iter().try_for_each(|(_, field)| self.value(field));
            }
            Type::Point => return (0..3).try_for_each(|_| self.value(&Type::Float)),
            _ => {}
        }
        let scalar = *self.scalars.next()?;
        match kind {
            Type::Bool => self.out.push(u8::from(scalar != 0)),
            Type::Int => self.number(scalar << 1 ^ ((scalar as i64) >> 63) as u64),
            Type::Float => self.out.extend_from_slice(&scalar.to_le_bytes()),
            Type::Optional(value) if scalar != 0 => {
                self.out.push(1);
                return self.value(value);
            }
            Type::Optional(value) => {
                self.out.push(0);
                let layout = Layout::of([&**value]);
                for _ in &layout.scalars {
                    self.scalars.next();
                }
                for _ in &layout.objects {
                    self.objects.next();
                }
            }
            _ => self.number(scalar),
        }
        Some(())
    }

    /// Seven bits to a byte, the lowest first, the top bit set on all except the last.
    fn number(&mut self, mut number: u64) {
        while number >= 0x80 {
            self.out.push(number as u8 | 0x80);
            number >>= 7;
        }
        self.out.push(number as u8);
    }

    fn bytes(&mut self, bytes: &[u8]) {
        self.number(bytes.len() as u64);
        self.out.extend_from_slice(bytes);
    }

    fn object(&mut self, kind: &ObjectType, object: &Object) -> Option<()> {
        match kind {
            ObjectType::Text => self.bytes(object.text().as_bytes()),
            ObjectType::Area => self.bytes(&message::encode(&object.area())),
            ObjectType::Obstacles => match object.body() {
                Some(Body::Obstacles(obstacles)) => self.bytes(&message::encode(obstacles)),
                _ => self.number(0),
            },
            ObjectType::List(element) | ObjectType::Set(element) => {
                self.number(object.size() as u64);
                let empty = List::default();
                let list = object.list().unwrap_or(&empty);
                return list.iter().try_for_each(|block| self.block(element, block));
            }
            ObjectType::Map(key, value) => {
                self.number(object.size() as u64);
                let mut entries = object.map().into_iter().flat_map(Map::iter);
                return entries.try_for_each(|[k, v]| {
                    self.block(key, k)?;
                    self.block(value, v)
                });
            }
        }
        Some(())
    }

    fn block(&mut self, kind: &Type, block: Block<'_>) -> Option<()> {
        let bytes =
            self.program
                .encode(core::slice::from_ref(kind), block.scalars, block.objects)?;
        self.out.extend_from_slice(&bytes);
        Some(())
    }
}

struct Reader<'a> {
    program: &'a Program,
    bytes: &'a [u8],
    scalars: Vec<u64>,
    objects: Vec<Object>,
}

impl<'a> Reader<'a> {
    fn value(&mut self, kind: &Type) -> Option<()> {
        let scalar = match kind {
            Type::Bool => u64::from(self.bool()?),
            Type::Int => {
                let number = self.number()?;
                number >> 1 ^ (number & 1).wrapping_neg()
            }
            Type::Float => {
                let number = f64::from_le_bytes(*self.take(8)?.first_chunk()?);
                crate::machine::types::bits(number)
            }
            Type::Time | Type::Duration => self.number().filter(|&n| n <= i64::MAX as u64)?,
            Type::Robot => self.number().filter(|&n| n <= u64::from(u32::MAX))?,
            Type::Enum(index) => {
                let declared = self.program.bytecode.enums.get(usize::from(*index))?;
                let variants = declared.variants.len() as u64;
                self.number().filter(|&number| number < variants)?
            }
            Type::Point => return (0..3).try_for_each(|_| self.value(&Type::Float)),
            Type::Record(fields) => {
                return fields.iter().try_for_each(|(_, field)| self.value(field));
            }
            Type::Optional(value) => {
                if self.bool()? {
                    self.scalars.push(1);
                    return self.value(value);
                }
                let layout = Layout::of([kind]);
                self.scalars.extend(layout.scalars.iter().map(|_| 0));
                let none = layout.objects.iter().map(|_| Object::EMPTY);
                self.objects.extend(none);
                return Some(());
            }
            Type::Object(index) => {
                let object = self.object(*index)?;
                self.objects.push(object);
                return Some(());
            }
        };
        self.scalars.push(scalar);
        Some(())
    }

    fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.bytes.split_at_checked(count)?;
        self.bytes = rest;
        Some(taken)
    }

    fn bool(&mut self) -> Option<bool> {
        match self.take(1)? {
            [0] => Some(false),
            [1] => Some(true),
            _ => None,
        }
    }

    fn number(&mut self) -> Option<u64> {
        let mut number = 0u64;
        for place in (0..64).step_by(7) {
            let &[byte] = self.take(1)?.first_chunk()?;
            let bits = u64::from(byte & 0x7f);
            if place == 63 && bits > 1 {
                return None;
            }
            number |= bits << place;
            if byte < 0x80 {
                return Some(number);
            }
        }
        None
    }

    /// A length; every element takes a byte at least, so no length is taken that cannot be true.
    fn length(&mut self) -> Option<usize> {
        let length = usize::try_from(self.number()?).ok()?;
        (length <= self.bytes.len()).then_some(length)
    }

    fn object(&mut self, index: u16) -> Option<Object> {
        let program = self.program;
        let parts = program.parts.get(usize::from(index))?;
        let object: Object = match program.bytecode.types.get(usize::from(index))? {
            ObjectType::Text => {
                let length = self.length()?;
                core::str::from_utf8(self.take(length)?).ok()?.into()
            }
            ObjectType::Area => {
                let length = self.length()?;
                match message::decode::<Option<Area>>(self.take(length)?)? {
                    Some(area) => area.is_valid().then_some(area)?.into(),
                    None => Object::EMPTY,
                }
            }
            ObjectType::Obstacles => match self.length()? {
                0 => Object::EMPTY,
                length => {
                    let obstacles =
                        message::decode::<starl_core::motion::Obstacles>(self.take(length)?);
                    obstacles?.into()
                }
            },
            ObjectType::List(element) => self.elements(element, parts)?.into(),
            ObjectType::Set(element) => {
                let list = self.elements(element, parts)?;
                ascending(&list, parts, &program.parts)
                    .then_some(list)?
                    .into()
            }
            ObjectType::Map(key, value) => {
                let mut keys = List::new(&parts.element);
                let mut values = List::new(&parts.value);
                for _ in 0..self.length()? {
                    self.element(key, &mut keys)?;
                    self.element(value, &mut values)?;
                }
                if !ascending(&keys, parts, &program.parts) {
                    return None;
                }
                Body::Map(Map::new(&keys, &values)).into()
            }
        };
        Some(object)
    }

    fn elements(&mut self, kind: &Type, parts: &Parts) -> Option<List> {
        let mut list = List::new(&parts.element);
        for _ in 0..self.length()? {
            self.element(kind, &mut list)?;
        }
        Some(list)
    }

    fn element(&mut self, kind: &Type, list: &mut List) -> Option<()> {
        let (start, object_start) = (self.scalars.len(), self.objects.len());
        self.value(kind)?;
        let block = Block {
            scalars: &self.scalars[start..],
            objects: &self.objects[object_start..],
        };
        let pushed = list.push(block);
        self.scalars.truncate(start);
        self.objects.truncate(object_start);
        pushed.then_some(())
    }
}

fn ascending(list: &List, parts: &Parts, types: &[Parts]) -> bool {
    list.iter()
        .zip(list.iter().skip(1))
        .all(|(left, right)| left.compare(right, &parts.element, types) == Ordering::Less)
}
