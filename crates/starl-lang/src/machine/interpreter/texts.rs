//! Instructions on texts.

use crate::machine::error::Fault;
use crate::machine::interpreter::view::{View, shift};
use crate::machine::operand::{
    self, EnumIndex, Format, In, ObjectIn, ObjectInOut, ObjectOut, Out, PointIn, Text,
};
use crate::machine::types::Type;
use crate::machine::value::list::List;
use crate::machine::value::object::Object;
use crate::machine::value::tree::Value;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt::Write;
use starl_core::{Duration, Time};

impl View<'_> {
    pub fn text(&mut self, to: ObjectOut, constant: Text) -> Result<u64, Fault> {
        let text = self.program.texts.get(constant.0 as usize).cloned();
        self.share(to, text.ok_or(Fault::Malformed)?)
    }

    pub fn append_text(&mut self, text: ObjectInOut, from: ObjectIn) -> Result<u64, Fault> {
        if text.0 == from.0 {
            let from = self.read(from)?.clone();
            return self.append(text, from.text(), shift(from.bytes()));
        }
        self.change(text, |object, view| {
            let from = view.read(from)?;
            let text = object.text_mut().ok_or(Fault::Malformed)?;
            text.push_str(from.text());
            Ok(shift(from.bytes()))
        })
    }

    pub fn append_scalar(
        &mut self,
        text: ObjectInOut,
        from: In,
        format: Format,
    ) -> Result<u64, Fault> {
        let scalar = self.scalar(from);
        self.change(text, |object, _| {
            let text = object.text_mut().ok_or(Fault::Malformed)?;
            format_scalar(text, scalar, format).map_err(|_| Fault::Malformed)?;
            Ok(3)
        })
    }

    pub fn append_point(&mut self, text: ObjectInOut, from: PointIn) -> Result<u64, Fault> {
        let first = from.0;
        let [x, y, z] = [first, first.wrapping_add(1), first.wrapping_add(2)]
            .map(|register| f64::from_bits(self.registers[usize::from(register)]));
        self.append(text, &alloc::format!("({x:?}, {y:?}, {z:?})"), 11)
    }

    pub fn append_variant(
        &mut self,
        text: ObjectInOut,
        from: In,
        of: EnumIndex,
    ) -> Result<u64, Fault> {
        let number = usize::try_from(self.scalar(from)).ok();
        let variants = self.program.bytecode.enums.get(usize::from(of.0));
        let name = variants.and_then(|e| e.variants.get(number?));
        let name = name.ok_or(Fault::ConversionOutOfRange)?;
        self.append(text, name, shift(name.len()))
    }

    pub fn append_object(
        &mut self,
        text: ObjectInOut,
        from: ObjectIn,
        kind: operand::Type,
    ) -> Result<u64, Fault> {
        let object = self.read(from)?.clone();
        let kind = Type::Object(kind.0);
        let value = Value::read(self.program, &kind, &[], core::slice::from_ref(&object));
        let words = match value {
            Some(Value::Text(text)) => text,
            Some(value) => alloc::format!("{value}"),
            None => return Err(Fault::ConversionOutOfRange), // there is no such variant of an enum
        };
        self.append(text, &words, (words.len() / 8) as u64)
    }

    pub fn append_quoted(&mut self, text: ObjectInOut, from: ObjectIn) -> Result<u64, Fault> {
        let words = alloc::format!("{:?}", self.read(from)?.text());
        self.append(text, &words, (words.len() / 8) as u64)
    }

    fn append(&mut self, text: ObjectInOut, words: &str, cost: u64) -> Result<u64, Fault> {
        self.change(text, |object, _| {
            object.text_mut().ok_or(Fault::Malformed)?.push_str(words);
            Ok(cost)
        })
    }

    pub fn contains_text(&mut self, to: Out, text: ObjectIn, part: ObjectIn) -> Result<u64, Fault> {
        let (text, part) = (self.read(text)?.text(), self.read(part)?.text());
        let cost = (text.len() + part.len()) / 8;
        let found = text.contains(part);
        self.set_bool(to, found);
        Ok(cost as u64)
    }

    pub fn split_text(
        &mut self,
        to: ObjectOut,
        text: ObjectIn,
        separator: ObjectIn,
    ) -> Result<u64, Fault> {
        let (text, separator) = (self.read(text)?.text(), self.read(separator)?.text());
        let parts: Vec<Object> = match separator {
            "" => Vec::from([text.into()]),
            separator => match separator.parse::<char>() {
                // One character is found faster than a text.
                Ok(character) => text.split(character).map(Object::from).collect(),
                Err(_) => text.split(separator).map(Object::from).collect(),
            },
        };
        let cost = shift(text.len()) + 8 * parts.len() as u64;
        Ok(cost + self.put(to, List::of_objects(parts).into())?)
    }
}

/// Writes a scalar as a person reads it.
pub(in crate::machine) fn format_scalar(
    out: &mut String,
    scalar: u64,
    format: Format,
) -> core::fmt::Result {
    match format {
        Format::Bool => write!(out, "{}", scalar != 0),
        Format::Int => write!(out, "{}", scalar as i64),
        Format::Float => write!(out, "{:?}", f64::from_bits(scalar)),
        Format::Time => write!(out, "{}", Time(scalar)),
        Format::Duration => write!(out, "{}", Duration(scalar)),
        Format::Robot => write!(out, "robot{scalar}"),
    }
}
