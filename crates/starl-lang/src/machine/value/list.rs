//! Rows of equal blocks: what lists, sets, and the two halves of a map are made of.
//!
//! Invariant: `scalars` holds `length * width` words and `objects` `length * object_width` objects;
//! `held` is the sum of the sizes of `objects`.
//!
//! Objects hold lists, so a list knows of its objects only that they are [`Item`]s.

use crate::machine::types::{Layout, Order, Parts, bits};
use alloc::vec::Vec;
use core::cmp::Ordering;
use core::num::NonZeroUsize;
use core::ops::Range;
use serde::{Deserialize, Serialize};

/// Bytes of a scalar, or of a reference to an object.
pub const WORD: usize = 8;

/// An object that elements hold beside their scalars.
pub trait Item: Clone + Default {
    /// The size as if nothing were shared, bytes.
    fn bytes(&self) -> usize;

    /// The characters of a text.
    fn text(&self) -> &str;

    /// Where it lies in memory; none if it is empty.
    fn address(&self) -> Option<NonZeroUsize>;

    /// The order of two objects of this type.
    fn compare(&self, other: &Self, kind: u16, types: &[Parts]) -> Ordering;
}

/// A row of blocks of scalars and objects.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct List<T> {
    length: u32,
    width: u8,
    object_width: u8,
    held: usize,
    scalars: Vec<u64>,
    objects: Vec<T>,
}

/// One block, borrowed.
#[derive(Debug)]
pub struct Block<'a, T> {
    /// Its scalars.
    pub scalars: &'a [u64],
    /// Its objects.
    pub objects: &'a [T],
}

/// Not derived: it is copied whether or not its objects can be.
impl<T> Clone for Block<'_, T> {
    #[inline]
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for Block<'_, T> {}

impl<T: Item> List<T> {
    /// A list without elements, for blocks of this layout.
    pub fn new(layout: &Layout) -> List<T> {
        List {
            width: layout.scalars.len() as u8,
            object_width: layout.objects.len() as u8,
            ..List::default()
        }
    }

    /// A list of one scalar each, for instance of Ints.
    pub fn of_scalars(scalars: Vec<u64>) -> List<T> {
        List {
            length: scalars.len() as u32,
            width: 1,
            scalars,
            ..List::default()
        }
    }

    /// A list of Points.
    pub fn of_points(points: &[starl_core::Point]) -> List<T> {
        let coordinates = points.iter().flat_map(|p| [p.x, p.y, p.z]);
        List {
            length: points.len() as u32,
            width: 3,
            scalars: coordinates.map(bits).collect(),
            ..List::default()
        }
    }

    /// A list of one object each, for instance of texts.
    pub fn of_objects(objects: Vec<T>) -> List<T> {
        List {
            length: objects.len() as u32,
            object_width: 1,
            held: objects.iter().map(T::bytes).sum(),
            objects,
            ..List::default()
        }
    }

    /// How many elements there are.
    pub fn len(&self) -> usize {
        self.length as usize
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.length == 0
    }

    /// How many scalars and objects each element has.
    pub fn widths(&self) -> (u8, u8) {
        (self.width, self.object_width)
    }

    /// The size as if nothing were shared, bytes.
    pub fn bytes(&self) -> usize {
        WORD * (4 + self.scalars.len() + self.objects.len()) + self.held
    }

    /// The size of the elements from `index` on, without what their objects hold, bytes.
    pub fn bytes_from(&self, index: usize) -> usize {
        self.len().saturating_sub(index) * WORD * (self.width as usize + self.object_width as usize)
    }

    /// All scalars, block after block.
    pub fn scalars(&self) -> &[u64] {
        &self.scalars
    }

