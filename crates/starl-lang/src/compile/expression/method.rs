//! Methods that change nothing.

use crate::check::Method;
use crate::compile::body::{Body, Slot};
use crate::compile::problem::Compiled;
use crate::compile::size::Size;
use crate::ir::{Expression, Type};
use crate::machine::operand::{Format, Immediate, ObjectIn, PairOut, TextChange, TextEnd};
use crate::machine::{Instruction, operand};

impl<'p> Body<'_, 'p> {
    /// The value of a method.
    pub fn method(
        &mut self,
        expression: &'p Expression,
        receiver: &'p Expression,
        method: Method,
        arguments: &'p [Expression],
        to: Slot,
    ) -> Compiled {
        use Method::*;
        let ty = &expression.ty;
        match method {
            ListReversed | ListSorted | ListSlice | SetUnion | SetIntersection | SetDifference => {
                self.into(receiver, to, true)?;
                return self.changed_copy(&receiver.ty, method, arguments, to);
            }
            _ => {}
        }
        let from = self.object(receiver)?;
        let output = to.output();
        match method {
            ListSize | SetSize | MapSize | StringSize => {
                self.emit(Instruction::Size { to: output, from });
            }
            ListContains | SetContains | MapContains => {
                let item = self.value(self.argument_of(arguments, 0)?)?;
                self.contains(from, &receiver.ty, item, to)?;
            }
            ListIndexOf => {
                let item = self.value(self.argument_of(arguments, 0)?)?;
                self.find(from, &receiver.ty, item, to)?;
            }
            ListFirst | SetMin | ListLast | SetMax => {
                let is_last = matches!(method, ListLast | SetMax);
                self.end_of(from, &receiver.ty, is_last, ty, to)?;
            }
            ListSum => self.emit(match ty {
                Type::Float => Instruction::SumFloat {
                    to: output,
                    list: from,
                },
                _ => Instruction::SumInt {
                    to: output,
                    list: from,
                },
            }),
            MapGet => self.map_get(from, receiver, arguments, ty, to)?,
            _ => return self.given_method(expression, from, method, arguments, to),
        }
        Ok(())
    }

    /// Methods that are one instruction each.
    fn given_method(
        &mut self,
        expression: &'p Expression,
        from: ObjectIn,
        method: Method,
        arguments: &'p [Expression],
        to: Slot,
    ) -> Compiled {
        let (output, object) = (to.output(), to.object_out());
        let instruction = match method {
            Method::MapKeys => Instruction::MapKeys {
                to: object,
                map: from,
                kind: self.object_type(&expression.ty)?,
            },
            Method::MapValues => Instruction::MapValues {
                to: object,
                map: from,
                kind: self.object_type(&expression.ty)?,
            },
            Method::StringContains => Instruction::ContainsText {
                to: output,
                text: from,
                part: self.object(self.argument_of(arguments, 0)?)?,
            },
            Method::StringSplit => Instruction::SplitText {
                to: object,
                text: from,
                separator: self.object(self.argument_of(arguments, 0)?)?,
                kind: self.object_type(&expression.ty)?,
            },
            Method::StringStartsWith | Method::StringEndsWith => Instruction::MatchText {
                to: output,
                text: from,
                part: self.object(self.argument_of(arguments, 0)?)?,
                end: match method {
                    Method::StringStartsWith => TextEnd::Start,
                    _ => TextEnd::End,
                },
            },
            Method::StringLower | Method::StringUpper | Method::StringTrim => {
                Instruction::ChangeText {
                    to: object,
                    text: from,
                    change: match method {
                        Method::StringLower => TextChange::Lower,
                        Method::StringUpper => TextChange::Upper,
                        _ => TextChange::Trim,
                    },
                }
            }
            Method::StringReplace => Instruction::ReplaceText {
                to: object,
                text: from,
                part: self.object(self.argument_of(arguments, 0)?)?,
                by: self.object(self.argument_of(arguments, 1)?)?,
            },
            Method::ListJoin => Instruction::JoinTexts {
                to: object,
                list: from,
                separator: self.object(self.argument_of(arguments, 0)?)?,
            },
            Method::StringToInt | Method::StringToFloat => Instruction::NumberOfText {
                to: PairOut(output.0),
                text: from,
                format: match method {
                    Method::StringToInt => Format::Int,
                    _ => Format::Float,
                },
            },
            Method::AreaContains => Instruction::AreaContains {
                to: output,
                area: from,
                point: self.value(self.argument_of(arguments, 0)?)?.point(),
            },
            _ => return Err(self.broken()),
        };
        self.emit(instruction);
        Ok(())
    }

    /// An argument of a method.
    pub fn argument_of(
        &self,
        arguments: &'p [Expression],
        index: usize,
    ) -> Compiled<&'p Expression> {
        arguments.get(index).ok_or_else(|| self.broken())
    }

    /// A method applied to a copy of its receiver.
    fn changed_copy(
        &mut self,
        ty: &Type,
        method: Method,
        arguments: &'p [Expression],
        to: Slot,
    ) -> Compiled {
        let copy = to.object_in_out();
        let instruction = match method {
            Method::ListReversed => Instruction::ListReverse { list: copy },
            Method::ListSorted => Instruction::ListSort {
                list: copy,
                kind: self.object_type(ty)?,
            },
            Method::ListSlice => Instruction::ListSlice {
                list: copy,
                first: self.value(self.argument_of(arguments, 0)?)?.input(),
                last: self.value(self.argument_of(arguments, 1)?)?.input(),
            },
            _ => {
                let from = self.object(self.argument_of(arguments, 0)?)?;
                let kind = self.object_type(ty)?;
                match method {
                    Method::SetUnion => Instruction::SetUnite {
                        set: copy,
                        from,
                        kind,
                    },
                    Method::SetIntersection => Instruction::SetIntersect {
                        set: copy,
                        from,
                        kind,
                    },
                    _ => Instruction::SetSubtract {
                        set: copy,
                        from,
                        kind,
                    },
                }
            }
        };
        self.emit(instruction);
        Ok(())
    }

    /// The first or the last element.
    fn end_of(
        &mut self,
        from: ObjectIn,
        collection: &Type,
        is_last: bool,
        ty: &Type,
        to: Slot,
    ) -> Compiled {
        let size = self.object_size(from)?;
        self.element_or_none(from, size, collection, ty, to, |body, index| {
            match is_last {
                true => body.emit(Instruction::AddConstant {
                    to: index.output(),
                    left: size.input(),
                    right: Immediate(-1),
                }),
                false => body.scalar(index, 0),
            }
            Ok(())
        })
    }

    fn map_get(
        &mut self,
        map: ObjectIn,
        receiver: &'p Expression,
        arguments: &'p [Expression],
        ty: &Type,
        to: Slot,
    ) -> Compiled {
        let Type::Map(_, value) = &receiver.ty else {
            return Err(self.broken());
        };
        let key = self.value(self.argument_of(arguments, 0)?)?;
        let kind = self.object_type(&receiver.ty)?;
        // A value that may be none itself is what is given: of two Bools the second will do.
        let size = self.size(value);
        let is_flat = **value == *ty;
        let optional = match is_flat {
            true => self.take(Size::SCALAR.plus(size))?,
            false => to,
        };
        self.look_up(map, key, optional, kind);
        if is_flat {
            self.move_value(to, optional.at(Size::SCALAR), size);
        }
        Ok(())
    }

    /// The value of a key as an optional: whether there is one, then the value, or zero.
    pub fn look_up(&mut self, map: ObjectIn, key: Slot, to: Slot, kind: operand::Type) {
        self.emit(Instruction::MapGet {
            map,
            scalars: key.block(),
            objects: key.objects(),
            to: to.block(),
            to_objects: to.objects(),
            kind,
        });
    }
}
