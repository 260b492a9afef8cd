//! Operators of arithmetic. Which instruction an operator is, the types of its operands say.

use crate::check::Builtin;
use crate::compile::body::{Body, Slot};
use crate::compile::problem::Compiled;
use crate::ir::{Expression, ExpressionKind, Operator, Type};
use crate::machine::Instruction;
use crate::machine::operand::{In, ObjectInOut, Out};

/// The left operand of an operator.
#[derive(Clone, Copy)]
pub(in crate::compile) enum Left<'p> {
    /// An expression.
    Expression(&'p Expression),
    /// A value that is in registers already.
    Value(Slot, &'p Type),
}

impl<'p> Left<'p> {
    pub fn ty(self) -> &'p Type {
        match self {
            Self::Expression(expression) => &expression.ty,
            Self::Value(_, ty) => ty,
        }
    }
}

impl<'p> Body<'_, 'p> {
    /// The value of an operator of arithmetic.
    pub fn arithmetic(&mut self, expression: &'p Expression, to: Slot, is_fresh: bool) -> Compiled {
        let ExpressionKind::Binary {
            operator,
            left,
            right,
        } = &expression.kind
        else {
            return Err(self.broken());
        };
        match expression.ty {
            Type::String | Type::List(_) => {
                self.into(left, to, true)?;
                self.append(ObjectInOut(to.operand()), right, true)
            }
            _ => self.operate(*operator, Left::Expression(left), right, to, is_fresh),
        }
    }

    /// Puts a text or a list at the end of another one. If it is apart from that one, no part of it reads what the other
    /// becomes, so that its parts can be put there one by one.
    pub fn append(&mut self, to: ObjectInOut, right: &'p Expression, is_apart: bool) -> Compiled {
        match (&right.ty, &right.kind) {
            (_, ExpressionKind::Binary { left, right, .. }) if is_apart => {
                self.append(to, left, true)?;
                self.append(to, right, true)
            }
            (
                _,
                ExpressionKind::Builtin {
                    builtin: Builtin::ToString,
                    arguments,
                    ..
                },
            ) if is_apart => self.append_value(to, self.given(arguments, 0)?),
            _ => {
                let mark = self.mark();
                let from = self.object(right)?;
                self.emit(match right.ty {
                    Type::String => Instruction::AppendText { text: to, from },
                    _ => Instruction::ListAppend { list: to, from },
                });
                self.release(mark);
                Ok(())
            }
        }
    }

    /// An operator between scalars or points.
    pub fn operate(
        &mut self,
        operator: Operator,
        left: Left<'p>,
        right: &'p Expression,
        to: Slot,
        is_fresh: bool,
    ) -> Compiled {
        let (left_type, right_type) = (left.ty(), &right.ty);
        let are_integers = matches!(
            (left_type, right_type),
            (
                Type::Int | Type::Duration | Type::Time,
                Type::Int | Type::Duration | Type::Time
            )
        );
        if are_integers && self.with_constant(operator, left, right, to, is_fresh)? {
            return Ok(());
        }
        let spare = Some(to).filter(|_| is_fresh);
        let left = self.left(left, spare)?;
        let right = self.value(right)?;
        let (to_scalar, l, r) = (to.output(), left.input(), right.input());
        let instruction = match (left_type, right_type) {
            (Type::Int, Type::Int) => integers(operator, to_scalar, l, r),
            (Type::Float, Type::Float) => floats(operator, to_scalar, l, r),
            (Type::Point, Type::Point) => {
                let (to, left, right) = (to.point_out(), left.point(), right.point());
                match operator {
                    Operator::Add => Instruction::AddPoint { to, left, right },
                    _ => Instruction::SubtractPoint { to, left, right },
                }
            }
            (Type::Point, _) if operator == Operator::Divide => Instruction::DividePoint {
                to: to.point_out(),
                from: left.point(),
                divisor: r,
            },
            (Type::Point, _) => scale_point(to, left, r),
            (_, Type::Point) => scale_point(to, right, l),
            _ => return self.span_of_time(operator, [left_type, right_type], to, [left, right]),
        };
        self.emit(instruction);
        Ok(())
    }

    pub fn left(&mut self, left: Left<'p>, spare: Option<Slot>) -> Compiled<Slot> {
        match left {
            Left::Expression(expression) => self.value_or(expression, spare),
            Left::Value(slot, _) => Ok(slot),
        }
    }

    /// `-x`
    pub fn negate(&mut self, value: &'p Expression, to: Slot) -> Compiled {
        let from = self.value(value)?;
        self.emit(match value.ty {
            Type::Float => Instruction::NegateFloat {
                to: to.output(),
                from: from.input(),
            },
            Type::Point => Instruction::NegatePoint {
                to: to.point_out(),
                from: from.point(),
            },
            _ => Instruction::NegateInt {
                to: to.output(),
                from: from.input(),
            },
        });
        Ok(())
    }
}

fn scale_point(to: Slot, from: Slot, factor: In) -> Instruction {
    Instruction::ScalePoint {
        to: to.point_out(),
        from: from.point(),
        factor,
    }
}

fn integers(operator: Operator, to: Out, left: In, right: In) -> Instruction {
    match operator {
        Operator::Add => Instruction::AddInt { to, left, right },
        Operator::Subtract => Instruction::SubtractInt { to, left, right },
        Operator::Multiply => Instruction::MultiplyInt { to, left, right },
        Operator::Divide => Instruction::DivideInt { to, left, right },
        _ => Instruction::RemainderInt { to, left, right },
    }
}

fn floats(operator: Operator, to: Out, left: In, right: In) -> Instruction {
    match operator {
        Operator::Add => Instruction::AddFloat { to, left, right },
        Operator::Subtract => Instruction::SubtractFloat { to, left, right },
        Operator::Multiply => Instruction::MultiplyFloat { to, left, right },
        _ => Instruction::DivideFloat { to, left, right },
    }
}
