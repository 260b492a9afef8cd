//! Collections: literals and comprehensions.

use crate::compile::body::{Body, Slot};
use crate::compile::problem::Compiled;
use crate::compile::size::Size;
use crate::ir::{Comprehension, Element, Expression, Type};
use crate::machine::operand::ObjectInOut;
use crate::machine::{Instruction, operand};

impl<'p> Body<'_, 'p> {
    pub fn clear(&mut self, to: Slot, ty: &Type) -> Compiled {
        let kind = self.object_type(ty)?;
        self.emit(Instruction::ClearObject {
            to: to.object_out(),
            kind,
        });
        Ok(())
    }

    /// `[a, b]` or `{a, b}`
    pub fn list(&mut self, elements: &'p [Expression], ty: &'p Type, to: Slot) -> Compiled {
        self.clear(to, ty)?;
        elements
            .iter()
            .try_for_each(|element| self.add(to, ty, element))
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
        self.map_put(to.object_in_out(), entry, kind);
        self.release(mark);
        Ok(())
    }

    /// Puts an entry, a key and its value in registers, into a map.
    pub fn map_put(&mut self, map: ObjectInOut, entry: Slot, kind: operand::Type) {
        self.emit(Instruction::MapPut {
            map,
            scalars: entry.block(),
            objects: entry.objects(),
            kind,
        });
    }

    /// `[f(x) for x in xs if c by k]`
    pub fn comprehension(&mut self, made: &'p Comprehension, ty: &'p Type, to: Slot) -> Compiled {
        let Some(key) = &made.key else {
            return self.collect(made, ty, to, None);
        };
        let of_keys = Type::list(key.ty.clone());
        let keys = self.take(Size::OBJECT)?;
        self.clear(keys, &of_keys)?;
        self.collect(made, ty, to, Some((key, keys, &of_keys)))?;
        let kind = self.object_type(&of_keys)?;
        self.emit(Instruction::ListSortBy {
            list: to.object_in_out(),
            keys: keys.object_in(),
            kind,
        });
        Ok(())
    }

    /// `min(f(x) for x in xs if c by k)` or `max`: keeps the best element so far, so that no list is made.
    pub fn best(
        &mut self,
        made: &'p Comprehension,
        is_greatest: bool,
        ty: &'p Type,
        to: Slot,
    ) -> Compiled {
        let Element::One(element) = &made.element else {
            return Err(self.broken());
        };
        let key = made.key.as_ref().unwrap_or(element);
        let kind = self.object_type(&Type::list(key.ty.clone()))?;
        let (size, key_size) = (self.size(&element.ty), self.size(&key.ty));
        let is_found = self.take(Size::SCALAR)?;
        self.scalar(is_found, 0);
        let best = self.take(size)?;
        self.zeros(best, &element.ty)?;
        let best_key = match made.key {
            Some(_) => {
                let slot = self.take(key_size)?;
                self.zeros(slot, &key.ty)?;
                slot
            }
            None => best,
        };
        self.for_each(&made.collection, made.variables, false, |body| {
            let (next, found) = (body.label(), body.label());
            if let Some(condition) = &made.condition {
                body.branch(condition, false, next)?;
            }
            let mark = body.mark();
            let value = body.value(element)?;
            let of_value = match &made.key {
                Some(key) => body.value(key)?,
                None => value,
            };
            body.jump_on(is_found, false, found);
            let is_better = body.take(Size::SCALAR)?;
            let (left, right) = match is_greatest {
                true => (best_key, of_value),
                false => (of_value, best_key),
            };
            body.emit(Instruction::LessElement {
                to: is_better.output(),
                scalars: left.block(),
                objects: left.objects(),
                other: right.block(),
                other_objects: right.objects(),
                kind,
            });
            body.jump_on(is_better, false, next);
            body.place(found);
            body.copy(best, value, size);
            if made.key.is_some() {
                body.copy(best_key, of_value, key_size);
            }
            body.scalar(is_found, 1);
            body.release(mark);
            body.place(next);
            Ok(())
        })?;
        // An element that may be none itself is the value.
        if element.ty == *ty {
            self.move_value(to, best, size);
            return Ok(());
        }
        self.copy(to, is_found, Size::SCALAR);
        self.move_value(to.at(Size::SCALAR), best, size);
        Ok(())
    }

    /// The elements in the order of the source, and the list of their keys.
    fn collect(
        &mut self,
        made: &'p Comprehension,
        ty: &'p Type,
        to: Slot,
        keys: Option<(&'p Expression, Slot, &Type)>,
    ) -> Compiled {
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
            if let Some((key, keys, of_keys)) = keys {
                body.add(keys, of_keys, key)?;
            }
            body.place(next);
            Ok(())
        })
    }
}
