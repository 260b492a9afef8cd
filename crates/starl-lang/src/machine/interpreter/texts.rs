//! Instructions on texts.

use crate::machine::error::Fault;
use crate::machine::interpreter::view::{View, shift};
use crate::machine::operand::{
    self, EnumIndex, Format, In, ObjectIn, ObjectInOut, ObjectOut, Out, PairOut, PointIn, Text,
    TextChange, TextEnd,
};
use crate::machine::types::Type;
use crate::machine::value::object::{List, Object};
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

impl View<'_> {
    pub fn match_text(
        &mut self,
        to: Out,
        text: ObjectIn,
        part: ObjectIn,
        end: TextEnd,
    ) -> Result<u64, Fault> {
        let (text, part) = (self.read(text)?.text(), self.read(part)?.text());
        let cost = part.len() / 8;
        let matches = match end {
            TextEnd::Start => text.starts_with(part),
            TextEnd::End => text.ends_with(part),
        };
        self.set_bool(to, matches);
        Ok(cost as u64)
    }

    pub fn change_text(
        &mut self,
        to: ObjectOut,
        text: ObjectIn,
        change: TextChange,
    ) -> Result<u64, Fault> {
        let text = self.read(text)?.text();
        let cost = (text.len() / 8) as u64;
        let changed: Object = match change {
            TextChange::Lower => (&*text.to_lowercase()).into(),
            TextChange::Upper => (&*text.to_uppercase()).into(),
            TextChange::Trim => text.trim().into(),
        };
        Ok(cost + self.put(to, changed)?)
    }

    pub fn replace_text(
        &mut self,
        to: ObjectOut,
        text: ObjectIn,
        part: ObjectIn,
        by: ObjectIn,
    ) -> Result<u64, Fault> {
        let (text, part) = (self.read(text)?.text(), self.read(part)?.text());
        let by = self.read(by)?.text();
        let count = match part {
            "" => 0,
            part => text.matches(part).count(),
        };
        let size = text.len() - count * part.len() + count.saturating_mul(by.len());
        self.fits(size)?;
        let replaced: Object = match count {
            0 => text.into(),
            _ => (&*text.replace(part, by)).into(),
        };
        let cost = (text.len() + part.len() + size) / 8;
        Ok(cost as u64 + self.put(to, replaced)?)
    }

    pub fn join_texts(
        &mut self,
        to: ObjectOut,
        list: ObjectIn,
        separator: ObjectIn,
    ) -> Result<u64, Fault> {
        let (list, separator) = (self.read(list)?.list(), self.read(separator)?.text());
        let texts = || {
            let elements = list.into_iter().flat_map(|list| list.iter());
            elements.map(|element| element.objects.first().map_or("", Object::text))
        };
        let count = texts().count();
        let between = count.saturating_sub(1).saturating_mul(separator.len());
        let size = between.saturating_add(texts().map(str::len).sum());
        self.fits(size)?;
        let mut joined = String::with_capacity(size);
        for (number, text) in texts().enumerate() {
            joined.push_str(if number > 0 { separator } else { "" });
            joined.push_str(text);
        }
        let cost = (count + size / 8) as u64;
        Ok(cost + self.put(to, (&*joined).into())?)
    }

    pub fn number_of_text(
        &mut self,
        to: PairOut,
        text: ObjectIn,
        format: Format,
    ) -> Result<u64, Fault> {
        let text = self.read(text)?.text();
        let cost = (text.len() / 8) as u64;
        let number = match format {
            Format::Float => {
                let number = text.parse::<f64>().ok();
                number.filter(|number| number.is_finite()).map(f64::to_bits)
            }
            _ => text.parse::<i64>().ok().map(|number| number as u64),
        };
        self.registers[usize::from(to.0)] = u64::from(number.is_some());
        self.registers[usize::from(to.0.wrapping_add(1))] = number.unwrap_or(0);
        Ok(cost)
    }

    /// An error if a text of this size is beyond what all values may take together.
    fn fits(&self, size: usize) -> Result<(), Fault> {
        match size <= self.meter.budget {
            true => Ok(()),
            false => Err(Fault::OutOfMemory {
                budget: self.meter.budget as u64,
            }),
        }
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
