//! The types of a program as the machine knows them: how many registers a value takes, and the table
//! of the types of objects.
//!
//! Invariant: an object type stands after those that it is made of, and each stands once.

use alloc::boxed::Box;
use alloc::collections::BTreeMap;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::size::Size;
use crate::ir::{self, EnumId, Program, RecordId};
use crate::machine::{Enum, ObjectType, Type};

/// A part of a value, by the kind of its comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// A scalar other than a Float, at this position among the value's scalars.
    Scalar(u32),
    /// A Float.
    Float(u32),
    /// The first of the three scalars of a Point.
    Point(u32),
    /// An object of this type, at this place among the value's objects.
    Object(u32, u16),
}

/// Why the machine does not take a type.
#[derive(Clone, Copy, Debug)]
pub(super) enum Unsuitable {
    /// It is nested too deeply.
    Depth,
    /// A value, or an element with what belongs to it, takes too many registers.
    Width,
    /// There are too many types already.
    Number,
}

/// The deepest that the machine lets records, optionals or collections be nested.
const DEEPEST: u32 = 31;

/// The most types of objects, and the most enums, that a program may use.
const MOST: usize = u16::MAX as usize - 1;

/// The types that a program uses.
pub(super) struct Types<'p> {
    program: &'p Program,
    /// The sizes of records, by their numbers.
    records: Vec<Size>,
    /// The types of objects.
    pub objects: Vec<ObjectType>,
    /// How deeply each of them is nested.
    depths: Vec<u32>,
    /// The enums.
    pub enums: Vec<Enum>,
    numbers: BTreeMap<EnumId, u16>,
    /// The numbers of the types of objects that were asked for: a type may hold another one many times over.
    known: BTreeMap<ir::Type, u16>,
}

impl<'p> Types<'p> {
    pub fn new(program: &'p Program) -> Self {
        let mut types = Self {
            program,
            records: alloc::vec![Size::NONE; program.records.len()],
            objects: Vec::new(),
            depths: Vec::new(),
            enums: Vec::new(),
            numbers: BTreeMap::new(),
            known: BTreeMap::new(),
        };
        for id in &program.record_order {
            let fields = program[*id].fields.iter();
            let size = fields.fold(Size::NONE, |sum, field| sum.plus(types.size(&field.ty)));
            types.records[id.index()] = size;
        }
        types
    }

    /// The registers that a value of the type takes.
    pub fn size(&self, of: &ir::Type) -> Size {
        match of {
            ir::Type::Error | ir::Type::Nothing => Size::NONE,
            ir::Type::Point => Size::new(3, 0),
            ir::Type::Record(id) => self.records[id.index()],
            ir::Type::Optional(inner) => Size::SCALAR.plus(self.size(inner)),
            ir::Type::Range => Size::new(2, 0),
            ir::Type::Bool
            | ir::Type::Int
            | ir::Type::Float
            | ir::Type::Time
            | ir::Type::Duration
            | ir::Type::Robot
            | ir::Type::Enum(_) => Size::SCALAR,
            ir::Type::String
            | ir::Type::Area
            | ir::Type::Obstacles
            | ir::Type::List(_)
            | ir::Type::Set(_)
            | ir::Type::Map(..) => Size::OBJECT,
        }
    }

    /// Where a field begins in its record.
    pub fn offset(&self, record: RecordId, field: u32) -> Size {
        let before = self.program[record].fields.iter().take(field as usize);
        before.fold(Size::NONE, |sum, field| sum.plus(self.size(&field.ty)))
    }

    /// The machine's type.
    pub fn of(&mut self, of: &ir::Type) -> Result<Type, Unsuitable> {
        self.nested(of, 0)
    }

    fn nested(&mut self, of: &ir::Type, depth: u32) -> Result<Type, Unsuitable> {
        if !self.size(of).fits() {
            return Err(Unsuitable::Width);
        }
        if depth > DEEPEST {
            return Err(Unsuitable::Depth);
        }
        Ok(match of {
            ir::Type::Bool => Type::Bool,
            ir::Type::Float => Type::Float,
            ir::Type::Time => Type::Time,
            ir::Type::Duration => Type::Duration,
            ir::Type::Robot => Type::Robot,
            ir::Type::Point => Type::Point,
            ir::Type::Enum(id) => Type::Enum(self.enumeration(*id)?),
            ir::Type::Optional(inner) => Type::Optional(Box::new(self.nested(inner, depth + 1)?)),
            ir::Type::Record(id) => {
                let fields = self.program[*id].fields.iter();
                let kinds = fields.map(|field| {
                    let kind = self.nested(&field.ty, depth + 1)?;
                    Ok((field.name.clone(), kind))
                });
                Type::Record(kinds.collect::<Result<_, Unsuitable>>()?)
            }
            ir::Type::String
            | ir::Type::Area
            | ir::Type::Obstacles
            | ir::Type::List(_)
            | ir::Type::Set(_)
            | ir::Type::Map(..) => Type::Object(self.object(of)?),
            // No value of a correct program is of another type.
            ir::Type::Int | ir::Type::Error | ir::Type::Range | ir::Type::Nothing => Type::Int,
        })
    }

