//! Writing to variables and to parts of them.
//!
//! Indices and keys on the way are computed first. Then the way is gone from the variable on: fields
//! lie within their record; an element of a list or a value of a map is read into registers, changed
//! there, and written back, the innermost first.

use alloc::vec::Vec;

use super::arithmetic::Left;
use super::body::{Body, Slot};
use super::location::{Location, state_operand};
use super::problem::Compiled;
use super::types::Size;
use crate::check::Method;
use crate::ir::{Expression, ExpressionKind, Operator, Place, Root, SharedId, Step, Type};
use crate::machine::Instruction;
use crate::machine::operand::{self, In, ObjectIn, ObjectInOut, ObjectOut, ObjectSlot};

/// What a step needs that was computed before the way is gone.
#[derive(Clone, Copy)]
enum Prepared {
    /// A step within registers.
    Nothing,
    /// The index of an element.
    Index(In),
    /// Registers for a key and its value, of which the key is there.
    Entry(Slot),
}

/// What is to be done when a part was changed.
enum WriteBack {
    List(ObjectInOut, In, Slot),
    Map(ObjectInOut, Slot, operand::Type),
    Object(ObjectSlot, Slot),
    Shared(SharedId, Slot),
}

/// A way that was gone.
struct Way<'p> {
    /// Where it led.
    at: Location,
    /// The type of what is there.
    ty: &'p Type,
    /// What is to be written back, the innermost last.
    back: Vec<WriteBack>,
}

