//! The path from a variable to a part of it, and back.
//!
//! Indices and keys on the path are computed first. Then the path is followed from the variable: fields lie within
//! their record; an element of a list or a value of a map is read into registers, changed there, and written back, the
//! innermost first.

use alloc::vec::Vec;

use crate::compile::body::{Body, Location, Slot, state_operand};
use crate::compile::problem::Compiled;
use crate::compile::size::Size;
use crate::ir::{Expression, ExpressionKind, Place, Root, SharedId, Step, Type};
use crate::machine::operand::{In, ObjectIn, ObjectInOut, ObjectOut, ObjectSlot};
use crate::machine::{Instruction, operand};

/// Values that a step needs, computed before the path is followed.
#[derive(Clone, Copy)]
pub(super) enum Prepared {
    /// A step within registers.
    Nothing,
    /// The index of an element.
    Index(In),
    /// Registers for a key and its value, of which the key is there.
    Entry(Slot),
}

/// A pending write after a part was changed.
pub(super) enum WriteBack {
    List(ObjectInOut, In, Slot),
    Map(ObjectInOut, Slot, operand::Type),
    Object(ObjectSlot, Slot),
    Shared(SharedId, Slot),
}

/// A path that was followed.
pub(super) struct Way<'p> {
    /// Where it led.
    pub at: Location,
    /// The type of the part.
    pub ty: &'p Type,
    /// The pending writes, the innermost last.
    pub back: Vec<WriteBack>,
}

impl<'p> Body<'_, 'p> {
    /// Computes the indices and keys of a way.
    pub(super) fn prepare(&mut self, place: &'p Place) -> Compiled<Vec<Prepared>> {
        self.prepare_some(place, place.path.len())
    }

    /// Computes the indices and keys of this number of steps of a way.
    pub(super) fn prepare_some(
        &mut self,
        place: &'p Place,
        steps: usize,
    ) -> Compiled<Vec<Prepared>> {
        let mut ty = self.root_type(&place.root)?;
        let mut prepared = Vec::new();
        for step in place.path.iter().take(steps) {
            prepared.push(match step {
                Step::Field(_) | Step::Coordinate(_) => Prepared::Nothing,
                Step::Index(index) => Prepared::Index(self.value(index)?.input()),
                Step::Key(key) => {
                    let value = self.size(self.step_type(ty, step)?);
                    Prepared::Entry(self.entry(key, value)?)
                }
            });
            ty = self.step_type(ty, step)?;
        }
        Ok(prepared)
    }

    /// Registers for a key and a value of this size. The key is there.
    fn entry(&mut self, key: &'p Expression, value: Size) -> Compiled<Slot> {
        let size = self.size(&key.ty);
        // A text in a variable can stay where it is, as no object has to come after it.
        if let (ExpressionKind::Local(local), Size::OBJECT, 0) = (&key.kind, size, value.objects) {
            let Slot { object, .. } = self.local(*local)?;
            let Slot { scalar, .. } = self.take(value)?;
            return Ok(Slot { scalar, object });
        }
        let entry = self.take(size.plus(value))?;
        self.into(key, entry, true)?;
        Ok(entry)
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

    /// Follows this number of steps of the path; returns the type of the part too. If `adds`, a missing key at the end
    /// has the default value of its type.
    pub(super) fn go(
        &mut self,
        place: &'p Place,
        prepared: &[Prepared],
        steps: usize,
        adds: bool,
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
                self.at(place.span, |body| body.shared(*id, None, slot, ty, true))?;
                way.back.push(WriteBack::Shared(*id, slot));
                Location::Registers(slot)
            }
            Root::OwnElement(_) | Root::Error => return Err(self.broken()),
        };
        let path = place.path.iter().zip(prepared).take(steps);
        for (number, (step, prepared)) in path.enumerate() {
            let outer = core::mem::replace(&mut self.span, place.span);
            let adds = adds && number + 1 == steps;
            self.step(&mut way, step, *prepared, adds)?;
            self.span = outer;
        }
        let ty = way.ty;
        Ok((way, ty))
    }

    fn step(&mut self, way: &mut Way<'p>, step: &Step, prepared: Prepared, adds: bool) -> Compiled {
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
                self.list_get(ObjectIn(list.0), index, element);
                way.back.push(WriteBack::List(list, index, element));
                way.at = Location::Registers(element);
            }
            (Step::Key(key), Prepared::Entry(entry)) => {
                let kind = self.object_type(way.ty)?;
                let map = self.container(way)?;
                let value = entry.at(self.size(&key.ty));
                if adds {
                    self.value_or_default(ObjectIn(map.0), entry, value, next, kind)?;
                } else {
                    self.emit(Instruction::MapAt {
                        map: ObjectIn(map.0),
                        scalars: entry.block(),
                        objects: entry.objects(),
                        to: value.block(),
                        to_objects: value.objects(),
                        kind,
                    });
                }
                way.back.push(WriteBack::Map(map, entry, kind));
                way.at = Location::Registers(value);
            }
            _ => return Err(self.broken()),
        }
        way.ty = next;
        Ok(())
    }

    /// The value of a key, or zero: the default value of each type to which something can be added.
    fn value_or_default(
        &mut self,
        map: ObjectIn,
        key: Slot,
        to: Slot,
        ty: &Type,
        kind: operand::Type,
    ) -> Compiled {
        let mark = self.mark();
        let size = self.size(ty);
        let optional = self.take(Size::SCALAR.plus(size))?;
        self.look_up(map, key, optional, kind);
        self.move_value(to, optional.at(Size::SCALAR), size);
        self.release(mark);
        Ok(())
    }

    /// The operand of the object at the end of a path. An object without an operand is read, and written back later.
    pub(super) fn container(&mut self, way: &mut Way<'p>) -> Compiled<ObjectInOut> {
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

    pub(super) fn write_back(&mut self, back: Vec<WriteBack>) -> Compiled {
        for part in back.into_iter().rev() {
            match part {
                WriteBack::List(list, index, element) => self.emit(Instruction::ListSet {
                    list,
                    index,
                    scalars: element.block(),
                    objects: element.objects(),
                }),
                WriteBack::Map(map, entry, kind) => self.map_put(map, entry, kind),
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
