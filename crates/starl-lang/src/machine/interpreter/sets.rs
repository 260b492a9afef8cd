//! Instructions on sets.

use crate::machine::error::Fault;
use crate::machine::interpreter::lists::{insert, sorting};
use crate::machine::interpreter::view::{View, shift};
use crate::machine::operand::{Block, ObjectBlock, ObjectIn, ObjectInOut, ObjectOut, Out, Type};
use crate::machine::types::{Layout, Parts};
use crate::machine::value::object::List;
use alloc::vec::Vec;
use core::cmp::Ordering;

impl View<'_> {
    pub fn set_of_list(&mut self, to: ObjectOut, list: ObjectIn, kind: Type) -> Result<u64, Fault> {
        let layout = &self.parts(kind)?.element;
        let types = &self.program.parts;
        let Some(list) = self.read(list)?.list() else {
            return self.put(to, Default::default());
        };
        let cost = sorting(list);
        let set = list.sorted(layout, types).deduplicated(layout, types);
        Ok(cost + self.put(to, set.into())?)
    }

    pub fn set_add(
        &mut self,
        set: ObjectInOut,
        scalars: Block,
        objects: ObjectBlock,
        kind: Type,
    ) -> Result<u64, Fault> {
        let layout = &self.parts(kind)?.element;
        self.change(set, |object, view| {
            let block = view.block(scalars, objects, layout)?;
            let place = match object.list() {
                Some(list) => list.search(block, layout, &view.program.parts),
                None => Err(0),
            };
            let Err(at) = place else {
                return Ok(3);
            };
            let list = object.list_mut(layout).ok_or(Fault::Malformed)?;
            Ok(3 + insert(list, at, block)?)
        })
    }

    pub fn set_remove(
        &mut self,
        set: ObjectInOut,
        scalars: Block,
        objects: ObjectBlock,
        kind: Type,
    ) -> Result<u64, Fault> {
        let layout = &self.parts(kind)?.element;
        self.change(set, |object, view| {
            let block = view.block(scalars, objects, layout)?;
            let types = &view.program.parts;
            let place = object.list().map(|list| list.search(block, layout, types));
            let Some(Ok(at)) = place else {
                return Ok(3);
            };
            let list = object.existing_list_mut().ok_or(Fault::Malformed)?;
            let cost = 3 + shift(list.bytes_from(at));
            list.remove(at);
            Ok(cost)
        })
    }

    pub fn set_contains(
        &mut self,
        to: Out,
        set: ObjectIn,
        scalars: Block,
        objects: ObjectBlock,
        kind: Type,
    ) -> Result<u64, Fault> {
        let layout = &self.parts(kind)?.element;
        let block = self.block(scalars, objects, layout)?;
        let types = &self.program.parts;
        let list = self.read(set)?.list();
        let found = list.is_some_and(|list| list.search(block, layout, types).is_ok());
        self.set_bool(to, found);
        Ok(3)
    }

    /// Merges another set into one. `keep` says whether elements stay that are in the first alone, in
    /// both, and in the other alone.
    pub fn set_merge(
        &mut self,
        set: ObjectInOut,
        from: ObjectIn,
        kind: Type,
        keep: [bool; 3],
    ) -> Result<u64, Fault> {
        let layout = &self.parts(kind)?.element;
        let from = self.read(from)?.clone();
        self.change(set, |object, view| {
            let empty = List::new(layout);
            let left = object.list().unwrap_or(&empty);
            let right = from.list().unwrap_or(&empty);
            let cost = shift(left.bytes() + right.bytes());
            let merged = merge(left, right, keep, layout, &view.program.parts);
            *object = merged.ok_or(Fault::Malformed)?.into();
            Ok(cost)
        })
    }
}

/// The merger of two sorted lists; none if their blocks differ in width.
fn merge(
    left: &List,
    right: &List,
    [keep_left, keep_both, keep_right]: [bool; 3],
    layout: &Layout,
    types: &[Parts],
) -> Option<List> {
    // Of the two lists put together, the indices of what stays.
    let mut chosen = Vec::new();
    let (mut i, mut j) = (0, 0);
    loop {
        let order = match (left.get(i), right.get(j)) {
            (None, None) => break,
            (Some(_), None) => Ordering::Less,
            (None, Some(_)) => Ordering::Greater,
            (Some(left), Some(right)) => left.compare(right, layout, types),
        };
        let (keep, index) = match order {
            Ordering::Less => (keep_left, i),
            Ordering::Equal => (keep_both, i),
            Ordering::Greater => (keep_right, left.len() + j),
        };
        if keep {
            chosen.push(index);
        }
        i += usize::from(order.is_le());
        j += usize::from(order.is_ge());
    }
    let mut all = left.clone();
    all.append(right).then(|| all.arranged(chosen.into_iter()))
}
