//! The rules of instructions on lists, sets and maps.

use super::flow::{Broken, Context};
use super::rules::{WRONG_TYPE, same};
use crate::machine::instruction::Instruction;
use crate::machine::operand::{ObjectIn, ObjectInOut};
use crate::machine::types::{Layout, ObjectType, Order, Parts, Type};

impl Context<'_> {
    pub fn particular_to_collections(&mut self, instruction: &Instruction) -> Result<(), Broken> {
        use Instruction::*;
        match *instruction {
            ListGet {
                list,
                scalars,
                objects,
                ..
            } => {
                let parts = match self.kind(self.object(list.0)?)? {
                    ObjectType::List(_) | ObjectType::Set(_) => self.parts(self.object(list.0)?)?,
                    _ => return Err(WRONG_TYPE),
                };
                self.writes_block(scalars.0, objects.0, &parts.element)
            }
            ListSet {
                list,
                scalars,
                objects,
                ..
            } => {
                let parts = self.list_parts(self.object(list.0)?)?;
                self.reads_block(scalars.0, objects.0, &parts.element)
            }
            ListAdd {
                list: ObjectInOut(list),
                scalars,
                objects,
                kind,
            }
            | ListInsert {
                list: ObjectInOut(list),
                scalars,
                objects,
                kind,
                ..
            }
            | ListFind {
                list: ObjectIn(list),
                scalars,
                objects,
                kind,
                ..
            } => {
                same(self.object(list)?, kind.0)?;
                let parts = self.list_parts(kind.0)?;
                self.reads_block(scalars.0, objects.0, &parts.element)
            }
            LessElement {
                scalars,
                objects,
                other,
                other_objects,
                kind,
                ..
            } => {
                let parts = self.list_parts(kind.0)?;
                self.reads_block(scalars.0, objects.0, &parts.element)?;
                self.reads_block(other.0, other_objects.0, &parts.element)
            }
            ListRemoveAt { list, .. } | ListReverse { list } | ListSlice { list, .. } => {
                self.list_parts(self.object(list.0)?).map(|_| ())
            }
            ListAppend { list, from } => {
                let kind = self.object(list.0)?;
                self.list_parts(kind)?;
                same(kind, self.object(from.0)?)
            }
            ListSort { list, kind } => {
                same(self.object(list.0)?, kind.0)?;
                self.list_parts(kind.0).map(|_| ())
            }
            ListSortBy { list, keys, kind } => {
                self.list_parts(self.object(list.0)?)?;
                same(self.object(keys.0)?, kind.0)?;
                self.list_parts(kind.0).map(|_| ())
            }
            SumInt { list, .. } => self.is(list.0, &ObjectType::List(Type::Int)),
            SumFloat { list, .. } => self.is(list.0, &ObjectType::List(Type::Float)),
            ListOfSet { to, set, kind } => {
                let from = self.object(set.0)?;
                self.alike(self.set_parts(from)?, self.list_parts(kind.0)?)?;
                self.write_object(to.0, kind.0)
            }
            SetOfList { to, list, kind } => {
                let from = self.object(list.0)?;
                self.alike(self.list_parts(from)?, self.set_parts(kind.0)?)?;
                self.write_object(to.0, kind.0)
            }
            SetAdd {
                set: ObjectInOut(set),
                scalars,
                objects,
                kind,
            }
            | SetRemove {
                set: ObjectInOut(set),
                scalars,
                objects,
                kind,
            }
            | SetContains {
                set: ObjectIn(set),
                scalars,
                objects,
                kind,
                ..
            } => {
                same(self.object(set)?, kind.0)?;
                let parts = self.set_parts(kind.0)?;
                self.reads_block(scalars.0, objects.0, &parts.element)
            }
            SetUnite { set, from, kind }
            | SetIntersect { set, from, kind }
            | SetSubtract { set, from, kind } => {
                same(self.object(set.0)?, kind.0)?;
                same(self.object(from.0)?, kind.0)?;
                self.set_parts(kind.0).map(|_| ())
            }
            _ => self.particular_to_maps(instruction),
        }
    }

    fn particular_to_maps(&mut self, instruction: &Instruction) -> Result<(), Broken> {
        use Instruction::*;
        match *instruction {
            MapPut {
                map,
                scalars,
                objects,
                kind,
            } => {
                let parts = self.map_parts(map.0, kind.0)?;
                let entry = entry(parts);
                self.reads_block(scalars.0, objects.0, &entry)
            }
            MapAdd {
                map,
                scalars,
                objects,
                kind,
                ..
            }
            | MapAddConstant {
                map,
                scalars,
                objects,
                kind,
                ..
            } => {
                let parts = self.map_parts(map.0, kind.0)?;
                if (&parts.value.scalars[..], &parts.value.objects[..]) != (&[Order::Integer], &[])
                {
                    return Err("the values of the map are not whole numbers");
                }
                self.reads_block(scalars.0, objects.0, &parts.element)
            }
            MapGet {
                map,
                scalars,
                objects,
                to,
                to_objects,
                kind,
            } => {
                let parts = self.map_parts(map.0, kind.0)?;
                self.reads_block(scalars.0, objects.0, &parts.element)?;
                self.writes(to.0, 1)?;
                let value = to.0.checked_add(1);
                let value = value.ok_or("a register is beyond those that the function has")?;
                self.writes_block(value, to_objects.0, &parts.value)
            }
            MapAt {
                map,
                scalars,
                objects,
                to,
                to_objects,
                kind,
            } => {
                let parts = self.map_parts(map.0, kind.0)?;
                self.reads_block(scalars.0, objects.0, &parts.element)?;
                self.writes_block(to.0, to_objects.0, &parts.value)
            }
            MapContains {
                map: ObjectIn(map),
                scalars,
                objects,
                kind,
                ..
            }
            | MapRemove {
                map: ObjectInOut(map),
                scalars,
                objects,
                kind,
            } => {
                let parts = self.map_parts(map, kind.0)?;
                self.reads_block(scalars.0, objects.0, &parts.element)
            }
            MapEntry {
                map,
                scalars,
                objects,
                ..
            } => {
                let kind = self.object(map.0)?;
                let parts = self.map_parts(map.0, kind)?;
                self.writes_block(scalars.0, objects.0, &entry(parts))
            }
            MapKeys { to, map, kind } => {
                let keys = &self.map_parts(map.0, self.object(map.0)?)?.element;
                if self.set_parts(kind.0)?.element != *keys {
                    return Err(WRONG_TYPE);
                }
                self.write_object(to.0, kind.0)
            }
            MapValues { to, map, kind } => {
                let values = &self.map_parts(map.0, self.object(map.0)?)?.value;
                if self.list_parts(kind.0)?.element != *values {
                    return Err(WRONG_TYPE);
                }
                self.write_object(to.0, kind.0)
            }
            _ => Ok(()), // its operands say it all
        }
    }
}

/// The layout of a key followed by its value.
fn entry(parts: &Parts) -> Layout {
    let mut entry = parts.element.clone();
    entry.scalars.extend_from_slice(&parts.value.scalars);
    entry.objects.extend_from_slice(&parts.value.objects);
    entry
}
