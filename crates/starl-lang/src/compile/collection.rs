//! Collections: literals, comprehensions, elements, and running over them.

use super::body::{Body, Slot};
use super::constant::folded;
use super::expression::is_located;
use super::problem::Compiled;
use super::types::Size;
use crate::ir::{Comprehension, Element, Expression, ExpressionKind, LoopVariables, Type};
use crate::machine::Instruction;
use crate::machine::operand::{In, ObjectIn, Short};

impl<'p> Body<'_, 'p> {
    fn clear(&mut self, to: Slot, ty: &Type) -> Compiled {
        let kind = self.object_type(ty)?;
        self.emit(Instruction::ClearObject {
            to: to.object_out(),
            kind,
        });
        Ok(())
    }

    /// `[a, b]`
    pub fn list(&mut self, elements: &'p [Expression], ty: &'p Type, to: Slot) -> Compiled {
        self.clear(to, ty)?;
        elements
            .iter()
            .try_for_each(|element| self.add(to, ty, element))
    }

    /// `{a, b}`
    pub fn set(&mut self, elements: &'p [Expression], ty: &'p Type, to: Slot) -> Compiled {
        self.list(elements, ty, to)
    }

    /// `{k: v}`
    pub fn map(
        &mut self,
        entries: &'p [(Expression, Expression)],
        ty: &'p Type,
        to: Slot,
    ) -> Compiled {
        self.clear(to, ty)?;
        (entries.iter()).try_for_each(|(key, value)| self.put(to, ty, key, value))
    }

    /// Adds an element to a list or set in a register.
    fn add(&mut self, to: Slot, ty: &Type, element: &'p Expression) -> Compiled {
        let mark = self.mark();
        let slot = self.value(element)?;
        let kind = self.object_type(ty)?;
        let (scalars, objects) = (slot.block(), slot.objects());
        self.emit(match ty {
            Type::Set(_) => Instruction::SetAdd {
                set: to.object_in_out(),
                scalars,
                objects,
                kind,
            },
            _ => Instruction::ListAdd {
                list: to.object_in_out(),
                scalars,
                objects,
                kind,
            },
        });
        self.release(mark);
        Ok(())
    }

    /// Puts an entry into a map in a register.
    fn put(&mut self, to: Slot, ty: &Type, key: &'p Expression, value: &'p Expression) -> Compiled {
        let mark = self.mark();
        let entry = self.row(&[key, value])?;
        let kind = self.object_type(ty)?;
        self.emit(Instruction::MapPut {
            map: to.object_in_out(),
            scalars: entry.block(),
            objects: entry.objects(),
            kind,
        });
        self.release(mark);
        Ok(())
    }

    /// `[f(x) for x in xs if c]`
    pub fn comprehension(&mut self, made: &'p Comprehension, ty: &'p Type, to: Slot) -> Compiled {
        self.clear(to, ty)?;
        self.for_each(&made.collection, made.variables, false, |body| {
            let next = body.label();
            if let Some(condition) = &made.condition {
                body.branch(condition, false, next)?;
            }
            match &made.element {
                Element::One(element) => body.add(to, ty, element)?,
                Element::Entry(key, value) => body.put(to, ty, key, value)?,
            }
            body.place(next);
            Ok(())
        })
    }

    /// `list[index]`
    pub fn index(&mut self, base: &'p Expression, index: &'p Expression, to: Slot) -> Compiled {
        let list = self.object(base)?;
        let index = self.value(index)?.input();
        self.emit(Instruction::ListGet {
            list,
            index,
            scalars: to.block(),
            objects: to.objects(),
        });
        Ok(())
    }

    /// `map[key]`
    pub fn lookup(&mut self, base: &'p Expression, key: &'p Expression, to: Slot) -> Compiled {
        let map = self.object(base)?;
        let key = self.value(key)?;
        let kind = self.object_type(&base.ty)?;
        self.emit(Instruction::MapAt {
            map,
            scalars: key.block(),
            objects: key.objects(),
            to: to.block(),
            to_objects: to.objects(),
            kind,
        });
        Ok(())
    }

    /// `item in collection`, for all but ranges.
    pub fn contained(
        &mut self,
        item: &'p Expression,
        collection: &'p Expression,
        to: Slot,
    ) -> Compiled {
        if collection.ty == Type::String {
            let part = self.object(item)?;
            let text = self.object(collection)?;
            self.emit(Instruction::ContainsText {
                to: to.output(),
                text,
                part,
            });
            return Ok(());
        }
        let item = self.value(item)?;
        let collection_in = self.object(collection)?;
        self.contains(collection_in, &collection.ty, item, to)
    }

    /// Whether a list, set or map has an element or a key.
    pub fn contains(&mut self, object: ObjectIn, ty: &Type, item: Slot, to: Slot) -> Compiled {
        let kind = self.object_type(ty)?;
        let (scalars, objects) = (item.block(), item.objects());
        let output = to.output();
        match ty {
            Type::Set(_) => self.emit(Instruction::SetContains {
                to: output,
                set: object,
                scalars,
                objects,
                kind,
            }),
            Type::Map(..) => self.emit(Instruction::MapContains {
                to: output,
                map: object,
                scalars,
                objects,
                kind,
            }),
            _ => {
                let found = self.take(Size::new(2, 0))?;
                self.find(object, ty, item, found)?;
                self.copy(to, found, Size::SCALAR);
            }
        }
        Ok(())
    }

    /// Where in a list an element is, as an optional Int.
    pub fn find(&mut self, list: ObjectIn, ty: &Type, item: Slot, to: Slot) -> Compiled {
        let kind = self.object_type(ty)?;
        self.emit(Instruction::ListFind {
            to: crate::machine::operand::PairOut(to.output().0),
            list,
            scalars: item.block(),
            objects: item.objects(),
            kind,
        });
        Ok(())
    }

    /// An element of a list or set of this size, or none if it is empty; `at` says which.
    pub fn element_or_none(
        &mut self,
        from: ObjectIn,
        size: Slot,
        collection: &Type,
        ty: &Type,
        to: Slot,
        at: impl FnOnce(&mut Self, Slot) -> Compiled,
    ) -> Compiled {
        let (Type::List(element) | Type::Set(element)) = collection else {
            return Err(self.broken());
        };
        let (none, end) = (self.label(), self.label());
        self.emit(Instruction::JumpIfLessConstant {
            left: size.input(),
            right: Short(1),
            target: none.target(),
        });
        // An element that may be none itself is the value.
        let value = match **element == *ty {
            true => to,
            false => to.at(Size::SCALAR),
        };
        let index = self.take(Size::SCALAR)?;
        at(self, index)?;
        self.emit(Instruction::ListGet {
            list: from,
            index: index.input(),
            scalars: value.block(),
            objects: value.objects(),
        });
        if **element != *ty {
            self.scalar(to, 1);
        }
        self.jump(end);
        self.place(none);
        self.zeros(to, ty)?;
        self.place(end);
        Ok(())
    }

    // Loops.

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
        let known = (folded(self.unit, start), folded(self.unit, end));
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

    fn repeat(&mut self, counter: Slot, limit: In, again: super::code::Label) {
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
