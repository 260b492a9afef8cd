//! Instructions on objects: which method executes which, and those that all objects share.

use crate::machine::error::Fault;
use crate::machine::host::HostCall;
use crate::machine::instruction::Instruction;
use crate::machine::interpreter::scalar::unknown_robot;
use crate::machine::interpreter::view::{View, shift};
use crate::machine::operand::{
    Block, ImportIndex, In, ObjectBlock, ObjectIn, ObjectOut, ObjectSlot, Out,
};
use crate::machine::value::object::{Map, Object};
use core::cmp::Ordering;
use starl_core::{Area, ConvexPolygon, Point, RobotId};

/// Executes an instruction: one in the table by a method, which takes the operands with these names, any other one by an
/// arm behind `else`.
macro_rules! by_method {
    ($view:ident, $instruction:ident {
        $($name:ident => $method:ident($($operand:ident),*),)*
    } else {
        $($arms:tt)*
    }) => {
        match $instruction {
            $($name { $($operand,)* .. } => $view.$method($($operand),*),)*
            $($arms)*
        }
    };
}

impl View<'_> {
    /// Executes an instruction on objects or a call of the host; returns the cost beyond one.
    pub fn execute(&mut self, instruction: Instruction) -> Result<u64, Fault> {
        use Instruction::*;
        by_method! {
            self, instruction {
                CallHost => call_host(scalars, objects, import),
                LoadOtherObject => load_other(to, robot, variable),
                Size => size(to, from),

                Text => text(to, constant),
                AppendText => append_text(text, from),
                AppendScalar => append_scalar(text, from, format),
                AppendPoint => append_point(text, from),
                AppendVariant => append_variant(text, from, of),
                AppendObject => append_object(text, from, kind),
                AppendQuoted => append_quoted(text, from),
                ContainsText => contains_text(to, text, part),
                SplitText => split_text(to, text, separator),
                MatchText => match_text(to, text, part, end),
                ChangeText => change_text(to, text, change),
                ReplaceText => replace_text(to, text, part, by),
                JoinTexts => join_texts(to, list, separator),
                NumberOfText => number_of_text(to, text, format),

                ListGet => list_get(list, index, scalars, objects),
                ListSet => list_set(list, index, scalars, objects),
                ListAdd => list_add(list, scalars, objects, kind),
                ListInsert => list_insert(list, index, scalars, objects, kind),
                ListRemoveAt => list_remove_at(list, index),
                ListFind => list_find(to, list, scalars, objects, kind),
                ListAppend => list_append(list, from),
                ListReverse => list_reverse(list),
                ListSort => list_sort(list, kind),
                ListSortBy => list_sort_by(list, keys, kind),
                ListSlice => list_slice(list, first, last),
                SumInt => sum_int(to, list),
                SumFloat => sum_float(to, list),
                SetOfList => set_of_list(to, list, kind),

                SetAdd => set_add(set, scalars, objects, kind),
                SetRemove => set_remove(set, scalars, objects, kind),
                SetContains => set_contains(to, set, scalars, objects, kind),

                MapPut => map_put(map, scalars, objects, kind),
                MapContains => map_contains(to, map, scalars, objects, kind),
                MapRemove => map_remove(map, scalars, objects, kind),
                MapEntry => map_entry(map, index, scalars, objects),

                Polygon => polygon(to, corners),
            } else {
                CopyObject { to, from } => {
                    let object = self.read(from)?.clone();
                    self.share(to, object)
                }
                MoveObject { to, from } => {
                    let object = core::mem::take(self.place(from.0)?);
                    *self.place(to.0)? = object;
                    Ok(0)
                }
                ClearObject { to, .. } => {
                    *self.place(to.0)? = Object::EMPTY;
                    Ok(0)
                }
                LoadObject { to, variable } => {
                    let object = self.state.get(variable.0 as usize).cloned();
                    self.share(to, object.ok_or(Fault::Malformed)?)
                }
                StoreObject { variable, from } => {
                    let object = core::mem::take(self.place(from.0)?);
                    let place = self.state.get_mut(variable.0 as usize);
                    *place.ok_or(Fault::Malformed)? = object;
                    Ok(0)
                }
                EqualObject {
                    to,
                    left,
                    right,
                    kind,
                } => self.compare(to, left, right, kind, Ordering::is_eq),
                LessObject {
                    to,
                    left,
                    right,
                    kind,
                } => self.compare(to, left, right, kind, Ordering::is_lt),
                LessElement {
                    to,
                    scalars,
                    objects,
                    other,
                    other_objects,
                    kind,
                } => self.less_element(to, (scalars, objects), (other, other_objects), kind),
                ListOfSet { to, set, .. } => {
                    let list = self.read(set)?.clone();
                    self.share(to, list)
                }
                SetUnite { set, from, kind } => self.set_merge(set, from, kind, [true, true, true]),
                SetIntersect { set, from, kind } => {
                    self.set_merge(set, from, kind, [false, true, false])
                }
                SetSubtract { set, from, kind } => {
                    self.set_merge(set, from, kind, [true, false, false])
                }
                MapGet {
                    map,
                    scalars,
                    objects,
                    to,
                    to_objects,
                    kind,
                } => self.map_get(map, (scalars, objects), (to, to_objects), kind),
                MapAt {
                    map,
                    scalars,
                    objects,
                    to,
                    to_objects,
                    kind,
                } => self.map_at(map, (scalars, objects), (to, to_objects), kind),
                MapAdd {
                    map,
                    scalars,
                    objects,
                    amount,
                    kind,
                } => self.map_add(map, (scalars, objects), self.scalar(amount) as i64, kind),
                MapAddConstant {
                    map,
                    scalars,
                    objects,
                    amount,
                    kind,
                } => self.map_add(map, (scalars, objects), amount.0.into(), kind),
                MapKeys { to, map, .. } => self.map_half(to, map, Map::keys),
                MapValues { to, map, .. } => self.map_half(to, map, Map::values),
                Circle { to, center, radius } => self.circle(to, center.0, radius),
                AreaContains { to, area, point } => self.area_contains(to, area, point.0),
                _ => Err(Fault::Malformed), // the loop executes all others
            }
        }
    }

    fn call_host(
        &mut self,
        scalars: Block,
        objects: ObjectBlock,
        import: ImportIndex,
    ) -> Result<u64, Fault> {
        let index = import.0 as usize;
        let import = self.program.bytecode.imports.get(index);
        let signature = self.program.signatures.get(index);
        let (Some(import), Some(signature)) = (import, signature) else {
            return Err(Fault::Malformed);
        };
        let (arguments, results) = (&signature.arguments, &signature.results);
        let (width, object_width) = (
            arguments.scalars.len().max(results.scalars.len()),
            arguments.objects.len().max(results.objects.len()),
        );
        let (start, object_start) = (scalars.place(), self.object_base + objects.place());
        let scalars = self.registers.get_mut(start..start + width);
        let objects = self
            .objects
            .get_mut(object_start..object_start + object_width);
        let (Some(scalars), Some(objects)) = (scalars, objects) else {
            return Err(Fault::Malformed);
        };
        // Result registers beyond the arguments are empty so far.
        scalars[arguments.scalars.len()..].fill(0);
        objects[arguments.objects.len()..].fill(Object::EMPTY);
        let mut call = HostCall {
            import,
            scalars,
            objects,
        };
        let cost = self
            .host
            .call(signature.number, &mut call)
            .map_err(Fault::Host)?;
        objects[results.objects.len()..].fill(Object::EMPTY);
        let bytes = objects.iter().map(Object::bytes).sum();
        let counting = self.allocate(bytes)?;
        Ok(cost.saturating_add(shift(bytes) + counting))
    }

    fn load_other(&mut self, to: ObjectOut, robot: In, variable: ObjectSlot) -> Result<u64, Fault> {
        let robot = RobotId(self.scalar(robot) as u32);
        let state = self.host.state_of(robot).ok_or_else(unknown_robot)?;
        let object = state.objects.get(variable.0 as usize).cloned();
        self.share(to, object.ok_or(Fault::Malformed)?)
    }

    fn compare(
        &mut self,
        to: Out,
        left: ObjectIn,
        right: ObjectIn,
        kind: crate::machine::operand::Type,
        holds: fn(Ordering) -> bool,
    ) -> Result<u64, Fault> {
        let (left, right) = (self.read(left)?, self.read(right)?);
        let cost = shift(left.bytes().min(right.bytes()));
        let result = holds(left.compare(right, kind.0, &self.program.parts));
        self.set_bool(to, result);
        Ok(cost)
    }

    fn size(&mut self, to: Out, from: ObjectIn) -> Result<u64, Fault> {
        let object = self.read(from)?;
        let size = object.size() as u64;
        let cost = shift(object.text().len());
        self.registers[to.place()] = size;
        Ok(cost)
    }

    fn point(&self, first: u8) -> Point {
        let coordinate =
            |offset: u8| f64::from_bits(self.registers[usize::from(first.wrapping_add(offset))]);
        Point::new(coordinate(0), coordinate(1), coordinate(2))
    }

    fn circle(&mut self, to: ObjectOut, center: u8, radius: In) -> Result<u64, Fault> {
        let area = Area::Circle {
            center: self.point(center),
            radius: f64::from_bits(self.scalar(radius)),
        };
        if !area.is_valid() {
            return Err(Fault::ConversionOutOfRange);
        }
        self.put(to, area.into())
    }

    fn polygon(&mut self, to: ObjectOut, corners: ObjectIn) -> Result<u64, Fault> {
        let corners = self.read(corners)?;
        let cost = shift(corners.bytes());
        let words = corners.list().map_or(&[][..], |list| list.scalars());
        let (triples, _) = words.as_chunks::<3>();
        let points: alloc::vec::Vec<Point> = triples
            .iter()
            .map(|&[x, y, z]| Point::new(f64::from_bits(x), f64::from_bits(y), f64::from_bits(z)))
            .collect();
        let polygon = ConvexPolygon::new(&points).map_err(|_| Fault::ConversionOutOfRange)?;
        Ok(cost + self.put(to, Area::Polygon(polygon).into())?)
    }

    fn area_contains(&mut self, to: Out, area: ObjectIn, point: u8) -> Result<u64, Fault> {
        let point = self.point(point);
        let object = self.read(area)?;
        let inside = object.area().is_some_and(|area| area.contains(point));
        let cost = (object.bytes() / 8) as u64;
        self.set_bool(to, inside);
        Ok(cost)
    }
}
