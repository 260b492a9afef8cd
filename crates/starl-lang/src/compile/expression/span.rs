//! Arithmetic of times and durations: Ints that are never negative.

use crate::compile::body::{Body, Slot};
use crate::compile::problem::Compiled;
use crate::compile::size::Size;
use crate::ir::{Operator, Type};
use crate::machine::Instruction;
use crate::machine::operand::In;

impl<'p> Body<'_, 'p> {
    /// Times and durations: Ints that are never negative.
    pub fn span_of_time(
        &mut self,
        operator: Operator,
        [left_type, right_type]: [&Type; 2],
        to: Slot,
        [left, right]: [Slot; 2],
    ) -> Compiled {
        let (slot, to) = (to, to.output());
        let (left, right) = (left.input(), right.input());
        let multiply = |span, times| Instruction::MultiplySpan { to, span, times };
        let scale = |span, factor| Instruction::ScaleSpan { to, span, factor };
        let instruction = match (operator, left_type, right_type) {
            (Operator::Add, ..) => Instruction::AddInt { to, left, right },
            (Operator::Subtract, ..) => Instruction::SubtractSpan { to, left, right },
            (Operator::Multiply, Type::Int, _) => multiply(right, left),
            (Operator::Multiply, _, Type::Int) => multiply(left, right),
            (Operator::Multiply, Type::Float, _) => scale(right, left),
            (Operator::Multiply, ..) => scale(left, right),
            (_, _, Type::Duration) => Instruction::RatioSpan { to, left, right },
            (_, _, Type::Int) => return self.divide_span(slot, left, right),
            _ => return self.divide_span_by_float(slot, left, right),
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

    /// A duration by a Float, to the nearest nanosecond; a result that is not a duration is an error.
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
}
