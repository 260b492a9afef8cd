//! Operators of arithmetic with a small constant, which instructions can hold.

use crate::compile::body::{Body, Slot};
use crate::compile::constant::folded;
use crate::compile::expression::arithmetic::Left;
use crate::compile::problem::Compiled;
use crate::ir::{Expression, Operator, Type};
use crate::machine::Instruction;
use crate::machine::operand::{Immediate, In, Out};

impl<'p> Body<'_, 'p> {
    /// An operator with a small constant, if there is an instruction for it.
    pub fn with_constant(
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
        if let Some(constant) = small(folded(&self.unit.known, right)) {
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
        if let Some(constant) = small(folded(&self.unit.known, expression)) {
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
