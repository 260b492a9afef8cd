//! Expressions: dispatches each kind to its part of the compiler.
//!
//! A value is computed `into` given registers, or into registers chosen by `value`. Registers are *fresh* if their
//! content is not read any more: then they may be written before all operands are read.

pub(in crate::compile) mod arithmetic;
mod builtin;
mod choice;
mod collection;
mod element;
mod geometry;
mod log;
mod method;
mod small;
mod span;
mod text;

use crate::check::Method;
use crate::compile::body::Location;
use crate::compile::body::{Body, Slot};
use crate::compile::constant::folded;
use crate::compile::problem::Compiled;
use crate::compile::size::Size;
use crate::compile::unit::Routine;
use crate::ir::{Expression, ExpressionKind, Operator, RobotMember, Type};
use crate::machine::Instruction;
use crate::machine::operand::ObjectIn;

impl<'p> Body<'_, 'p> {
    /// The value in registers: those where it is, or new ones.
    pub fn value(&mut self, expression: &'p Expression) -> Compiled<Slot> {
        self.value_or(expression, None)
    }

    /// The value in registers: those where it is, or `spare`, which is fresh and wide enough, or new ones.
    pub fn value_or(&mut self, expression: &'p Expression, spare: Option<Slot>) -> Compiled<Slot> {
        if let Some(slot) = self.part_of_temporary(expression)? {
            return Ok(slot);
        }
        if let Some(location) = self.locate(expression)? {
            return match (location, spare) {
                (Location::Registers(slot), _) => Ok(slot),
                (_, Some(spare)) => {
                    self.at(expression.span, |body| {
                        body.load(spare, location, &expression.ty)
                    });
                    Ok(spare)
                }
                (_, None) => self.at(expression.span, |body| {
                    body.value_at(location, &expression.ty)
                }),
            };
        }
        let slot = match spare {
            Some(spare) => spare,
            None => self.at(expression.span, |body| body.take_for(&expression.ty))?,
        };
        self.compute(expression, slot, true)?;
        Ok(slot)
    }

    /// A part of a value that has to be computed whole: it is taken where that is, without a copy.
    fn part_of_temporary(&mut self, expression: &'p Expression) -> Compiled<Option<Slot>> {
        let (base, offset) = match &expression.kind {
            ExpressionKind::Field { base, field } => (base, self.field_offset(&base.ty, *field)),
            ExpressionKind::Coordinate { base, axis } => (base, Size::new(u32::from(*axis), 0)),
            ExpressionKind::Unwrap(base) => (base, Size::SCALAR),
            ExpressionKind::Default { optional, .. } if self.counted(expression).is_some() => {
                (optional, Size::SCALAR)
            }
            _ => return Ok(None),
        };
        if is_located(base) {
            return Ok(None);
        }
        let whole = self.value(base)?;
        if matches!(expression.kind, ExpressionKind::Unwrap(_)) {
            let present = whole.input();
            self.at(expression.span, |body| {
                body.emit(Instruction::Require { present })
            });
        }
        Ok(Some(whole.at(offset)))
    }

    /// The map and the key of `m.get(k) ?? 0`: zero is what looking up a key gives that is missing.
    pub fn counted(&self, expression: &'p Expression) -> Option<(&'p Expression, &'p Expression)> {
        let ExpressionKind::Default { optional, default } = &expression.kind else {
            return None;
        };
        let ExpressionKind::Method {
            receiver,
            method: Method::MapGet,
            arguments,
        } = &optional.kind
        else {
            return None;
        };
        let is_value = matches!(&receiver.ty, Type::Map(_, value) if **value == default.ty);
        let is_zero = folded(&self.unit.known, default) == Some(0);
        let key = arguments.first()?;
        (is_value && is_zero).then_some((receiver, key))
    }

    /// The object as an operand: that of a register or of a variable of the state.
    pub fn object(&mut self, expression: &'p Expression) -> Compiled<ObjectIn> {
        if is_located(expression)
            && let Some(location) = self.locate(expression)?
        {
            return self.at(expression.span, |body| body.object_at(location));
        }
        Ok(self.value(expression)?.object_in())
    }

    /// Computes the value into registers.
    pub fn into(&mut self, expression: &'p Expression, to: Slot, is_fresh: bool) -> Compiled {
        let mark = self.mark();
        if is_located(expression) {
            if let Some(location) = self.locate(expression)? {
                self.at(expression.span, |body| {
                    body.load(to, location, &expression.ty)
                });
            }
        } else if let Some(part) = self.part_of_temporary(expression)? {
            let size = self.size(&expression.ty);
            self.at(expression.span, |body| body.move_value(to, part, size));
        } else if is_fresh || !writes_early(expression) {
            self.compute(expression, to, is_fresh)?;
        } else {
            let size = self.size(&expression.ty);
            let made = self.at(expression.span, |body| body.take(size))?;
            self.compute(expression, made, true)?;
            self.at(expression.span, |body| body.move_value(to, made, size));
        }
        self.release(mark);
        Ok(())
    }

    /// Computes a value that is nowhere yet.
    fn compute(&mut self, expression: &'p Expression, to: Slot, is_fresh: bool) -> Compiled {
        let outer = core::mem::replace(&mut self.span, expression.span);
        let mark = self.mark();
        self.compute_here(expression, to, is_fresh)?;
        self.release(mark);
        self.span = outer;
        Ok(())
    }

    fn compute_here(&mut self, expression: &'p Expression, to: Slot, is_fresh: bool) -> Compiled {
        if let Some(bits) = folded(&self.unit.known, expression) {
            self.scalar(to, bits);
            return Ok(());
        }
        let ty = &expression.ty;
        match &expression.kind {
            ExpressionKind::String(text) => {
                self.text(to, text);
                Ok(())
            }
            ExpressionKind::None => self.zeros(to, ty),
            ExpressionKind::Present(value) => {
                self.scalar(to, 1);
                self.into(value, to.at(Size::SCALAR), true)
            }
            ExpressionKind::Record(values) => self.sequence(values.iter(), to),
            ExpressionKind::Index { base, index } => self.index(base, index, to),
            ExpressionKind::Lookup { base, key } => self.lookup(base, key, to),
            ExpressionKind::Default { optional, default } => {
                self.or_default(optional, default, to, is_fresh)
            }
            ExpressionKind::Negate(value) => self.negate(value, to),
            ExpressionKind::Binary {
                operator:
                    Operator::Add
                    | Operator::Subtract
                    | Operator::Multiply
                    | Operator::Divide
                    | Operator::Remainder,
                ..
            } => self.arithmetic(expression, to, is_fresh),
            ExpressionKind::Conditional {
                condition,
                then,
                otherwise,
            } => self.conditional(condition, [then, otherwise], to, is_fresh),
            ExpressionKind::List(elements) | ExpressionKind::Set(elements) => {
                self.list(elements, ty, to)
            }
            ExpressionKind::Map(entries) => self.map(entries, ty, to),
            ExpressionKind::Comprehension(made) => self.comprehension(made, ty, to),
            ExpressionKind::Best {
                comprehension,
                is_greatest,
            } => self.best(comprehension, *is_greatest, ty, to),
            ExpressionKind::OfRobot { robot, member } => {
                self.of_robot(robot, *member, to, ty, is_fresh)
            }
            ExpressionKind::Not(_)
            | ExpressionKind::IsNone(_)
            | ExpressionKind::In { .. }
            | ExpressionKind::Bind { .. }
            | ExpressionKind::Quantifier { .. }
            | ExpressionKind::Over { .. }
            | ExpressionKind::Binary { .. } => self.truth(expression, to),
            _ => self.compute_call(expression, to, is_fresh),
        }
    }

    /// A value that a function, the host or a primitive gives.
    fn compute_call(&mut self, expression: &'p Expression, to: Slot, is_fresh: bool) -> Compiled {
        let ty = &expression.ty;
        match &expression.kind {
            ExpressionKind::Constant(id) => {
                let function = self.unit.routine(Routine::Constant(*id));
                self.call_function(function, &[], to, ty, is_fresh)
            }
            ExpressionKind::Call {
                function,
                arguments,
            } => {
                let number = self.unit.routine(Routine::Function(*function));
                self.call_function(number, arguments, to, ty, is_fresh)
            }
            ExpressionKind::Builtin {
                builtin,
                arguments,
                rest,
            } => self.builtin(expression, *builtin, arguments, rest, to, is_fresh),
            ExpressionKind::Method {
                receiver,
                method,
                arguments,
            } => self.method(expression, receiver, *method, arguments, to),
            ExpressionKind::Change {
                place,
                method,
                arguments,
            } => self.change(place, *method, arguments),
            ExpressionKind::Primitive {
                binding,
                member,
                arguments,
            } => self.member(*binding, member, arguments, to, ty, is_fresh),
            ExpressionKind::SharedElement { shared, robot, of } => {
                let robots = [Some(&**robot), of.as_deref()];
                self.shared_element(*shared, robots, to, ty, is_fresh)
            }
            ExpressionKind::SharedMap(shared) => self.shared_map(*shared, None, to, ty, is_fresh),
            ExpressionKind::Shared(shared) => self.shared(*shared, None, to, ty, is_fresh),
            // Literals are folded, variables and their parts are located.
            _ => Err(self.broken()),
        }
    }

    /// Values one after the other.
    pub fn sequence(&mut self, values: impl Iterator<Item = &'p Expression>, to: Slot) -> Compiled {
        let mut at = to;
        for value in values {
            self.into(value, at, true)?;
            at = at.at(self.size(&value.ty));
        }
        Ok(())
    }

    /// Values one after the other in new registers; gives the first.
    pub fn row(&mut self, values: &[&'p Expression]) -> Compiled<Slot> {
        let first = self.take(Size::NONE)?;
        for value in values {
            let slot = self.take_for(&value.ty)?;
            self.into(value, slot, true)?;
        }
        Ok(first)
    }
}

