//! Methods that change their receivers.

use alloc::vec::Vec;

use crate::check::Method;
use crate::compile::body::{Body, Slot};
use crate::compile::problem::Compiled;
use crate::compile::size::Size;
use crate::ir::{Expression, Place, Type};
use crate::machine::Instruction;
use crate::machine::operand::{ObjectIn, ObjectInOut};

impl<'p> Body<'_, 'p> {
    /// A method that changes its receiver.
    pub fn change(
        &mut self,
        place: &'p Place,
        method: Method,
        arguments: &'p [Expression],
    ) -> Compiled {
        let mark = self.mark();
        let prepared = self.prepare(place)?;
        let values: Vec<Slot> = (arguments.iter())
            .map(|argument| self.value(argument))
            .collect::<Compiled<_>>()?;
        let (mut way, ty) = self.go(place, &prepared, place.path.len(), method.adds())?;
        let object = self.container(&mut way)?;
        self.change_object(object, ty, method, &values)?;
        self.write_back(way.back)?;
        self.release(mark);
        Ok(())
    }

    fn change_object(
        &mut self,
        object: ObjectInOut,
        ty: &Type,
        method: Method,
        values: &[Slot],
    ) -> Compiled {
        let kind = self.object_type(ty)?;
        let Some(first) = values.first() else {
            return Err(self.broken());
        };
        let last = values.last().unwrap_or(first);
        let (scalars, objects) = (last.block(), last.objects());
        let instruction = match method {
            Method::ListAdd => Instruction::ListAdd {
                list: object,
                scalars,
                objects,
                kind,
            },
            Method::ListInsert => Instruction::ListInsert {
                list: object,
                index: first.input(),
                scalars,
                objects,
                kind,
            },
            Method::ListRemoveAt => Instruction::ListRemoveAt {
                list: object,
                index: first.input(),
            },
            Method::ListRemove => return self.remove_first(object, ty, *first),
            Method::SetAdd => Instruction::SetAdd {
                set: object,
                scalars,
                objects,
                kind,
            },
            Method::SetRemove => Instruction::SetRemove {
                set: object,
                scalars,
                objects,
                kind,
            },
            Method::MapRemove => Instruction::MapRemove {
                map: object,
                scalars,
                objects,
                kind,
            },
            _ => return Err(self.broken()),
        };
        self.emit(instruction);
        Ok(())
    }

    /// Removes the first element that is equal, if there is one.
    fn remove_first(&mut self, list: ObjectInOut, ty: &Type, item: Slot) -> Compiled {
        let found = self.take(Size::new(2, 0))?;
        self.find(ObjectIn(list.0), ty, item, found)?;
        let end = self.label();
        self.jump_on(found, false, end);
        self.emit(Instruction::ListRemoveAt {
            list,
            index: found.at(Size::SCALAR).input(),
        });
        self.place(end);
        Ok(())
    }
}
