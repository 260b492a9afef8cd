//! Operators of arithmetic. Which instruction an operator is, the types of its operands say.

use super::body::{Body, Slot};
use super::constant::folded;
use super::problem::Compiled;
use super::types::Size;
use crate::ir::{Expression, ExpressionKind, Operator, Type};
use crate::machine::Instruction;
use crate::machine::operand::{Immediate, In, Out};

/// What stands on the left of an operator.
#[derive(Clone, Copy)]
pub(super) enum Left<'p> {
    /// An expression.
    Expression(&'p Expression),
    /// A value that is in registers already.
    Value(Slot, &'p Type),
}

impl<'p> Left<'p> {
    fn ty(self) -> &'p Type {
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
                self.append(to.operand(), right)
            }
            _ => self.operate(*operator, Left::Expression(left), right, to, is_fresh),
        }
    }

    /// Puts a text or a list at the end of another one.
    pub fn append(&mut self, to: u8, right: &'p Expression) -> Compiled {
        use crate::machine::operand::ObjectInOut;
        let mark = self.mark();
        let from = self.object(right)?;
        self.emit(match right.ty {
            Type::String => Instruction::AppendText {
                text: ObjectInOut(to),
                from,
            },
            _ => Instruction::ListAppend {
                list: ObjectInOut(to),
                from,
            },
        });
        self.release(mark);
        Ok(())
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
            (Type::Point, Type::Point) => match operator {
                Operator::Add => Instruction::AddPoint {
                    to: to.point_out(),
                    left: left.point(),
                    right: right.point(),
                },
                _ => Instruction::SubtractPoint {
                    to: to.point_out(),
                    left: left.point(),
                    right: right.point(),
                },
            },
            (Type::Point, _) if operator == Operator::Divide => Instruction::DividePoint {
                to: to.point_out(),
                from: left.point(),
                divisor: r,
            },
            (Type::Point, _) => Instruction::ScalePoint {
                to: to.point_out(),
                from: left.point(),
                factor: r,
            },
            (_, Type::Point) => Instruction::ScalePoint {
                to: to.point_out(),
                from: right.point(),
                factor: l,
            },
            _ => return self.span_of_time(operator, [left_type, right_type], to, [left, right]),
        };
        self.emit(instruction);
        Ok(())
    }

    fn left(&mut self, left: Left<'p>, spare: Option<Slot>) -> Compiled<Slot> {
        match left {
            Left::Expression(expression) => self.value_or(expression, spare),
            Left::Value(slot, _) => Ok(slot),
        }
    }

    /// Times and durations: Ints that are never negative.
    fn span_of_time(
        &mut self,
        operator: Operator,
        [left_type, right_type]: [&Type; 2],
        to: Slot,
        [left, right]: [Slot; 2],
    ) -> Compiled {
        let (output, l, r) = (to.output(), left.input(), right.input());
        let instruction = match (operator, left_type, right_type) {
            (Operator::Add, ..) => Instruction::AddInt {
                to: output,
                left: l,
                right: r,
            },
            (Operator::Subtract, ..) => Instruction::SubtractSpan {
                to: output,
                left: l,
                right: r,
            },
            (Operator::Multiply, Type::Int, _) => Instruction::MultiplySpan {
                to: output,
                span: r,
                times: l,
            },
            (Operator::Multiply, _, Type::Int) => Instruction::MultiplySpan {
                to: output,
                span: l,
                times: r,
            },
            (Operator::Multiply, Type::Float, _) => Instruction::ScaleSpan {
                to: output,
                span: r,
                factor: l,
            },
            (Operator::Multiply, ..) => Instruction::ScaleSpan {
                to: output,
                span: l,
                factor: r,
            },
            (_, _, Type::Duration) => Instruction::RatioSpan {
                to: output,
                left: l,
                right: r,
            },
            (_, _, Type::Int) => return self.divide_span(to, l, r),
            _ => return self.divide_span_by_float(to, l, r),
        };
        self.emit(instruction);
        Ok(())
    }

    /// A duration by an Int; a negative duration is an error.
    fn divide_span(&mut self, to: Slot, span: In, divisor: In) -> Compiled {
        let mark = self.mark();
        let (quotient, one) = (self.take(Size::SCALAR)?, self.take(Size::SCALAR)?);
        self.emit(Instruction::DivideInt {
            to: quotient.output(),
            left: span,
            right: divisor,
        });
        self.scalar(one, 1);
        self.emit(Instruction::MultiplySpan {
            to: to.output(),
            span: quotient.input(),
            times: one.input(),
        });
        self.release(mark);
        Ok(())
    }

    /// A duration by a Float, to the nearest nanosecond; what is no duration is an error.
    fn divide_span_by_float(&mut self, to: Slot, span: In, divisor: In) -> Compiled {
        let mark = self.mark();
        let (quotient, one) = (self.take(Size::SCALAR)?, self.take(Size::SCALAR)?);
        self.emit(Instruction::FloatOfInt {
            to: quotient.output(),
            from: span,
        });
        self.emit(Instruction::DivideFloat {
            to: quotient.output(),
            left: quotient.input(),
            right: divisor,
        });
        self.scalar(one, 1);
        self.emit(Instruction::ScaleSpan {
            to: to.output(),
            span: one.input(),
            factor: quotient.input(),
        });
        self.release(mark);
        Ok(())
    }

    /// An operator with a small constant, if there is an instruction for it.
    fn with_constant(
        &mut self,
        operator: Operator,
        left: Left<'p>,
        right: &'p Expression,
        to: Slot,
        is_fresh: bool,
    ) -> Compiled<bool> {
        let small = |bits: Option<u64>| bits.and_then(|bits| i32::try_from(bits as i64).ok());
        let are_ints = *left.ty() == Type::Int && right.ty == Type::Int;
        let spare = Some(to).filter(|_| is_fresh);
        if let Some(constant) = small(folded(self.unit, right)) {
            let output = to.output();
            let is_positive_span =
                *left.ty() == Type::Duration && right.ty == Type::Int && constant > 0;
            let make: fn(Out, In, Immediate) -> Instruction = match operator {
                Operator::Add => add_constant,
                Operator::Subtract if are_ints && constant != i32::MIN => subtract_constant,
                Operator::Multiply if are_ints => multiply_constant,
                Operator::Divide if are_ints || is_positive_span => divide_constant,
                Operator::Remainder => remainder_constant,
                _ => return Ok(false),
            };
            let left = self.left(left, spare)?;
            self.emit(make(output, left.input(), Immediate(constant)));
            return Ok(true);
        }
        let Left::Expression(expression) = left else {
            return Ok(false);
        };
        if let Some(constant) = small(folded(self.unit, expression)) {
            let make: fn(Out, In, Immediate) -> Instruction = match operator {
                Operator::Add => add_constant,
                Operator::Multiply if are_ints => multiply_constant,
                _ => return Ok(false),
            };
            let right = self.value_or(right, spare)?;
            self.emit(make(to.output(), right.input(), Immediate(constant)));
            return Ok(true);
        }
        Ok(false)
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

fn add_constant(to: Out, left: In, right: Immediate) -> Instruction {
    Instruction::AddConstant { to, left, right }
}

fn subtract_constant(to: Out, left: In, right: Immediate) -> Instruction {
    let right = Immediate(-right.0);
    Instruction::AddConstant { to, left, right }
}

fn multiply_constant(to: Out, left: In, right: Immediate) -> Instruction {
    Instruction::MultiplyConstant { to, left, right }
}

fn divide_constant(to: Out, left: In, right: Immediate) -> Instruction {
    Instruction::DivideConstant { to, left, right }
}

fn remainder_constant(to: Out, left: In, right: Immediate) -> Instruction {
    Instruction::RemainderConstant { to, left, right }
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