    /// The number of the type of an object.
    pub fn object(&mut self, of: &ir::Type) -> Result<u16, Unsuitable> {
        if let Some(known) = self.known.get(of) {
            return Ok(*known);
        }
        let parts = match of {
            ir::Type::List(part) | ir::Type::Set(part) => self.size(part),
            ir::Type::Map(key, value) => self.size(key).plus(self.size(value)),
            _ => Size::NONE,
        };
        if !parts.fits() {
            return Err(Unsuitable::Width);
        }
        let object = match of {
            ir::Type::List(element) => ObjectType::List(self.of(element)?),
            ir::Type::Set(element) => ObjectType::Set(self.of(element)?),
            ir::Type::Map(key, value) => ObjectType::Map(self.of(key)?, self.of(value)?),
            ir::Type::Area => ObjectType::Area,
            ir::Type::Obstacles => ObjectType::Obstacles,
            _ => ObjectType::Text,
        };
        let number = self.add(object)?;
        self.known.insert(of.clone(), number);
        Ok(number)
    }

    fn add(&mut self, object: ObjectType) -> Result<u16, Unsuitable> {
        if let Some(known) = self.objects.iter().position(|known| *known == object) {
            return Ok(known as u16);
        }
        let depth = match &object {
            ObjectType::Text | ObjectType::Area | ObjectType::Obstacles => 0,
            ObjectType::List(part) | ObjectType::Set(part) => self.depth(part),
            ObjectType::Map(key, value) => self.depth(key).max(self.depth(value)),
        };
        if depth > DEEPEST {
            return Err(Unsuitable::Depth);
        }
        if self.objects.len() >= MOST {
            return Err(Unsuitable::Number);
        }
        self.depths.push(depth + 1);
        self.objects.push(object);
        Ok((self.objects.len() - 1) as u16)
    }

    fn depth(&self, of: &Type) -> u32 {
        match of {
            Type::Object(index) => self.depths[usize::from(*index)],
            Type::Optional(inner) => self.depth(inner),
            Type::Record(fields) => {
                let depths = fields.iter().map(|(_, field)| self.depth(field));
                depths.max().unwrap_or(0)
            }
            _ => 0,
        }
    }

    /// The number of an enum.
    pub fn enumeration(&mut self, id: EnumId) -> Result<u16, Unsuitable> {
        if let Some(known) = self.numbers.get(&id) {
            return Ok(*known);
        }
        if self.enums.len() >= MOST {
            return Err(Unsuitable::Number);
        }
        let declared = &self.program[id];
        let variants = declared.variants.iter().map(|variant| variant.name.clone());
        self.enums.push(Enum {
            name: declared.name.clone().unwrap_or_else(|| "enum".to_string()),
            variants: variants.collect::<Vec<String>>(),
        });
        let number = (self.enums.len() - 1) as u16;
        self.numbers.insert(id, number);
        Ok(number)
    }

    /// The parts of a value, as they are compared.
    pub fn parts(&mut self, of: &ir::Type) -> Result<Vec<Part>, Unsuitable> {
        let mut parts = Vec::new();
        self.add_parts(of, Size::NONE, &mut parts)?;
        Ok(parts)
    }

    fn add_parts(
        &mut self,
        of: &ir::Type,
        at: Size,
        parts: &mut Vec<Part>,
    ) -> Result<Size, Unsuitable> {
        let end = at.plus(self.size(of));
        match of {
            ir::Type::Float => parts.push(Part::Float(at.scalars)),
            ir::Type::Point => parts.push(Part::Point(at.scalars)),
            ir::Type::Optional(inner) => {
                parts.push(Part::Scalar(at.scalars));
                self.add_parts(inner, at.plus(Size::SCALAR), parts)?;
            }
            ir::Type::Record(id) => {
                let fields = &self.program[*id].fields;
                let mut at = at;
                for field in fields {
                    at = self.add_parts(&field.ty, at, parts)?;
                }
            }
            _ if self.size(of) == Size::OBJECT => {
                let kind = self.object(of)?;
                parts.push(Part::Object(at.objects, kind));
            }
            _ if self.size(of) == Size::SCALAR => parts.push(Part::Scalar(at.scalars)),
            _ => {}
        }
        Ok(end)
    }
}