    /// The element at an index.
    pub fn get(&self, index: usize) -> Option<Block<'_, T>> {
        if index >= self.len() {
            return None;
        }
        let (width, object_width) = (self.width as usize, self.object_width as usize);
        Some(Block {
            scalars: self.scalars.get(index * width..(index + 1) * width)?,
            objects: self
                .objects
                .get(index * object_width..(index + 1) * object_width)?,
        })
    }

    /// The scalars of the element at an index, of a list whose elements hold this number of objects.
    #[inline]
    pub fn scalars_at(&self, index: u64, objects: u8) -> Option<&[u64]> {
        let width = usize::from(self.width);
        if self.object_width != objects || index >= u64::from(self.length) {
            return None;
        }
        let start = index as usize * width;
        self.scalars.get(start..start + width)
    }

    /// As [`List::scalars_at`], to be changed.
    #[inline]
    pub fn scalars_at_mut(&mut self, index: u64, objects: u8) -> Option<&mut [u64]> {
        let width = usize::from(self.width);
        if self.object_width != objects || index >= u64::from(self.length) {
            return None;
        }
        let start = index as usize * width;
        self.scalars.get_mut(start..start + width)
    }

    /// The first scalar of the element at an index.
    #[inline]
    pub fn first_scalar(&self, index: usize) -> Option<u64> {
        let is_there = index < self.len();
        is_there.then(|| self.scalars.get(index * usize::from(self.width)).copied())?
    }

    /// The first object of the element at an index.
    #[inline]
    pub fn first_object(&self, index: usize) -> Option<&T> {
        let is_there = index < self.len();
        is_there.then(|| self.objects.get(index * usize::from(self.object_width)))?
    }

    /// The element at an index, of a list whose elements are one object each.
    #[inline]
    pub fn object_at(&self, index: u64) -> Option<&T> {
        match (self.width, self.object_width) {
            (0, 1) => self.objects.get(index as usize),
            _ => None,
        }
    }

    /// All elements in order.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = Block<'_, T>> {
        (0..self.len()).filter_map(|index| self.get(index))
    }

    /// Whether a block is as wide as the elements, and `index` is at most the size.
    fn fits(&self, index: usize, block: Block<'_, T>) -> bool {
        index <= self.len()
            && block.scalars.len() == self.width as usize
            && block.objects.len() == self.object_width as usize
    }

    /// Replaces an element by a block; false if there is no such element or the block has another width.
    #[must_use]
    pub fn set(&mut self, index: usize, block: Block<'_, T>) -> bool {
        self.fits(index, block) && self.set_end(index, block)
    }

    /// Replaces the end of an element by a block; false if there is no such element or the block is wider.
    #[must_use]
    pub fn set_end(&mut self, index: usize, block: Block<'_, T>) -> bool {
        let (end, object_end) = self.starts(index + 1);
        let (width, object_width) = (block.scalars.len(), block.objects.len());
        if index >= self.len()
            || width > usize::from(self.width)
            || object_width > usize::from(self.object_width)
        {
            return false;
        }
        self.scalars[end - width..end].copy_from_slice(block.scalars);
        let places = &mut self.objects[object_end - object_width..object_end];
        for (place, object) in places.iter_mut().zip(block.objects) {
            self.held = self.held - place.bytes() + object.bytes();
            *place = object.clone();
        }
        true
    }

    /// Inserts a block before an element or at the end; false if the index is greater or the block
    /// not as wide.
    #[must_use]
    pub fn insert(&mut self, index: usize, block: Block<'_, T>) -> bool {
        if !self.fits(index, block) || self.length == u32::MAX {
            return false;
        }
        let (start, object_start) = self.starts(index);
        self.scalars
            .splice(start..start, block.scalars.iter().copied());
        self.held += block.objects.iter().map(T::bytes).sum::<usize>();
        self.objects
            .splice(object_start..object_start, block.objects.iter().cloned());
        self.length += 1;
        true
    }

    /// Adds a block at the end; false if it is not as wide as the others.
    #[must_use]
    pub fn push(&mut self, block: Block<'_, T>) -> bool {
        if !self.fits(self.len(), block) || self.length == u32::MAX {
            return false;
        }
        self.scalars.extend_from_slice(block.scalars);
        self.held += block.objects.iter().map(T::bytes).sum::<usize>();
        self.objects.extend_from_slice(block.objects);
        self.length += 1;
        true
    }

    /// Removes an element; false if there is none.
    pub fn remove(&mut self, index: usize) -> bool {
        if index >= self.len() {
            return false;
        }
        let (start, object_start) = self.starts(index);
        self.scalars.drain(start..start + self.width as usize);
        let removed = object_start..object_start + self.object_width as usize;
        self.held -= self
            .objects
            .drain(removed)
            .map(|o| o.bytes())
            .sum::<usize>();
        self.length -= 1;
        true
    }

    /// Keeps the existing elements from `first` to before `last`.
    pub fn slice(&mut self, first: usize, last: usize) {
        let last = last.min(self.len());
        let first = first.min(last);
        let ((start, object_start), (end, object_end)) = (self.starts(first), self.starts(last));
        self.scalars.truncate(end);
        self.scalars.drain(..start);
        self.objects.truncate(object_end);
        self.objects.drain(..object_start);
        self.held = self.objects.iter().map(T::bytes).sum();
        self.length = (last - first) as u32;
    }

    /// Adds all elements of another list; false if they are not as wide as this one's.
    #[must_use]
    pub fn append(&mut self, other: &List<T>) -> bool {
        let Some(length) = self.length.checked_add(other.length) else {
            return false;
        };
        if self.width != other.width || self.object_width != other.object_width {
            return false;
        }
        self.length = length;
        self.held += other.held;
        self.scalars.extend_from_slice(&other.scalars);
        self.objects.extend_from_slice(&other.objects);
        true
    }

    /// The list with its elements in the order that `order` gives as indices; others are left out.
    pub fn arranged(&self, order: impl Iterator<Item = usize>) -> List<T> {
        let mut arranged = List {
            width: self.width,
            object_width: self.object_width,
            ..List::default()
        };
        for block in order.filter_map(|index| self.get(index)) {
            let _ = arranged.push(block); // as wide, being from the same list
        }
        arranged
    }

    /// Each element followed by the one at the same index of another list.
    pub fn zipped(&self, other: &List<T>) -> List<T> {
        let mut zipped = List {
            width: self.width.wrapping_add(other.width),
            object_width: self.object_width.wrapping_add(other.object_width),
            ..List::default()
        };
        for (left, right) in self.iter().zip(other.iter()) {
            for block in [left, right] {
                zipped.scalars.extend_from_slice(block.scalars);
                zipped.objects.extend_from_slice(block.objects);
            }
            zipped.length += 1;
        }
        zipped.held = zipped.objects.iter().map(T::bytes).sum();
        zipped
    }

    /// The same part of each element: the scalars and objects from the first pair of indices to before the second.
    pub fn parts(&self, from: (u8, u8), to: (u8, u8)) -> List<T> {
        let mut parts = List {
            width: to.0.saturating_sub(from.0),
            object_width: to.1.saturating_sub(from.1),
            ..List::default()
        };
        for block in self.iter() {
            let [block, _] = block.split(to);
            let _ = parts.push(block.split(from)[1]); // as wide as the others
        }
        parts
    }

    /// The indices of the elements in ascending order; equal ones in the order that they have.
    pub fn order(&self, layout: &Layout, types: &[Parts]) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.len()).collect();
        order.sort_by(|&left, &right| match (self.get(left), self.get(right)) {
            (Some(left), Some(right)) => left.compare(right, layout, types),
            _ => Ordering::Equal,
        });
        order
    }

    /// The list in ascending order; equal elements stay in the order that they had.
    pub fn sorted(&self, layout: &Layout, types: &[Parts]) -> List<T> {
        self.arranged(self.order(layout, types).into_iter())
    }

    /// The sorted list without its repeated elements.
    pub fn deduplicated(&self, layout: &Layout, types: &[Parts]) -> List<T> {
        let first = |&index: &usize| match (
            index.checked_sub(1).and_then(|i| self.get(i)),
            self.get(index),
        ) {
            (Some(before), Some(block)) => before.compare(block, layout, types) != Ordering::Equal,
            _ => true,
        };
        self.arranged((0..self.len()).filter(first))
    }

    /// The index of a block in a sorted list, or the index at which it belongs. Only the beginning of each element is
    /// compared if the layout is narrower.
    pub fn search(
        &self,
        block: Block<'_, T>,
        layout: &Layout,
        types: &[Parts],
    ) -> Result<usize, usize> {
        if let ([Order::Integer], [], [scalar]) =
            (&layout.scalars[..], &layout.objects[..], block.scalars)
        {
            let scalar = *scalar as i64;
            return self.bisect(|index| self.first_scalar(index).map(|o| (o as i64).cmp(&scalar)));
        }
        self.bisect(|index| Some(self.get(index)?.compare(block, layout, types)))
    }

    /// Binary search by how an element compares with what is looked for.
    fn bisect(&self, compare: impl Fn(usize) -> Option<Ordering>) -> Result<usize, usize> {
        let (mut low, mut high) = (0, self.len());
        while low < high {
            let middle = low + (high - low) / 2;
            match compare(middle) {
                Some(Ordering::Less) => low = middle + 1,
                Some(Ordering::Equal) => return Ok(middle),
                Some(Ordering::Greater) | None => high = middle,
            }
        }
        Err(low)
    }

    /// The order of two lists of one layout: by the first elements that differ, then by size.
    pub fn compare(&self, other: &List<T>, layout: &Layout, types: &[Parts]) -> Ordering {
        self.iter()
            .zip(other.iter())
            .map(|(left, right)| left.compare(right, layout, types))
            .find(|order| order.is_ne())
            .unwrap_or_else(|| self.length.cmp(&other.length))
    }

    /// Whether the bits of all elements are the same.
    pub fn same(&self, other: &List<T>) -> bool
    where
        T: PartialEq,
    {
        self.length == other.length
            && self.scalars == other.scalars
            && self.objects == other.objects
    }

    fn starts(&self, index: usize) -> (usize, usize) {
        (
            index * self.width as usize,
            index * self.object_width as usize,
        )
    }
}