impl<'p> Body<'_, 'p> {
    /// `place = value`
    pub fn assign(&mut self, place: &'p Place, value: &'p Expression) -> Compiled {
        if let Some(added) = self.grown(place, value) {
            return self.update(place, Operator::Add, added);
        }
        let mark = self.mark();
        let prepared = self.prepare(place)?;
        match (place.path.last(), prepared.last()) {
            (Some(Step::Key(key)), Some(Prepared::Entry(entry))) => {
                let at = entry.at(self.size(&key.ty));
                self.into(value, at, true)?;
                let (way, _) = self.go(place, &prepared, place.path.len() - 1)?;
                self.put_entry(way, *entry)?;
            }
            (Some(Step::Index(_)), Some(Prepared::Index(index))) => {
                let element = self.value(value)?;
                let (mut way, _) = self.go(place, &prepared, place.path.len() - 1)?;
                let list = self.container(&mut way)?;
                self.at(place.span, |body| {
                    body.emit(Instruction::ListSet {
                        list,
                        index: *index,
                        scalars: element.block(),
                        objects: element.objects(),
                    });
                });
                self.write_back(way.back)?;
            }
            _ => self.assign_part(place, &prepared, value)?,
        }
        self.release(mark);
        Ok(())
    }

    /// Writes a whole variable, or a field of what is on the way.
    fn assign_part(
        &mut self,
        place: &'p Place,
        prepared: &[Prepared],
        value: &'p Expression,
    ) -> Compiled {
        if let (Root::Local(local), true) = (&place.root, place.path.is_empty()) {
            let slot = self.local(*local)?;
            return self.into(value, slot, false);
        }
        if place.path.is_empty()
            && let Root::OwnElement(id) | Root::Shared(id) = &place.root
        {
            return self.at(place.span, |body| body.write_shared(*id, "write", value));
        }
        // Objects are moved into their place, so they must not be those of another variable.
        let size = self.size(&value.ty);
        let made = if size.objects == 0 {
            self.value(value)?
        } else {
            let made = self.take(size)?;
            self.into(value, made, true)?;
            made
        };
        let (way, ty) = self.go(place, prepared, place.path.len())?;
        self.at(place.span, |body| body.write(way.at, made, ty))?;
        self.write_back(way.back)
    }

    /// Moves a value to where it belongs.
    fn write(&mut self, at: Location, from: Slot, ty: &Type) -> Compiled {
        match at {
            Location::Registers(to) => {
                let size = self.size(ty);
                self.move_value(to, from, size);
                Ok(())
            }
            Location::State(to) => self.store(to, from, ty),
            Location::Other(..) => Err(self.broken()),
        }
    }

    /// What is added to a text or a list by `x = x + value`.
    fn grown(&self, place: &Place, value: &'p Expression) -> Option<&'p Expression> {
        let ExpressionKind::Binary {
            operator: Operator::Add,
            left,
            right,
        } = &value.kind
        else {
            return None;
        };
        let is_same = match (&place.root, &left.kind) {
            (Root::Local(local), ExpressionKind::Local(other)) => local == other,
            (Root::Variable(id), ExpressionKind::Variable(other)) => id == other,
            _ => false,
        };
        let grows = matches!(value.ty, Type::String | Type::List(_));
        (is_same && grows && place.path.is_empty()).then_some(right)
    }

    /// `place += value` and the like.
    pub fn update(
        &mut self,
        place: &'p Place,
        operator: Operator,
        value: &'p Expression,
    ) -> Compiled {
        let mark = self.mark();
        let prepared = self.prepare(place)?;
        let (mut way, ty) = self.go(place, &prepared, place.path.len())?;
        if matches!(ty, Type::String | Type::List(_)) {
            // What is added may be a part of the variable itself: it is read before that changes.
            let object = self.container(&mut way)?;
            self.append(object.0, value)?;
            self.write_back(way.back)?;
            self.release(mark);
            return Ok(());
        }
        match way.at {
            Location::Registers(slot) => {
                self.operate(operator, Left::Value(slot, ty), value, slot, false)?;
            }
            at => {
                let slot = self.value_at(at, ty)?;
                self.operate(operator, Left::Value(slot, ty), value, slot, false)?;
                self.at(place.span, |body| body.write(at, slot, ty))?;
            }
        }
        self.write_back(way.back)?;
        self.release(mark);
        Ok(())
    }

    /// A method that changes what it is called on.
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
        let (mut way, ty) = self.go(place, &prepared, place.path.len())?;
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
        self.emit(Instruction::JumpUnless {
            condition: found.input(),
            target: end.target(),
        });
        self.emit(Instruction::ListRemoveAt {
            list,
            index: found.at(Size::SCALAR).input(),
        });
        self.place(end);
        Ok(())
    }

    /// Computes the indices and keys of a way.
    fn prepare(&mut self, place: &'p Place) -> Compiled<Vec<Prepared>> {
        let mut ty = self.root_type(&place.root)?;
        let mut prepared = Vec::new();
        for step in &place.path {
            prepared.push(match step {
                Step::Field(_) | Step::Coordinate(_) => Prepared::Nothing,
                Step::Index(index) => Prepared::Index(self.value(index)?.input()),
                Step::Key(key) => {
                    let value = self.step_type(ty, step)?;
                    let size = self.size(&key.ty).plus(self.size(value));
                    let entry = self.take(size)?;
                    self.into(key, entry, true)?;
                    Prepared::Entry(entry)
                }
            });
            ty = self.step_type(ty, step)?;
        }
        Ok(prepared)
    }

    fn root_type(&self, root: &Root) -> Compiled<&'p Type> {
        let program = self.unit.program;
        Ok(match root {
            Root::Error => return Err(self.broken()),
            Root::Local(local) => &self.declared[local.index()].ty,
            Root::Variable(id) => &program[*id].ty,
            Root::OwnElement(id) | Root::Shared(id) => &program[*id].ty,
        })
    }

    fn step_type(&self, ty: &'p Type, step: &Step) -> Compiled<&'p Type> {
        match (step, ty) {
            (Step::Field(field), Type::Record(id)) => {
                let fields = &self.unit.program[*id].fields;
                let field = fields.get(*field as usize).ok_or_else(|| self.broken())?;
                Ok(&field.ty)
            }
            (Step::Coordinate(_), _) => Ok(&Type::Float),
            (Step::Index(_), Type::List(element)) => Ok(element),
            (Step::Key(_), Type::Map(_, value)) => Ok(value),
            _ => Err(self.broken()),
        }
    }

    /// Goes so many steps of the way; gives the type of what is there too.
    fn go(
        &mut self,
        place: &'p Place,
        prepared: &[Prepared],
        steps: usize,
    ) -> Compiled<(Way<'p>, &'p Type)> {
        let ty = self.root_type(&place.root)?;
        let mut way = Way {
            at: Location::State(Size::NONE),
            ty,
            back: Vec::new(),
        };
        way.at = match &place.root {
            Root::Local(local) => Location::Registers(self.local(*local)?),
            Root::Variable(id) => Location::State(self.unit.variable(*id)),
            Root::Shared(id) => {
                let slot = self.take_for(ty)?;
                self.at(place.span, |body| body.shared(*id, slot, ty, true))?;
                way.back.push(WriteBack::Shared(*id, slot));
                Location::Registers(slot)
            }
            Root::OwnElement(_) | Root::Error => return Err(self.broken()),
        };
        for (step, prepared) in place.path.iter().zip(prepared).take(steps) {
            let outer = core::mem::replace(&mut self.span, place.span);
            self.step(&mut way, step, *prepared)?;
            self.span = outer;
        }
        let ty = way.ty;
        Ok((way, ty))
    }

    fn step(&mut self, way: &mut Way<'p>, step: &Step, prepared: Prepared) -> Compiled {
        let next = self.step_type(way.ty, step)?;
        match (step, prepared) {
            (Step::Field(field), _) => {
                let offset = self.field_offset(way.ty, *field);
                way.at = way.at.at(offset);
            }
            (Step::Coordinate(axis), _) => {
                way.at = way.at.at(Size::new(u32::from(*axis), 0));
            }
            (Step::Index(_), Prepared::Index(index)) => {
                let list = self.container(way)?;
                let element = self.take_for(next)?;
                self.emit(Instruction::ListGet {
                    list: ObjectIn(list.0),
                    index,
                    scalars: element.block(),
                    objects: element.objects(),
                });
                way.back.push(WriteBack::List(list, index, element));
                way.at = Location::Registers(element);
            }
            (Step::Key(key), Prepared::Entry(entry)) => {
                let kind = self.object_type(way.ty)?;
                let map = self.container(way)?;
                let value = entry.at(self.size(&key.ty));
                self.emit(Instruction::MapAt {
                    map: ObjectIn(map.0),
                    scalars: entry.block(),
                    objects: entry.objects(),
                    to: value.block(),
                    to_objects: value.objects(),
                    kind,
                });
                way.back.push(WriteBack::Map(map, entry, kind));
                way.at = Location::Registers(value);
            }
            _ => return Err(self.broken()),
        }
        way.ty = next;
        Ok(())
    }

    /// The operand of the object that a way has come to. One that is out of reach is read, to be
    /// written back.
    fn container(&mut self, way: &mut Way<'p>) -> Compiled<ObjectInOut> {
        match way.at {
            Location::Registers(slot) => Ok(slot.object_in_out()),
            Location::State(start) => match state_operand(start.objects) {
                Some(operand) => Ok(ObjectInOut(operand)),
                None => {
                    let slot = self.take(Size::OBJECT)?;
                    self.emit(Instruction::LoadObject {
                        to: ObjectOut(slot.operand()),
                        variable: ObjectSlot(start.objects),
                    });
                    let variable = ObjectSlot(start.objects);
                    way.back.push(WriteBack::Object(variable, slot));
                    way.at = Location::Registers(slot);
                    Ok(slot.object_in_out())
                }
            },
            Location::Other(..) => Err(self.broken()),
        }
    }

    /// Puts a key and its value into the map that a way has come to.
    fn put_entry(&mut self, mut way: Way<'p>, entry: Slot) -> Compiled {
        let kind = self.object_type(way.ty)?;
        let map = self.container(&mut way)?;
        self.emit(Instruction::MapPut {
            map,
            scalars: entry.block(),
            objects: entry.objects(),
            kind,
        });
        self.write_back(way.back)
    }

    fn write_back(&mut self, back: Vec<WriteBack>) -> Compiled {
        for part in back.into_iter().rev() {
            match part {
                WriteBack::List(list, index, element) => self.emit(Instruction::ListSet {
                    list,
                    index,
                    scalars: element.block(),
                    objects: element.objects(),
                }),
                WriteBack::Map(map, entry, kind) => self.emit(Instruction::MapPut {
                    map,
                    scalars: entry.block(),
                    objects: entry.objects(),
                    kind,
                }),
                WriteBack::Object(variable, slot) => self.emit(Instruction::StoreObject {
                    variable,
                    from: slot.object_in_out(),
                }),
                WriteBack::Shared(id, slot) => self.write_back_shared(id, slot)?,
            }
        }
        Ok(())
    }
}
