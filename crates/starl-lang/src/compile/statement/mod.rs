//! Statements.

mod assignment;
mod change;
mod changes;
mod repetition;
mod way;

use crate::compile::body::{Body, Location, Slot};
use crate::compile::expression::is_located;
use crate::compile::problem::Compiled;
use crate::compile::size::Size;
use crate::compile::statement::changes::may_change;
use crate::compile::unit::Routine;
use crate::ir::{Expression, ExpressionKind, Statement, StatementKind};
use crate::machine::operand::{Count, FunctionIndex, Slot as StateSlot};
use crate::machine::{FunctionKind, Instruction};

impl<'p> Body<'_, 'p> {
    /// The statements of a block. Its locals end with it.
    pub fn block(&mut self, statements: &'p [Statement]) -> Compiled {
        let mark = self.mark();
        for statement in statements {
            let outer = core::mem::replace(&mut self.span, statement.span);
            self.statement(statement)?;
            self.span = outer;
        }
        self.release(mark);
        Ok(())
    }

    fn statement(&mut self, statement: &'p Statement) -> Compiled {
        match &statement.kind {
            StatementKind::Let { local, value } => {
                let slot = self.declare(*local)?;
                self.into(value, slot, true)
            }
            StatementKind::Assign { place, value } => self.assign(place, value),
            StatementKind::Update {
                place,
                operator,
                value,
            } => self.update(place, *operator, value),
            StatementKind::ChangeRole { value } => self.change_role(value),
            StatementKind::If {
                condition,
                then,
                otherwise,
            } => self.if_else(condition, then, otherwise),
            StatementKind::For {
                variables,
                collection,
                body: statements,
            } => {
                let may_change = may_change(statements, collection);
                self.for_each(collection, *variables, may_change, |body| {
                    body.block(statements)
                })
            }
            StatementKind::Return(value) => self.give(value.as_ref()),
            StatementKind::Evaluate(value) => {
                let mark = self.mark();
                let size = self.size(&value.ty);
                let slot = self.take(size)?;
                self.into(value, slot, true)?;
                self.release(mark);
                Ok(())
            }
            // The action waits as a whole.
            StatementKind::Atomic { body, .. } => self.block(body),
        }
    }

    /// `if`; a chain of `elif` is gone through without going deeper.
    fn if_else(
        &mut self,
        condition: &'p Expression,
        then: &'p [Statement],
        otherwise: &'p [Statement],
    ) -> Compiled {
        let end = self.label();
        let (mut condition, mut then, mut otherwise) = (condition, then, otherwise);
        loop {
            let mark = self.mark();
            let no = self.label();
            self.branch(condition, false, no)?;
            self.block(then)?;
            self.release(mark);
            if !otherwise.is_empty() && self.code.is_reached() {
                self.jump(end);
            }
            self.place(no);
            match otherwise {
                [only] => match &only.kind {
                    StatementKind::If {
                        condition: next,
                        then: block,
                        otherwise: rest,
                    } => {
                        self.span = only.span;
                        (condition, then, otherwise) = (next, block, rest);
                        continue;
                    }
                    _ => self.block(otherwise)?,
                },
                _ => self.block(otherwise)?,
            }
            break;
        }
        self.place(end);
        Ok(())
    }

    /// `role = value`
    fn change_role(&mut self, value: &'p Expression) -> Compiled {
        let Some(roles) = &self.unit.program.roles else {
            return Err(self.broken());
        };
        let role = self.unit.variable(roles.variable);
        let mark = self.mark();
        let new = self.value(value)?;
        let old = self.scalar_at(Location::State(role))?;
        let end = self.label();
        self.emit(Instruction::JumpIfEqual {
            left: new.input(),
            right: old.input(),
            target: end.target(),
        });
        self.emit(Instruction::Store {
            variable: StateSlot(role.scalars),
            from: new.input(),
        });
        self.release(mark);
        self.run(Routine::Enter)?;
        self.place(end);
        Ok(())
    }

    /// Calls a procedure without arguments.
    pub fn run(&mut self, routine: Routine) -> Compiled {
        let function = self.unit.routine(routine);
        let window = self.take(Size::NONE)?;
        self.emit(Instruction::Call {
            scalars: window.block(),
            objects: window.objects(),
            function: FunctionIndex(function),
        });
        Ok(())
    }

    /// `return value`
    pub fn give(&mut self, value: Option<&'p Expression>) -> Compiled {
        let Some(value) = value else {
            self.leave(Size::NONE);
            return Ok(());
        };
        let mark = self.mark();
        let size = self.size(&value.ty);
        let to = Slot {
            scalar: 0,
            object: 0,
        };
        let from = if size != Size::SCALAR && matches!(value.kind, ExpressionKind::None) {
            self.into(value, to, true)?;
            to
        } else if is_located(value) || size.objects == 0 {
            self.value(value)?
        } else {
            let made = self.take(size)?;
            self.into(value, made, true)?;
            made
        };
        if size == Size::SCALAR {
            self.emit(Instruction::ReturnScalar {
                from: from.input(),
                until: Count(0),
            });
        } else {
            // Nothing is read after this, so that objects can be moved.
            self.move_value(to, from, size);
            self.leave(size);
        }
        self.release(mark);
        Ok(())
    }

    /// Ends the function, whose result is in its first registers.
    pub fn leave(&mut self, result: Size) {
        self.emit(Instruction::Return {
            keep: Count(result.objects as u8),
            until: Count(0),
        });
    }

    /// Ends a procedure whose end can be reached.
    pub fn end(&mut self) {
        debug_assert!(self.kind == FunctionKind::Procedure);
        if self.code.is_reached() {
            self.leave(Size::NONE);
        }
    }
}
