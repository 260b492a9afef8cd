//! The text of `log`, with its placeholders.

use alloc::string::String;
use alloc::vec::Vec;

use crate::check::Builtin;
use crate::compile::body::{Body, Slot};
use crate::compile::call::{Arguments, HostFunction};
use crate::compile::problem::Compiled;
use crate::compile::size::Size;
use crate::ir::{Expression, ExpressionKind, Type};
use crate::machine::operand::{Immediate, Short};
use crate::machine::{Import, Instruction};

/// The registers for the pieces of a format between its places.
struct Pieces {
    /// All pieces.
    list: Slot,
    /// The piece that it is at.
    piece: Slot,
    /// The text of a place.
    place: Slot,
    /// How many pieces there are.
    count: Slot,
    /// The number of the piece that it is at.
    index: Slot,
}

impl<'p> Body<'_, 'p> {
    /// `log(format, ...)`
    pub fn log(
        &mut self,
        arguments: Arguments<'p>,
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
        let import = Import {
            name,
            query: is_query,
            labels: Vec::new(),
            arguments: Vec::from([kind]),
            results: Vec::new(),
        };
        self.call_host(import, text);
        self.release(mark);
        Ok(())
    }

    /// A text whose `{}` stand for the values. Values without one are computed too.
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
        let pieces = Pieces {
            list: self.take(Size::OBJECT)?,
            piece: self.take(Size::OBJECT)?,
            place: self.take(Size::OBJECT)?,
            count: self.take(Size::SCALAR)?,
            index: self.take(Size::SCALAR)?,
        };
        self.split(format, &pieces)?;
        self.list_get(pieces.list.object_in(), pieces.index.input(), to);
        for (number, (_, value)) in rest.iter().enumerate() {
            let mark = self.mark();
            let slot = self.value(value)?;
            let end = self.label();
            self.emit(Instruction::JumpIfLessConstant {
                left: pieces.count.input(),
                right: Short(i16::try_from(number + 2).unwrap_or(i16::MAX)),
                target: end.target(),
            });
            self.append_part(to.object_in_out(), slot, &value.ty, false)?;
            self.next_piece(&pieces);
            self.append_listed(&pieces, to);
            self.place(end);
            self.release(mark);
        }
        // Places that no value is for stay as they are.
        let (again, end) = (self.code.here(), self.label());
        self.next_piece(&pieces);
        self.emit(Instruction::JumpIfLessEqual {
            left: pieces.count.input(),
            right: pieces.index.input(),
            target: end.target(),
        });
        self.emit(Instruction::AppendText {
            text: to.object_in_out(),
            from: pieces.place.object_in(),
        });
        self.append_listed(&pieces, to);
        self.jump(again);
        self.place(end);
        Ok(())
    }

    /// Splits a format at its places; the first piece is the one that it is at.
    fn split(&mut self, format: &'p Expression, pieces: &Pieces) -> Compiled {
        let kind = self.object_type(&Type::list(Type::String))?;
        let text = self.object(format)?;
        self.text(pieces.place, "{}");
        self.emit(Instruction::SplitText {
            to: pieces.list.object_out(),
            text,
            separator: pieces.place.object_in(),
            kind,
        });
        self.emit(Instruction::Size {
            to: pieces.count.output(),
            from: pieces.list.object_in(),
        });
        self.scalar(pieces.index, 0);
        Ok(())
    }

    fn next_piece(&mut self, pieces: &Pieces) {
        self.emit(Instruction::AddConstant {
            to: pieces.index.output(),
            left: pieces.index.input(),
            right: Immediate(1),
        });
    }

    /// Puts the piece that it is at at the end of the text.
    fn append_listed(&mut self, pieces: &Pieces, to: Slot) {
        self.list_get(pieces.list.object_in(), pieces.index.input(), pieces.piece);
        self.emit(Instruction::AppendText {
            text: to.object_in_out(),
            from: pieces.piece.object_in(),
        });
    }
}
