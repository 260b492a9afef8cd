//! Instructions on maps.

use crate::machine::error::Fault;
use crate::machine::interpreter::lists::insert;
use crate::machine::interpreter::view::{View, object_at, shift, write_scalars};
use crate::machine::interpreter::workspace::{Registers, WINDOW};
use crate::machine::operand::{Block, In, ObjectBlock, ObjectIn, ObjectInOut, Out, Type};
use crate::machine::types::Parts;
use crate::machine::value::object::{self, Map, Object};

/// Where a value stands in registers: its first scalar and its first object.
type Place = (Block, ObjectBlock);

/// A key in registers: the place of its first scalar, and its first object.
type Key<'a> = (usize, Option<&'a Object>);

/// Reads the value of a key that is found without a search, if it is scalars alone.
#[inline(never)]
pub fn get_scalars(
    map: Option<&Object>,
    key: Key<'_>,
    to: usize,
    parts: Option<&Parts>,
    r: &mut Registers,
) -> Option<()> {
    let value = map?.map()?.scalars_of(hashed(key, parts?, r)?)?;
    if value.len() >= 8 {
        return None;
    }
    r[to % WINDOW] = 1;
    for (offset, &word) in value.iter().enumerate() {
        r[(to + 1 + offset) % WINDOW] = word;
    }
    Some(())
}

/// Replaces the value of a key that is found without a search, if it is scalars alone.
#[inline(never)]
pub fn put_scalars(
    map: Option<&mut Object>,
    key: Key<'_>,
    parts: Option<&Parts>,
    r: &Registers,
) -> Option<()> {
    let parts = parts?;
    let place = map?.own_map_mut()?.scalars_of_mut(hashed(key, parts, r)?)?;
    let start = key.0 + parts.element.scalars.len();
    for (offset, word) in place.iter_mut().enumerate() {
        *word = r[(start + offset) % WINDOW];
    }
    Some(())
}

/// The key, if an index may have it.
#[inline(always)]
fn hashed<'a>(
    (place, text): Key<'a>,
    parts: &Parts,
    r: &'a Registers,
) -> Option<object::Block<'a>> {
    if !parts.has_hashed_keys {
        return None;
    }
    Some(match parts.element.objects.len() {
        0 => object::Block {
            scalars: r.get(place..=place)?,
            objects: &[],
        },
        _ => object::Block {
            scalars: &[],
            objects: core::slice::from_ref(text?),
        },
    })
}

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
        let found = self.map_search(ObjectIn(map.0), (scalars, objects), parts)?;
        self.change(map, |object, view| {
            let key_block = view.block(scalars, objects, key)?;
            let value_block = view.block_of(
                Block(scalars.0.wrapping_add(key.scalars.len() as u8)),
                value.scalars.len(),
                ObjectBlock(objects.0.wrapping_add(key.objects.len() as u8)),
                value.objects.len(),
            )?;
            let map = object.map_mut().ok_or(Fault::Malformed)?;
            if let Some(at) = found {
                let values = map.values_mut().list_mut(value).ok_or(Fault::Malformed)?;
                let cost = shift(value_block.objects.iter().map(Object::bytes).sum());
                let set = values.set(at, value_block);
                return set.then_some(3 + cost).ok_or(Fault::Malformed);
            }
            let place = map
                .keys()
                .list()
                .map(|keys| keys.search(key_block, key, &view.program.parts));
            let (Err(at) | Ok(at)) = place.unwrap_or(Err(0));
            let (keys, values) = map.parts_mut();
            let keys = keys.list_mut(key).ok_or(Fault::Malformed)?;
            let cost = insert(keys, at, key_block)?;
            let values = values.list_mut(value).ok_or(Fault::Malformed)?;
            Ok(3 + cost + insert(values, at, value_block)?)
        })
    }

    /// The index of a key.
    fn map_search(
        &self,
        map: ObjectIn,
        (scalars, objects): Place,
        parts: &Parts,
    ) -> Result<Option<usize>, Fault> {
        let block = self.block(scalars, objects, &parts.element)?;
        let map = self.read(map)?.map();
        Ok(map.and_then(|map| map.find(block, parts, &self.program.parts)))
    }

    /// Writes the value at an index to registers.
    fn map_value(&mut self, map: ObjectIn, at: usize, to: (usize, usize)) -> Result<u64, Fault> {
        let object = object_at(self.objects, self.object_base, self.state, map.0)?;
        let values = object.map().map(Map::values);
        // A value of scalars alone is copied at once; objects need the list to be held.
        if let Some(value) = values.and_then(Object::list).and_then(|v| v.get(at))
            && value.objects.is_empty()
        {
            write_scalars(self.registers, to.0, value.scalars)?;
            return Ok(value.scalars.len() as u64 / 8);
        }
        let values = values.cloned();
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
        let found = self.map_search(map, key, parts)?;
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
        let found = self.map_search(map, key, self.parts(kind)?)?;
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
        let found = self.map_search(map, (scalars, objects), self.parts(kind)?)?;
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
        let parts = self.parts(kind)?;
        let found = self.map_search(ObjectIn(map.0), (scalars, objects), parts)?;
        let Some(at) = found else {
            return Ok(3);
        };
        self.change(map, |object, _| {
            let map = object.map_mut().ok_or(Fault::Malformed)?;
            let mut cost = 3;
            let (keys, values) = map.parts_mut();
            for half in [keys, values] {
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
        let keys = object.map().map(|map| map.keys().clone());
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
