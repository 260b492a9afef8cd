//! The rules of instructions on texts, areas and objects of any type.

use super::flow::{Broken, Context};
use super::rules::{WRONG_TYPE, exists, same};
use crate::machine::instruction::Instruction;
use crate::machine::operand::{Format, ObjectIn, ObjectInOut};
use crate::machine::types::{ObjectType, Type};

impl Context<'_> {
    pub fn particular_to_objects(&mut self, instruction: &Instruction) -> Result<(), Broken> {
        use Instruction::*;
        match *instruction {
            CopyObject {
                to,
                from: ObjectIn(from),
            }
            | MoveObject {
                to,
                from: ObjectInOut(from),
            } => {
                let kind = self.object(from)?;
                self.write_object(to.0, kind)
            }
            ClearObject { to, kind } => {
                self.kind(kind.0)?;
                self.write_object(to.0, kind.0)
            }
            LoadObject { to, variable } => {
                let kind = self.state_object(variable.0)?;
                self.write_object(to.0, kind)
            }
            StoreObject { variable, from } => {
                self.may_write_state()?;
                same(self.state_object(variable.0)?, self.object(from.0)?)
            }
            EqualObject {
                left, right, kind, ..
            }
            | LessObject {
                left, right, kind, ..
            } => {
                same(self.object(left.0)?, kind.0)?;
                same(self.object(right.0)?, kind.0)
            }
            Size { from, .. } => match self.kind(self.object(from.0)?)? {
                ObjectType::Area => Err(WRONG_TYPE),
                _ => Ok(()),
            },
            Text { to, constant } => {
                let texts = &self.bytecode.texts;
                exists(texts.get(constant.0 as usize), "there is no such text")?;
                self.write_new(to.0, &ObjectType::Text)
            }
            AppendText { text, from } | AppendQuoted { text, from } => {
                self.is(text.0, &ObjectType::Text)?;
                self.is(from.0, &ObjectType::Text)
            }
            AppendObject { text, from, kind } => {
                same(self.object(from.0)?, kind.0)?;
                self.is(text.0, &ObjectType::Text)
            }
            AppendScalar { text, .. } | AppendPoint { text, .. } => {
                self.is(text.0, &ObjectType::Text)
            }
            AppendVariant { text, of, .. } => {
                let enums = &self.bytecode.enums;
                exists(enums.get(usize::from(of.0)), "there is no such enum")?;
                self.is(text.0, &ObjectType::Text)
            }
            ContainsText { text, part, .. } | MatchText { text, part, .. } => {
                self.is(text.0, &ObjectType::Text)?;
                self.is(part.0, &ObjectType::Text)
            }
            ChangeText { to, text, .. } => {
                self.is(text.0, &ObjectType::Text)?;
                self.write_new(to.0, &ObjectType::Text)
            }
            ReplaceText { to, text, part, by } => {
                self.is(text.0, &ObjectType::Text)?;
                self.is(part.0, &ObjectType::Text)?;
                self.is(by.0, &ObjectType::Text)?;
                self.write_new(to.0, &ObjectType::Text)
            }
            JoinTexts {
                to,
                list,
                separator,
            } => {
                self.is_list_of_texts(self.object(list.0)?)?;
                self.is(separator.0, &ObjectType::Text)?;
                self.write_new(to.0, &ObjectType::Text)
            }
            NumberOfText { text, format, .. } => match format {
                Format::Int | Format::Float => self.is(text.0, &ObjectType::Text),
                _ => Err(WRONG_TYPE),
            },
            SplitText {
                to,
                text,
                separator,
                kind,
            } => {
                self.is(text.0, &ObjectType::Text)?;
                self.is(separator.0, &ObjectType::Text)?;
                self.is_list_of_texts(kind.0)?;
                self.write_object(to.0, kind.0)
            }
            Circle { to, .. } => self.write_new(to.0, &ObjectType::Area),
            Polygon { to, corners } => {
                self.is(corners.0, &ObjectType::List(Type::Point))?;
                self.write_new(to.0, &ObjectType::Area)
            }
            AreaContains { area, .. } => self.is(area.0, &ObjectType::Area),
            _ => self.particular_to_collections(instruction),
        }
    }

    /// An operand becomes an object of a type that is there once.
    fn write_new(&mut self, operand: u8, object: &ObjectType) -> Result<(), Broken> {
        let kind = self.find(object)?;
        self.write_object(operand, kind)
    }

    fn is_list_of_texts(&self, kind: u16) -> Result<(), Broken> {
        let parts = self.list_parts(kind)?;
        let text = self.find(&ObjectType::Text)?;
        match parts.element.scalars.is_empty() && parts.element.objects == [text] {
            true => Ok(()),
            false => Err(WRONG_TYPE),
        }
    }
}
