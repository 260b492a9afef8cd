//! The rules of instructions on texts, areas and objects of any type.

use super::flow::{Broken, Context};
use super::rules::{WRONG_TYPE, exists, same};
use crate::machine::instruction::Instruction;
use crate::machine::operand::Format;
use crate::machine::types::{ObjectType, Type};

impl Context<'_> {
    pub fn particular_to_objects(&mut self, instruction: &Instruction) -> Result<(), Broken> {
        use Instruction::*;
        match *instruction {
            CopyObject { to, from } => {
                let kind = self.object(from.0)?;
                self.write_object(to.0, kind)
            }
            MoveObject { to, from } => {
                let kind = self.object(from.0)?;
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
                let text = self.find(&ObjectType::Text)?;
                self.write_object(to.0, text)
            }
            AppendText { text, from } | AppendQuoted { text, from } => {
                self.is_text(text.0)?;
                self.is_text(from.0)
            }
            AppendObject { text, from, kind } => {
                same(self.object(from.0)?, kind.0)?;
                self.is_text(text.0)
            }
            AppendScalar { text, .. } | AppendPoint { text, .. } => self.is_text(text.0),
            AppendVariant { text, of, .. } => {
                let enums = &self.bytecode.enums;
                exists(enums.get(usize::from(of.0)), "there is no such enum")?;
                self.is_text(text.0)
            }
            ContainsText { text, part, .. } | MatchText { text, part, .. } => {
                self.is_text(text.0)?;
                self.is_text(part.0)
            }
            ChangeText { to, text, .. } => {
                self.is_text(text.0)?;
                self.write_text(to.0)
            }
            ReplaceText { to, text, part, by } => {
                self.is_text(text.0)?;
                self.is_text(part.0)?;
                self.is_text(by.0)?;
                self.write_text(to.0)
            }
            JoinTexts {
                to,
                list,
                separator,
            } => {
                self.is_list_of_texts(self.object(list.0)?)?;
                self.is_text(separator.0)?;
                self.write_text(to.0)
            }
            NumberOfText { text, format, .. } => match format {
                Format::Int | Format::Float => self.is_text(text.0),
                _ => Err(WRONG_TYPE),
            },
            SplitText {
                to,
                text,
                separator,
                kind,
            } => {
                self.is_text(text.0)?;
                self.is_text(separator.0)?;
                self.is_list_of_texts(kind.0)?;
                self.write_object(to.0, kind.0)
            }
            Circle { to, .. } => {
                let area = self.find(&ObjectType::Area)?;
                self.write_object(to.0, area)
            }
            Polygon { to, corners } => {
                match self.kind(self.object(corners.0)?)? {
                    ObjectType::List(Type::Point) => {}
                    _ => return Err(WRONG_TYPE),
                }
                let area = self.find(&ObjectType::Area)?;
                self.write_object(to.0, area)
            }
            AreaContains { area, .. } => match self.kind(self.object(area.0)?)? {
                ObjectType::Area => Ok(()),
                _ => Err(WRONG_TYPE),
            },
            _ => self.particular_to_collections(instruction),
        }
    }

    fn write_text(&mut self, operand: u8) -> Result<(), Broken> {
        let text = self.find(&ObjectType::Text)?;
        self.write_object(operand, text)
    }

    fn is_list_of_texts(&self, kind: u16) -> Result<(), Broken> {
        let parts = self.list_parts(kind)?;
        let text = self.find(&ObjectType::Text)?;
        match parts.element.scalars.is_empty() && parts.element.objects == [text] {
            true => Ok(()),
            false => Err(WRONG_TYPE),
        }
    }

    fn is_text(&self, operand: u8) -> Result<(), Broken> {
        match self.kind(self.object(operand)?)? {
            ObjectType::Text => Ok(()),
            _ => Err(WRONG_TYPE),
        }
    }
}
