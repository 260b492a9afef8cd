//! Texts of values.

use alloc::format;
use alloc::string::String;

use crate::compile::body::{Body, Slot};
use crate::compile::expression::is_located;
use crate::compile::problem::Compiled;
use crate::compile::size::Size;
use crate::ir::{Expression, Type};
use crate::machine::Instruction;
use crate::machine::operand::{EnumIndex, Format, ObjectInOut};
use crate::{ir, machine};

impl<'p> Body<'_, 'p> {
    /// `String(x)`
    pub fn text_of(&mut self, value: &'p Expression, to: Slot) -> Compiled {
        if value.ty == Type::String {
            return self.into(value, to, true);
        }
        self.clear(to, &Type::String)?;
        self.append_value(to.object_in_out(), value)
    }

    /// Puts the text of a value at the end of a text.
    pub fn append_value(&mut self, text: ObjectInOut, value: &'p Expression) -> Compiled {
        let mark = self.mark();
        let is_object =
            self.size(&value.ty) == Size::OBJECT && !matches!(value.ty, Type::Record(_));
        if is_object && is_located(value) {
            let from = self.object(value)?;
            self.append_object(text, from, &value.ty)?;
        } else {
            let slot = self.value(value)?;
            self.append_part(text, slot, &value.ty, false)?;
        }
        self.release(mark);
        Ok(())
    }

    fn append_object(
        &mut self,
        text: ObjectInOut,
        from: machine::operand::ObjectIn,
        ty: &Type,
    ) -> Compiled {
        let instruction = match ty {
            Type::String => Instruction::AppendText { text, from },
            _ => Instruction::AppendObject {
                text,
                from,
                kind: self.object_type(ty)?,
            },
        };
        self.emit(instruction);
        Ok(())
    }

    /// Puts a constant piece at the end of a text.
    pub fn append_piece(&mut self, text: ObjectInOut, piece: &str) -> Compiled {
        let mark = self.mark();
        let from = self.take(Size::OBJECT)?;
        self.text(from, piece);
        self.emit(Instruction::AppendText {
            text,
            from: from.object_in(),
        });
        self.release(mark);
        Ok(())
    }

    /// Puts the text of a value in registers at the end of a text. Within a record texts have quotes.
    pub fn append_part(
        &mut self,
        text: ObjectInOut,
        slot: Slot,
        ty: &Type,
        is_within: bool,
    ) -> Compiled {
        let from = slot.input();
        let format = match ty {
            Type::Bool => Format::Bool,
            Type::Float => Format::Float,
            Type::Time => Format::Time,
            Type::Duration => Format::Duration,
            Type::Robot => Format::Robot,
            Type::Point => {
                let from = slot.point();
                self.emit(Instruction::AppendPoint { text, from });
                return Ok(());
            }
            Type::Enum(id) => {
                let number = self.unit.types.enumeration(*id);
                let of = EnumIndex(number.map_err(|why| self.unsuitable(ty, why))?);
                self.emit(Instruction::AppendVariant { text, from, of });
                return Ok(());
            }
            Type::String if is_within => {
                let from = slot.object_in();
                self.emit(Instruction::AppendQuoted { text, from });
                return Ok(());
            }
            Type::Optional(inner) => return self.append_optional(text, slot, inner, is_within),
            Type::Record(id) => return self.append_record(text, slot, *id),
            _ if self.size(ty) == Size::OBJECT => {
                return self.append_object(text, slot.object_in(), ty);
            }
            _ => Format::Int,
        };
        self.emit(Instruction::AppendScalar { text, from, format });
        Ok(())
    }

    fn append_optional(
        &mut self,
        text: ObjectInOut,
        slot: Slot,
        inner: &Type,
        is_within: bool,
    ) -> Compiled {
        let (none, end) = (self.label(), self.label());
        self.jump_on(slot, false, none);
        self.append_part(text, slot.at(Size::SCALAR), inner, is_within)?;
        self.jump(end);
        self.place(none);
        self.append_piece(text, "none")?;
        self.place(end);
        Ok(())
    }

    fn append_record(&mut self, text: ObjectInOut, slot: Slot, id: ir::RecordId) -> Compiled {
        let program = self.unit.program;
        let mut at = slot;
        let mut before = String::from("(");
        for field in &program[id].fields {
            if !program[id].is_tuple() {
                before += &format!("{} = ", field.name);
            }
            self.append_piece(text, &before)?;
            self.append_part(text, at, &field.ty, true)?;
            at = at.at(self.size(&field.ty));
            before = ", ".into();
        }
        let end = if before == "(" { "()" } else { ")" };
        self.append_piece(text, end)
    }
}
