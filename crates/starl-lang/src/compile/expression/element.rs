//! Elements of collections, and whether they are there.

use crate::compile::body::{Body, Slot};
use crate::compile::problem::Compiled;
use crate::compile::size::Size;
use crate::ir::{Expression, Type};
use crate::machine::Instruction;
use crate::machine::operand::{In, ObjectIn, Short};

impl<'p> Body<'_, 'p> {
    /// `list[index]`
    pub fn index(&mut self, base: &'p Expression, index: &'p Expression, to: Slot) -> Compiled {
        let list = self.object(base)?;
        let index = self.value(index)?.input();
        self.list_get(list, index, to);
        Ok(())
    }

    /// Reads an element of a list or set.
    pub fn list_get(&mut self, list: ObjectIn, index: In, to: Slot) {
        self.emit(Instruction::ListGet {
            list,
            index,
            scalars: to.block(),
            objects: to.objects(),
        });
    }

    /// How many elements or characters an object has, in a new register.
    pub fn object_size(&mut self, from: ObjectIn) -> Compiled<Slot> {
        let size = self.take(Size::SCALAR)?;
        self.emit(Instruction::Size {
            to: size.output(),
            from,
        });
        Ok(size)
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

    /// `item in collection`, except for ranges.
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
        self.list_get(from, index.input(), value);
        if **element != *ty {
            self.scalar(to, 1);
        }
        self.jump(end);
        self.place(none);
        self.zeros(to, ty)?;
        self.place(end);
        Ok(())
    }
}