impl<'a, T: Item> Block<'a, T> {
    /// Its first scalars and objects, and the others.
    pub fn split(self, (scalars, objects): (u8, u8)) -> [Block<'a, T>; 2] {
        let (left, right) = self
            .scalars
            .split_at(self.scalars.len().min(scalars.into()));
        let objects = self
            .objects
            .split_at(self.objects.len().min(objects.into()));
        [(left, objects.0), (right, objects.1)].map(|(scalars, objects)| Block { scalars, objects })
    }

    /// The order of two values of one layout.
    pub fn compare(self, other: Self, layout: &Layout, types: &[Parts]) -> Ordering {
        let mut start = 0;
        let objects = self.objects.iter().zip(other.objects);
        let kinds = layout.objects.iter().zip(&layout.before);
        for ((left, right), (&kind, &before)) in objects.zip(kinds) {
            let before = usize::from(before);
            let order = self
                .compare_scalars(other, layout, start..before)
                .then_with(|| left.compare(right, kind, types));
            if order.is_ne() {
                return order;
            }
            start = before;
        }
        self.compare_scalars(other, layout, start..layout.scalars.len())
    }

    fn compare_scalars(self, other: Self, layout: &Layout, range: Range<usize>) -> Ordering {
        let scalars = self.scalars.iter().zip(other.scalars).zip(&layout.scalars);
        let scalars = scalars.take(range.end).skip(range.start);
        let mut orders = scalars.map(|((&left, &right), order)| match order {
            Order::Integer => (left as i64).cmp(&(right as i64)),
            Order::Float => compare_floats(left, right),
        });
        orders
            .find(|order| order.is_ne())
            .unwrap_or(Ordering::Equal)
    }
}

/// The total order of Floats as keys; adding zero makes -0.0 into 0.0.
fn compare_floats(left: u64, right: u64) -> Ordering {
    let (left, right) = (f64::from_bits(left) + 0.0, f64::from_bits(right) + 0.0);
    left.total_cmp(&right)
}
