//! Instructions on lists.

use crate::machine::error::Fault;
use crate::machine::interpreter::view::{View, object_at, shift, write_scalars};
use crate::machine::operand::{
    Block, In, ObjectBlock, ObjectIn, ObjectInOut, ObjectOut, Out, PairOut, Type,
};
use crate::machine::value::object::{self, List, Object};

/// The cost of sorting: every element moves once for each level of a merge.
pub(in crate::machine) fn sorting(list: &List) -> u64 {
    let levels = u64::from(list.len().next_power_of_two().trailing_zeros());
    (shift(list.bytes()) + 1) * levels
}

fn out_of_range(index: i64, list: &Object) -> Fault {
    Fault::IndexOutOfRange {
        index,
        length: list.size() as u32,
    }
}

impl View<'_> {
    fn index(&self, index: In) -> i64 {
        self.scalar(index) as i64
    }

    /// Writes a block to registers.
    pub fn set_block(
        &mut self,
        value: object::Block<'_>,
        (scalars, objects): (usize, usize),
    ) -> Result<u64, Fault> {
        write_scalars(self.registers, scalars, value.scalars)?;
        let start = self.object_base + objects;
        let mut bytes = 0;
        for (offset, object) in value.objects.iter().enumerate() {
            bytes += object.bytes();
            let place = self.objects.get_mut(start + offset);
            *place.ok_or(Fault::Malformed)? = object.clone();
        }
        let cost = shift(bytes) + (value.scalars.len() + value.objects.len()) as u64 / 8;
        match bytes {
            0 => Ok(cost),
            bytes => Ok(cost + self.allocate(bytes)?),
        }
    }

    pub fn list_get(
        &mut self,
        list: ObjectIn,
        index: In,
        scalars: Block,
        objects: ObjectBlock,
    ) -> Result<u64, Fault> {
        let index = self.index(index);
        let at = usize::try_from(index).unwrap_or(usize::MAX);
        let object = object_at(self.objects, self.object_base, self.state, list.0)?;
        let Some(element) = object.list().and_then(|list| list.get(at)) else {
            return Err(out_of_range(index, object));
        };
        // An element with one object at most is copied at once; more need the list to be held.
        if element.objects.len() < 2 {
            let width = element.scalars.len();
            write_scalars(self.registers, scalars.place(), element.scalars)?;
            return match element.objects.first().cloned() {
                None => Ok(width as u64 / 8),
                Some(object) => {
                    let to = ObjectOut(objects.0);
                    Ok(self.share(to, object)? + (width as u64 + 1) / 8)
                }
            };
        }
        let held = object.clone();
        match held.list().and_then(|list| list.get(at)) {
            Some(element) => self.set_block(element, (scalars.place(), objects.place())),
            None => Err(Fault::Malformed),
        }
    }

    pub fn list_set(
        &mut self,
        list: ObjectInOut,
        index: In,
        scalars: Block,
        objects: ObjectBlock,
    ) -> Result<u64, Fault> {
        let index = self.index(index);
        self.change(list, |object, view| {
            let at = usize::try_from(index).unwrap_or(usize::MAX);
            let element = object.list().and_then(|list| list.get(at));
            let Some((width, object_width)) =
                element.map(|element| (element.scalars.len(), element.objects.len()))
            else {
                return Err(out_of_range(index, object));
            };
            let block = view.block_of(scalars, width, objects, object_width)?;
            let cost = shift(block.objects.iter().map(Object::bytes).sum());
            let list = object.existing_list_mut().ok_or(Fault::Malformed)?;
            if list.set(at, block) {
                Ok(cost + (width + object_width) as u64 / 8)
            } else {
                Err(Fault::Malformed)
            }
        })
    }

    pub fn list_add(
        &mut self,
        list: ObjectInOut,
        scalars: Block,
        objects: ObjectBlock,
        kind: Type,
    ) -> Result<u64, Fault> {
        let layout = &self.parts(kind)?.element;
        self.change(list, |object, view| {
            let block = view.block(scalars, objects, layout)?;
            let cost = shift(block.objects.iter().map(Object::bytes).sum());
            let list = object.list_mut(layout).ok_or(Fault::Malformed)?;
            if list.push(block) {
                Ok(cost + (block.scalars.len() + block.objects.len()) as u64 / 8)
            } else {
                Err(Fault::Malformed)
            }
        })
    }

    pub fn list_insert(
        &mut self,
        list: ObjectInOut,
        index: In,
        scalars: Block,
        objects: ObjectBlock,
        kind: Type,
    ) -> Result<u64, Fault> {
        let layout = &self.parts(kind)?.element;
        let index = self.index(index);
        self.change(list, |object, view| {
            let at = usize::try_from(index).unwrap_or(usize::MAX);
            if at > object.size() {
                return Err(out_of_range(index, object));
            }
            let block = view.block(scalars, objects, layout)?;
            let list = object.list_mut(layout).ok_or(Fault::Malformed)?;
            insert(list, at, block)
        })
    }

    pub fn list_remove_at(&mut self, list: ObjectInOut, index: In) -> Result<u64, Fault> {
        let index = self.index(index);
        self.change(list, |object, _| {
            let at = usize::try_from(index).unwrap_or(usize::MAX);
            if at >= object.size() {
                return Err(out_of_range(index, object));
            }
            let list = object.existing_list_mut().ok_or(Fault::Malformed)?;
            let cost = shift(list.bytes_from(at));
            list.remove(at);
            Ok(cost)
        })
    }

    pub fn list_find(
        &mut self,
        to: PairOut,
        list: ObjectIn,
        scalars: Block,
        objects: ObjectBlock,
        kind: Type,
    ) -> Result<u64, Fault> {
        let layout = &self.parts(kind)?.element;
        let object = self.read(list)?;
        let block = self.block(scalars, objects, layout)?;
        let types = &self.program.parts;
        let is_it = |element: object::Block<'_>| element.compare(block, layout, types).is_eq();
        let found = object.list().and_then(|list| list.iter().position(is_it));
        let cost = shift(object.bytes());
        self.registers[usize::from(to.0)] = u64::from(found.is_some());
        self.registers[usize::from(to.0.wrapping_add(1))] = found.unwrap_or(0) as u64;
        Ok(cost)
    }

    pub fn less_element(
        &mut self,
        to: Out,
        value: (Block, ObjectBlock),
        other: (Block, ObjectBlock),
        kind: Type,
    ) -> Result<u64, Fault> {
        let layout = &self.parts(kind)?.element;
        let value = self.block(value.0, value.1, layout)?;
        let other = self.block(other.0, other.1, layout)?;
        let cost = shift(value.objects.iter().map(Object::bytes).sum());
        let is_less = value.compare(other, layout, &self.program.parts).is_lt();
        self.registers[to.place()] = u64::from(is_less);
        Ok(cost)
    }

    pub fn list_append(&mut self, list: ObjectInOut, from: ObjectIn) -> Result<u64, Fault> {
        let from = self.read(from)?.clone();
        let Some(added) = from.list() else {
            return Ok(0);
        };
        self.change(list, |object, _| {
            if object.list().is_none() {
                *object = from.clone();
            } else {
                let list = object.existing_list_mut().ok_or(Fault::Malformed)?;
                if !list.append(added) {
                    return Err(Fault::Malformed);
                }
            }
            Ok(shift(added.bytes()))
        })
    }

    pub fn list_reverse(&mut self, list: ObjectInOut) -> Result<u64, Fault> {
        self.rearrange(list, |list| {
            (list.arranged((0..list.len()).rev()), shift(list.bytes()))
        })
    }

    pub fn list_sort(&mut self, list: ObjectInOut, kind: Type) -> Result<u64, Fault> {
        let layout = &self.parts(kind)?.element;
        let types = &self.program.parts;
        self.rearrange(list, |list| (list.sorted(layout, types), sorting(list)))
    }

    pub fn list_sort_by(
        &mut self,
        list: ObjectInOut,
        keys: ObjectIn,
        kind: Type,
    ) -> Result<u64, Fault> {
        let layout = &self.parts(kind)?.element;
        let types = &self.program.parts;
        let keys = self.read(keys)?.clone();
        self.rearrange(list, |list| {
            let (order, cost) = match keys.list() {
                Some(keys) => (keys.order(layout, types), sorting(keys)),
                None => Default::default(),
            };
            let arranged = list.arranged(order.into_iter());
            (arranged, cost + shift(list.bytes()))
        })
    }

    fn rearrange(
        &mut self,
        list: ObjectInOut,
        arrange: impl FnOnce(&List) -> (List, u64),
    ) -> Result<u64, Fault> {
        self.change(list, |object, _| match object.list() {
            Some(list) => {
                let (arranged, cost) = arrange(list);
                *object = arranged.into();
                Ok(cost)
            }
            None => Ok(0),
        })
    }

    pub fn list_slice(&mut self, list: ObjectInOut, first: In, last: In) -> Result<u64, Fault> {
        let (first, last) = (self.index(first), self.index(last));
        self.change(list, |object, _| {
            let size = object.size() as i64;
            if first < 0 || first > size {
                return Err(out_of_range(first, object));
            }
            if last < first || last > size {
                return Err(out_of_range(last, object));
            }
            let Some(list) = object.existing_list_mut() else {
                return Ok(0);
            };
            let cost = shift(list.bytes());
            list.slice(first as usize, last as usize);
            Ok(cost)
        })
    }

    pub fn sum_int(&mut self, to: Out, list: ObjectIn) -> Result<u64, Fault> {
        let object = self.read(list)?;
        let numbers = object.list().map_or(&[][..], |list| list.scalars());
        let sum = numbers
            .iter()
            .try_fold(0i64, |sum, &number| sum.checked_add(number as i64));
        let cost = shift(object.bytes());
        self.registers[to.place()] = sum.ok_or(Fault::Overflow)? as u64;
        Ok(cost)
    }

    pub fn sum_float(&mut self, to: Out, list: ObjectIn) -> Result<u64, Fault> {
        let object = self.read(list)?;
        let numbers = object.list().map_or(&[][..], |list| list.scalars());
        let sum = numbers
            .iter()
            .fold(0.0, |sum, &number| sum + f64::from_bits(number));
        let cost = shift(object.bytes());
        self.registers[to.place()] = crate::machine::types::bits(sum);
        Ok(cost)
    }
}

/// Inserts a block; returns the cost.
pub(in crate::machine) fn insert(
    list: &mut List,
    at: usize,
    block: object::Block<'_>,
) -> Result<u64, Fault> {
    let held = block.objects.iter().map(Object::bytes).sum::<usize>();
    let cost = shift(list.bytes_from(at) + held);
    if list.insert(at, block) {
        Ok(cost)
    } else {
        Err(Fault::Malformed)
    }
}
