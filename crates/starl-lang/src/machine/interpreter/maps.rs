//! Instructions on maps.

use crate::machine::error::Fault;
use crate::machine::interpreter::view::{View, object_at, shift, write_scalars};
use crate::machine::interpreter::workspace::{Registers, WINDOW};
use crate::machine::operand::{
    Block, In, ObjectBlock, ObjectIn, ObjectInOut, ObjectOut, Out, Type,
};
use crate::machine::types::{Keys, Parts};
use crate::machine::value::object::{self, List, Map, Object};
use alloc::vec::Vec;

/// Where a value stands in registers: its first scalar and its first object.
type Place = (Block, ObjectBlock);

/// The index of a key in registers, if it is found without a search. The key is at these places.
#[inline(always)]
pub fn found(
    map: &Map,
    (scalar, object): (usize, usize),
    parts: &Parts,
    r: &Registers,
    objects: &[Object],
) -> Option<usize> {
    match parts.keys {
        Keys::Numbers => map.find_number(r[scalar % WINDOW]),
        Keys::Texts => map.find_text(objects.get(object)?),
        Keys::Others => None,
    }
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
        let found = self.map_search(ObjectIn(map.0), (scalars, objects), parts)?;
        self.change(map, |object, view| {
            let (key, value) = (&parts.element, &parts.value);
            let width = key.scalars.len() + value.scalars.len();
            let object_width = key.objects.len() + value.objects.len();
            let entry = view.block_of(scalars, width, objects, object_width)?;
            put(object, found, entry, parts, view)
        })
    }

    pub fn map_add(
        &mut self,
        map: ObjectInOut,
        key: Place,
        amount: i64,
        kind: Type,
    ) -> Result<u64, Fault> {
        let parts = self.parts(kind)?;
        let found = self.map_search(ObjectIn(map.0), key, parts)?;
        self.change(map, |object, view| {
            let held = found.and_then(|at| object.map()?.scalars_at(at)?.first().copied());
            let sum = amount.checked_add(held.unwrap_or(0) as i64);
            let key = view.block(key.0, key.1, &parts.element)?;
            let mut scalars = Vec::from(key.scalars);
            scalars.push(sum.ok_or(Fault::Overflow)? as u64);
            let entry = object::Block {
                scalars: &scalars,
                objects: key.objects,
            };
            put(object, found, entry, parts, view)
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
        // A value of scalars alone is copied at once; objects need the map to be held.
        if let Some([_, value]) = object.map().and_then(|map| map.get(at))
            && value.objects.is_empty()
        {
            write_scalars(self.registers, to.0, value.scalars)?;
            return Ok(value.scalars.len() as u64 / 8);
        }
        let held = object.clone();
        match held.map().and_then(|map| map.get(at)) {
            Some([_, value]) => self.set_block(value, to),
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
            let map = object.map_mut(parts).ok_or(Fault::Malformed)?;
            let cost = 3 + shift(map.bytes_from(at));
            map.remove(at);
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
        let object = self.read(map)?.clone();
        let Some(entry) = object.map().and_then(|map| map.entry(at)) else {
            let length = object.size() as u32;
            return Err(Fault::IndexOutOfRange { index, length });
        };
        self.set_block(entry, (scalars.place(), objects.place()))
    }

    /// Copies the keys or the values of a map.
    pub fn map_half(
        &mut self,
        to: ObjectOut,
        map: ObjectIn,
        half: fn(&Map) -> List,
    ) -> Result<u64, Fault> {
        let map = self.read(map)?.map().filter(|map| !map.is_empty());
        let half = map.map_or(Object::EMPTY, |map| half(map).into());
        self.share(to, half)
    }
}

/// Puts an entry into a map whose key is at this index, or nowhere.
fn put(
    object: &mut Object,
    found: Option<usize>,
    entry: object::Block<'_>,
    parts: &Parts,
    view: &View<'_>,
) -> Result<u64, Fault> {
    let map = object.map_mut(parts).ok_or(Fault::Malformed)?;
    let [key, value] = map.split(entry);
    let held = |objects: &[Object]| objects.iter().map(Object::bytes).sum::<usize>();
    let (done, moved) = match found {
        Some(at) => (map.set(at, value), held(value.objects)),
        None => {
            let at = map.place(key, parts, &view.program.parts);
            let moved = map.bytes_from(at) + held(entry.objects);
            (map.insert(at, entry), moved)
        }
    };
    done.then_some(3 + shift(moved)).ok_or(Fault::Malformed)
}
