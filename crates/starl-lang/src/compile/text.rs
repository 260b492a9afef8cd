//! Texts of values: `String(x)`, and what `log` writes.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::body::{Body, Slot};
use super::call::HostFunction;
use super::expression::is_located;
use super::problem::Compiled;
use super::types::Size;
use crate::check::Builtin;
use crate::ir::{self, Expression, ExpressionKind, Type};
use crate::machine::operand::{EnumIndex, Format, Immediate, ImportIndex, ObjectInOut, Short};
use crate::machine::{self, Import, Instruction};

impl<'p> Body<'_, 'p> {
    /// `String(x)`
    pub fn text_of(&mut self, value: &'p Expression, to: Slot) -> Compiled {
        if value.ty == Type::String {
            return self.into(value, to, true);
        }
        self.empty_text(to)?;
        self.append_value(to.object_in_out(), value)
    }

    fn empty_text(&mut self, to: Slot) -> Compiled {
        let kind = self.object_type(&Type::String)?;
        self.emit(Instruction::ClearObject {
            to: to.object_out(),
            kind,
        });
        Ok(())
    }

    /// Puts the text of a value at the end of a text.
    fn append_value(&mut self, text: ObjectInOut, value: &'p Expression) -> Compiled {
        let mark = self.mark();
        if self.size(&value.ty) == Size::OBJECT && is_located(value) {
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
    fn append_piece(&mut self, text: ObjectInOut, piece: &str) -> Compiled {
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
    fn append_part(
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
        self.emit(Instruction::JumpUnless {
            condition: slot.input(),
            target: none.target(),
        });
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
            before += &format!("{} = ", field.name);
            self.append_piece(text, &before)?;
            self.append_part(text, at, &field.ty, true)?;
            at = at.at(self.size(&field.ty));
            before = ", ".into();
        }
        let end = if before == "(" { "()" } else { ")" };
        self.append_piece(text, end)
    }

    /// `log(format, ...)`
    pub fn log(
        &mut self,
        arguments: &'p [Option<Expression>],
        rest: &'p [(Option<String>, Expression)],
    ) -> Compiled {
        let format = self.given(arguments, 0)?;
        let mark = self.mark();
        let text = self.take(Size::OBJECT)?;
        match &format.kind {
            ExpressionKind::String(pieces) => self.format(pieces, rest, text)?,
            _ if rest.is_empty() => self.into(format, text, true)?,
            _ => self.format_at_run(format, rest, text)?,
        }
        let kind = self.machine_type(&Type::String)?;
        let HostFunction { name, is_query, .. } = HostFunction::effect(Builtin::Log.name());
        let import = self.unit.import(Import {
            name,
            query: is_query,
            labels: Vec::new(),
            arguments: Vec::from([kind]),
            results: Vec::new(),
        });
        self.emit(Instruction::CallHost {
            scalars: text.block(),
            objects: text.objects(),
            import: ImportIndex(import),
        });
        self.release(mark);
        Ok(())
    }

    /// A text whose `{}` stand for the values. Values without one are computed all the same.
    fn format(
        &mut self,
        pieces: &'p str,
        rest: &'p [(Option<String>, Expression)],
        to: Slot,
    ) -> Compiled {
        let mut pieces = pieces.split("{}");
        let first = pieces.next().unwrap_or_default();
        self.text(to, first);
        let mut values = rest.iter();
        for piece in pieces {
            match values.next() {
                Some((_, value)) => self.append_value(to.object_in_out(), value)?,
                None => self.append_piece(to.object_in_out(), "{}")?,
            }
            if !piece.is_empty() {
                self.append_piece(to.object_in_out(), piece)?;
            }
        }
        for (_, value) in values {
            let mark = self.mark();
            self.value(value)?;
            self.release(mark);
        }
        Ok(())
    }

    /// The same of a text that is known only when the program runs.
    fn format_at_run(
        &mut self,
        format: &'p Expression,
        rest: &'p [(Option<String>, Expression)],
        to: Slot,
    ) -> Compiled {
        let kind = self.object_type(&Type::list(Type::String))?;
        let (pieces, piece, place) = (
            self.take(Size::OBJECT)?,
            self.take(Size::OBJECT)?,
            self.take(Size::OBJECT)?,
        );
        let (count, index) = (self.take(Size::SCALAR)?, self.take(Size::SCALAR)?);
        let text = self.object(format)?;
        self.text(place, "{}");
        self.emit(Instruction::SplitText {
            to: pieces.object_out(),
            text,
            separator: place.object_in(),
            kind,
        });
        self.emit(Instruction::Size {
            to: count.output(),
            from: pieces.object_in(),
        });
        self.scalar(index, 0);
        self.list_get(pieces, index, to);
        for (number, (_, value)) in rest.iter().enumerate() {
            let mark = self.mark();
            let slot = self.value(value)?;
            let end = self.label();
            let bound = Short(i16::try_from(number + 2).unwrap_or(i16::MAX));
            self.emit(Instruction::JumpIfLessConstant {
                left: count.input(),
                right: bound,
                target: end.target(),
            });
            self.append_part(to.object_in_out(), slot, &value.ty, false)?;
            self.emit(Instruction::AddConstant {
                to: index.output(),
                left: index.input(),
                right: Immediate(1),
            });
            self.append_listed(pieces, index, piece, to);
            self.place(end);
            self.release(mark);
        }
        // Places that no value is for stay as they are.
        let (again, end) = (self.code.here(), self.label());
        self.emit(Instruction::AddConstant {
            to: index.output(),
            left: index.input(),
            right: Immediate(1),
        });
        self.emit(Instruction::JumpIfLessEqual {
            left: count.input(),
            right: index.input(),
            target: end.target(),
        });
        self.emit(Instruction::AppendText {
            text: to.object_in_out(),
            from: place.object_in(),
        });
        self.append_listed(pieces, index, piece, to);
        self.jump(again);
        self.place(end);
        Ok(())
    }

    fn list_get(&mut self, list: Slot, index: Slot, to: Slot) {
        self.emit(Instruction::ListGet {
            list: list.object_in(),
            index: index.input(),
            scalars: to.block(),
            objects: to.objects(),
        });
    }

    fn append_listed(&mut self, list: Slot, index: Slot, piece: Slot, to: Slot) {
        self.list_get(list, index, piece);
        self.emit(Instruction::AppendText {
            text: to.object_in_out(),
            from: piece.object_in(),
        });
    }
}