/// Whether the value is a variable or a part of one.
pub(in crate::compile) fn is_located(expression: &Expression) -> bool {
    match &expression.kind {
        ExpressionKind::Local(_) | ExpressionKind::Variable(_) | ExpressionKind::Parameter(_) => {
            true
        }
        ExpressionKind::Field { base, .. }
        | ExpressionKind::Coordinate { base, .. }
        | ExpressionKind::Unwrap(base) => is_located(base),
        ExpressionKind::OfRobot { robot, member } => match member {
            RobotMember::Variable(_) | RobotMember::Parameter(_) => true,
            RobotMember::Id => is_located(robot),
            _ => false,
        },
        _ => false,
    }
}

/// Whether computing the value writes parts of it before everything that it is made of is read.
fn writes_early(expression: &Expression) -> bool {
    match &expression.kind {
        ExpressionKind::Present(_)
        | ExpressionKind::Record(_)
        | ExpressionKind::List(_)
        | ExpressionKind::Set(_)
        | ExpressionKind::Map(_)
        | ExpressionKind::Comprehension(_)
        | ExpressionKind::Method { .. } => true,
        ExpressionKind::Builtin { builtin, .. } => {
            use crate::check::Builtin::{Bearing, Choose, Clamp, MakePoint, ToString};
            matches!(builtin, MakePoint | ToString | Choose | Clamp | Bearing)
        }
        ExpressionKind::Binary {
            operator: Operator::Add,
            ..
        } => matches!(
            expression.ty,
            crate::ir::Type::String | crate::ir::Type::List(_)
        ),
        _ => false,
    }
}
