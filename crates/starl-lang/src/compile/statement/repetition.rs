//! Running over collections.

use crate::compile::body::{Body, Slot};
use crate::compile::code::Label;
use crate::compile::constant::folded;
use crate::compile::expression::is_located;
use crate::compile::problem::Compiled;
use crate::compile::size::Size;
use crate::ir::{Expression, ExpressionKind, LoopVariables, Type};
use crate::machine::Instruction;
use crate::machine::operand::{In, ObjectIn, Short};

impl<'p> Body<'_, 'p> {
    /// Runs code for each element of a collection; `may_change` says whether that code may change the
    /// variable that it is.
    pub fn for_each(
        &mut self,
        collection: &'p Expression,
        variables: LoopVariables,
        may_change: bool,
        run: impl FnOnce(&mut Self) -> Compiled,
    ) -> Compiled {
        let mark = self.mark();
        match (&collection.kind, &collection.ty) {
            (ExpressionKind::Range { start, end }, _) => {
                self.for_range(start, end, variables, may_change, run)?;
            }
            (_, Type::Map(key, value)) => {
                self.for_map(collection, [key, value], variables, may_change, run)?;
            }
            _ => {
                let LoopVariables::One(local) = variables else {
                    return Err(self.broken());
                };
                let (object, copy) = self.kept(collection, may_change)?;
                let element = match local {
                    Some(local) => Some(self.declare(local)?),
                    None => None,
                };
                self.run_over(object, element, run)?;
                self.forget(copy, &collection.ty)?;
            }
        }
        self.release(mark);
        Ok(())
    }

    /// A collection that stays as it is while it is run over; the copy, if one had to be made.
    fn kept(
        &mut self,
        collection: &'p Expression,
        may_change: bool,
    ) -> Compiled<(ObjectIn, Option<Slot>)> {
        if is_located(collection) && !may_change {
            return Ok((self.object(collection)?, None));
        }
        let slot = self.take(Size::OBJECT)?;
        self.into(collection, slot, true)?;
        Ok((slot.object_in(), Some(slot)))
    }

    /// Lets go of a copy, so that its original can be changed without copying it.
    fn forget(&mut self, copy: Option<Slot>, ty: &Type) -> Compiled {
        match copy {
            Some(copy) => self.clear(copy, ty),
            None => Ok(()),
        }
    }

    fn for_range(
        &mut self,
        start: &'p Expression,
        end: &'p Expression,
        variables: LoopVariables,
        may_change: bool,
        run: impl FnOnce(&mut Self) -> Compiled,
    ) -> Compiled {
        let LoopVariables::One(local) = variables else {
            return Err(self.broken());
        };
        let counter = match local {
            Some(local) => self.declare(local)?,
            None => self.take(Size::SCALAR)?,
        };
        self.into(start, counter, true)?;
        let limit = if may_change && is_located(end) {
            let limit = self.take(Size::SCALAR)?;
            self.into(end, limit, true)?;
            limit
        } else {
            self.value(end)?
        };
        let (over, again) = (self.label(), self.label());
        let known = (
            folded(&self.unit.known, start),
            folded(&self.unit.known, end),
        );
        let is_entered = matches!(known, (Some(start), Some(end)) if (start as i64) < end as i64);
        if !is_entered {
            self.emit(Instruction::JumpIfLessEqual {
                left: limit.input(),
                right: counter.input(),
                target: over.target(),
            });
        }
        self.place(again);
        run(self)?;
        self.repeat(counter, limit.input(), again);
        self.place(over);
        Ok(())
    }

    fn repeat(&mut self, counter: Slot, limit: In, again: Label) {
        self.emit(Instruction::Loop {
            counter: crate::machine::operand::InOut(counter.output().0),
            limit,
            target: again.target(),
        });
    }

    /// Runs code for each element of a list or set that does not change meanwhile.
    pub fn run_over(
        &mut self,
        object: ObjectIn,
        element: Option<Slot>,
        run: impl FnOnce(&mut Self) -> Compiled,
    ) -> Compiled {
        self.run_with(object, run, |index| {
            element.map(|element| Instruction::ListGet {
                list: object,
                index,
                scalars: element.block(),
                objects: element.objects(),
            })
        })
    }

    /// Counts through an object; `get` makes the instruction that reads what is at an index.
    fn run_with(
        &mut self,
        object: ObjectIn,
        run: impl FnOnce(&mut Self) -> Compiled,
        get: impl FnOnce(In) -> Option<Instruction>,
    ) -> Compiled {
        let (counter, limit) = (self.take(Size::SCALAR)?, self.take(Size::SCALAR)?);
        let over = self.label();
        self.emit(Instruction::Size {
            to: limit.output(),
            from: object,
        });
        self.emit(Instruction::JumpIfLessConstant {
            left: limit.input(),
            right: Short(1),
            target: over.target(),
        });
        self.scalar(counter, 0);
        let again = self.code.here();
        if let Some(instruction) = get(counter.input()) {
            self.emit(instruction);
        }
        run(self)?;
        self.repeat(counter, limit.input(), again);
        self.place(over);
        Ok(())
    }

    fn for_map(
        &mut self,
        collection: &'p Expression,
        [key, value]: [&Type; 2],
        variables: LoopVariables,
        may_change: bool,
        run: impl FnOnce(&mut Self) -> Compiled,
    ) -> Compiled {
        let (first, second) = match variables {
            LoopVariables::One(first) => (first, None),
            LoopVariables::Two(first, second) => (first, second),
        };
        let (object, copy) = match second {
            Some(_) => self.kept(collection, may_change)?,
            None => {
                // The keys alone: a set of its own, that shares what the map holds.
                let keys = self.take(Size::OBJECT)?;
                let map = self.object(collection)?;
                let kind = self.object_type(&Type::set(key.clone()))?;
                self.emit(Instruction::MapKeys {
                    to: keys.object_out(),
                    map,
                    kind,
                });
                (keys.object_in(), Some(keys))
            }
        };
        let Some(second) = second else {
            let element = match first {
                Some(local) => Some(self.declare(local)?),
                None => None,
            };
            self.run_over(object, element, run)?;
            return self.forget(copy, &Type::set(key.clone()));
        };
        let sizes = [self.size(key), self.size(value)];
        let entry = self.take(sizes[0].plus(sizes[1]))?;
        if let Some(first) = first {
            self.bind(first, entry);
        }
        self.bind(second, entry.at(sizes[0]));
        self.run_with(object, run, |index| {
            Some(Instruction::MapEntry {
                map: object,
                index,
                scalars: entry.block(),
                objects: entry.objects(),
            })
        })?;
        self.forget(copy, &collection.ty)
    }
}
