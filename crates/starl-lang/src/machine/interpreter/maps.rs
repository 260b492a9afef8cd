//! Instructions on maps.

use crate::machine::error::Fault;
use crate::machine::interpreter::lists::insert;
use crate::machine::interpreter::view::{View, shift};
use crate::machine::operand::{Block, In, ObjectBlock, ObjectIn, ObjectInOut, Out, Type};
use crate::machine::types::Layout;
use crate::machine::value::object::Object;

/// Where a value stands in registers: its first scalar and its first object.
type Place = (Block, ObjectBlock);

impl View<'_> {
    pub fn map_put(
        &mut self,
        map: ObjectInOut,
        scalars: Block,
        objects: ObjectBlock,
        kind: Type,
    ) -> Result<u64, Fault> {
        let parts = self.parts(kind)?;
        let (key, value) = (&parts.element, &parts.value);
        self.change(map, |object, view| {
            let key_block = view.block(scalars, objects, key)?;
            let value_block = view.block_of(
                Block(scalars.0.wrapping_add(key.scalars.len() as u8)),
                value.scalars.len(),
                ObjectBlock(objects.0.wrapping_add(key.objects.len() as u8)),
                value.objects.len(),
            )?;
            let map = object.map_mut().ok_or(Fault::Malformed)?;
            let place = match map.keys.list() {
                Some(keys) => keys.search(key_block, key, &view.program.parts),
                None => Err(0),
            };
            let values = map.values.list_mut(value).ok_or(Fault::Malformed)?;
            match place {
                Ok(at) => {
                    let cost = shift(value_block.objects.iter().map(Object::bytes).sum());
                    let set = values.set(at, value_block);
                    set.then_some(3 + cost).ok_or(Fault::Malformed)
                }
                Err(at) => {
                    let keys = map.keys.list_mut(key).ok_or(Fault::Malformed)?;
                    let cost = insert(keys, at, key_block)?;
                    Ok(3 + cost + insert(values, at, value_block)?)
                }
            }
        })
    }

    /// The index of a key.
    fn map_search(
        &self,
        map: ObjectIn,
        (scalars, objects): Place,
        key: &Layout,
    ) -> Result<Option<usize>, Fault> {
        let block = self.block(scalars, objects, key)?;
        let keys = self.read(map)?.map().and_then(|map| map.keys.list());
        Ok(keys.and_then(|keys| keys.search(block, key, &self.program.parts).ok()))
    }

    /// Writes the value at an index to registers.
    fn map_value(&mut self, map: ObjectIn, at: usize, to: (usize, usize)) -> Result<u64, Fault> {
        let values = self.read(map)?.map().map(|map| map.values.clone());
        match values
            .as_ref()
            .and_then(Object::list)
            .and_then(|v| v.get(at))
        {
            Some(value) => self.set_block(value, to),
            None => Err(Fault::Malformed),
        }
    }

    pub fn map_get(
        &mut self,
        map: ObjectIn,
        key: Place,
        (to, to_objects): Place,
        kind: Type,
    ) -> Result<u64, Fault> {
        let parts = self.parts(kind)?;
        let found = self.map_search(map, key, &parts.element)?;
        let start = to.place() + 1;
        let cost = match found {
            Some(at) => self.map_value(map, at, (start, to_objects.place()))?,
            None => {
                let object_start = self.object_base + to_objects.place();
                let objects = object_start..object_start + parts.value.objects.len();
                let scalars = self
                    .registers
                    .get_mut(start..start + parts.value.scalars.len());
                scalars.ok_or(Fault::Malformed)?.fill(0);
                let objects = self.objects.get_mut(objects);
                objects.ok_or(Fault::Malformed)?.fill(Object::EMPTY);
                0
            }
        };
        self.registers[to.place()] = u64::from(found.is_some());
        Ok(3 + cost)
    }

    pub fn map_at(
        &mut self,
        map: ObjectIn,
        key: Place,
        (to, to_objects): Place,
        kind: Type,
    ) -> Result<u64, Fault> {
        let found = self.map_search(map, key, &self.parts(kind)?.element)?;
        let at = found.ok_or(Fault::KeyMissing)?;
        Ok(3 + self.map_value(map, at, (to.place(), to_objects.place()))?)
    }

    pub fn map_contains(
        &mut self,
        to: Out,
        map: ObjectIn,
        scalars: Block,
        objects: ObjectBlock,
        kind: Type,
    ) -> Result<u64, Fault> {
        let found = self.map_search(map, (scalars, objects), &self.parts(kind)?.element)?;
        self.set_bool(to, found.is_some());
        Ok(3)
    }

    pub fn map_remove(
        &mut self,
        map: ObjectInOut,
        scalars: Block,
        objects: ObjectBlock,
        kind: Type,
    ) -> Result<u64, Fault> {
        let key = &self.parts(kind)?.element;
        let found = self.map_search(ObjectIn(map.0), (scalars, objects), key)?;
        let Some(at) = found else {
            return Ok(3);
        };
        self.change(map, |object, _| {
            let map = object.map_mut().ok_or(Fault::Malformed)?;
            let mut cost = 3;
            for half in [&mut map.keys, &mut map.values] {
                let list = half.existing_list_mut().ok_or(Fault::Malformed)?;
                cost += shift(list.bytes_from(at));
                list.remove(at);
            }
            Ok(cost)
        })
    }

    pub fn map_entry(
        &mut self,
        map: ObjectIn,
        index: In,
        scalars: Block,
        objects: ObjectBlock,
    ) -> Result<u64, Fault> {
        let index = self.scalar(index) as i64;
        let at = usize::try_from(index).unwrap_or(usize::MAX);
        let object = self.read(map)?;
        let keys = object.map().map(|map| map.keys.clone());
        let Some(key) = keys.as_ref().and_then(Object::list).and_then(|k| k.get(at)) else {
            let length = object.size() as u32;
            return Err(Fault::IndexOutOfRange { index, length });
        };
        let value = (
            scalars.place() + key.scalars.len(),
            objects.place() + key.objects.len(),
        );
        let cost = self.set_block(key, (scalars.place(), objects.place()))?;
        Ok(cost + self.map_value(map, at, value)?)
    }
}
