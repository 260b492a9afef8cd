//! Which point of a growing set is nearest: a k-d tree with buckets.
//!
//! Points arrive one by one and are never taken out. A bucket holds up to 32 points axis by
//! axis, so that distances to all of them are computed side by side; when it is full it is cut at the
//! median of its longer side. A small set is one bucket, looked through from end to end, which is
//! faster than any structure. (Bentley 1975, "Multidimensional binary search trees used for
//! associative searching"; the buckets are ours.)
//!
//! Answers depend only on the points and the order in which they were added; of points at equal
//! distance any may be the answer, the same at every run.

use super::vector::Vector;
use alloc::vec::Vec;

/// The most points of a bucket.
const BUCKET: usize = 32;

/// A growing set of points, numbered in the order they were added.
#[derive(Clone, Debug)]
pub struct Nearest<const D: usize> {
    nodes: Vec<Node>,
    buckets: Vec<Bucket<D>>,
    count: u32,
}

#[derive(Clone, Copy, Debug)]
enum Node {
    Bucket(u32),
    /// Points with a coordinate below `at` are in `below`, the others in the node after it.
    Cut {
        axis: u32,
        at: f64,
        below: u32,
    },
}

#[derive(Clone, Debug)]
struct Bucket<const D: usize> {
    count: usize,
    coordinates: [[f64; BUCKET]; D],
    numbers: [u32; BUCKET],
}

impl<const D: usize> Bucket<D> {
    const fn new() -> Self {
        // Infinitely far away, so that a search may look at the unused places too.
        Bucket {
            count: 0,
            coordinates: [[f64::INFINITY; BUCKET]; D],
            numbers: [0; BUCKET],
        }
    }

    fn push(&mut self, point: &Vector<D>, number: u32) {
        for (axis, coordinates) in self.coordinates.iter_mut().enumerate() {
            coordinates[self.count] = point[axis];
        }
        self.numbers[self.count] = number;
        self.count += 1;
    }

    fn point(&self, index: usize) -> Vector<D> {
        core::array::from_fn(|axis| self.coordinates[axis][index])
    }

    #[inline]
    fn squared_distances(&self, point: &Vector<D>) -> [f64; BUCKET] {
        let mut squared = [0.0; BUCKET];
        for (coordinates, at) in self.coordinates.iter().zip(point) {
            for (sum, coordinate) in squared.iter_mut().zip(coordinates) {
                let offset = coordinate - at;
                *sum += offset * offset;
            }
        }
        squared
    }

    /// Where to cut a full bucket: none if all its points are at one place.
    fn cut(&self) -> Option<(usize, f64)> {
        let (mut axis, mut widest) = (0, 0.0);
        for (candidate, coordinates) in self.coordinates.iter().enumerate() {
            let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
            for &coordinate in coordinates {
                low = if coordinate < low { coordinate } else { low };
                high = if coordinate > high { coordinate } else { high };
            }
            if high - low > widest {
                (axis, widest) = (candidate, high - low);
            }
        }
        let mut sorted = self.coordinates[axis];
        sorted.sort_unstable_by(f64::total_cmp);
        // The first coordinate from the middle on that leaves a point below it.
        let at = sorted[BUCKET / 2..].iter().find(|&&at| at > sorted[0]);
        at.map(|&at| (axis, at))
    }
}

impl<const D: usize> Default for Nearest<D> {
    fn default() -> Self {
        Nearest::new()
    }
}

impl<const D: usize> Nearest<D> {
    /// The empty set.
    pub fn new() -> Self {
        let mut buckets = Vec::with_capacity(4);
        buckets.push(Bucket::new());
        Nearest {
            nodes: alloc::vec![Node::Bucket(0)],
            buckets,
            count: 0,
        }
    }

    /// Adds a point with finite coordinates; its number is the count of points before. A point at the same position as
    /// 32 others is numbered but never found; the others are found instead.
    pub fn add(&mut self, point: &Vector<D>) {
        let number = self.count;
        self.count += 1;
        let mut node = 0;
        loop {
            match self.nodes[node] {
                Node::Cut { axis, at, below } => {
                    node = below as usize + usize::from(point[axis as usize] >= at);
                }
                Node::Bucket(bucket) if self.buckets[bucket as usize].count < BUCKET => {
                    return self.buckets[bucket as usize].push(point, number);
                }
                Node::Bucket(bucket) => match self.buckets[bucket as usize].cut() {
                    Some((axis, at)) => self.split(node, bucket, axis, at),
                    None if self.buckets[bucket as usize].point(0) == *point => return,
                    None => {
                        let other = self.buckets[bucket as usize].point(0);
                        let axis = (0..D).find(|&axis| other[axis] != point[axis]).unwrap_or(0);
                        let at = if point[axis] > other[axis] {
                            point[axis]
                        } else {
                            other[axis]
                        };
                        self.split(node, bucket, axis, at);
                    }
                },
            }
        }
    }

    fn split(&mut self, node: usize, bucket: u32, axis: usize, at: f64) {
        let full = core::mem::replace(&mut self.buckets[bucket as usize], Bucket::new());
        let mut above = Bucket::new();
        for index in 0..full.count {
            let point = full.point(index);
            let side = if point[axis] < at {
                &mut self.buckets[bucket as usize]
            } else {
                &mut above
            };
            side.push(&point, full.numbers[index]);
        }
        let below = self.nodes.len() as u32;
        self.nodes.push(Node::Bucket(bucket));
        self.nodes.push(Node::Bucket(self.buckets.len() as u32));
        self.buckets.push(above);
        self.nodes[node] = Node::Cut {
            axis: axis as u32,
            at,
            below,
        };
    }

    /// The number of the nearest point; zero if there is none.
    pub fn nearest(&self, point: &Vector<D>) -> u32 {
        let mut best = (f64::INFINITY, 0);
        self.search(0, point, &mut best);
        best.1
    }

    fn search(&self, node: usize, point: &Vector<D>, best: &mut (f64, u32)) {
        match self.nodes[node] {
            Node::Bucket(bucket) => {
                let bucket = &self.buckets[bucket as usize];
                let squared = bucket.squared_distances(point);
                for (index, &squared) in squared.iter().enumerate() {
                    if squared < best.0 {
                        *best = (squared, bucket.numbers[index]);
                    }
                }
            }
            Node::Cut { axis, at, below } => {
                let offset = point[axis as usize] - at;
                let near = below as usize + usize::from(offset >= 0.0);
                let far = below as usize + usize::from(offset < 0.0);
                self.search(near, point, best);
                if offset * offset < best.0 {
                    self.search(far, point, best);
                }
            }
        }
    }

    /// Calls `visit` with the number and squared distance of every point nearer than `radius` metres.
    pub fn for_each_within(
        &self,
        point: &Vector<D>,
        radius: f64,
        visit: &mut impl FnMut(u32, f64),
    ) {
        self.collect(0, point, radius * radius, visit);
    }

    fn collect(
        &self,
        node: usize,
        point: &Vector<D>,
        limit: f64,
        visit: &mut impl FnMut(u32, f64),
    ) {
        match self.nodes[node] {
            Node::Bucket(bucket) => {
                let bucket = &self.buckets[bucket as usize];
                let squared = bucket.squared_distances(point);
                for (index, &squared) in squared[..bucket.count].iter().enumerate() {
                    if squared < limit {
                        visit(bucket.numbers[index], squared);
                    }
                }
            }
            Node::Cut { axis, at, below } => {
                let offset = point[axis as usize] - at;
                let beyond = offset * offset >= limit;
                if !(beyond && offset >= 0.0) {
                    self.collect(below as usize, point, limit, visit);
                }
                if !(beyond && offset < 0.0) {
                    self.collect(below as usize + 1, point, limit, visit);
                }
            }
        }
    }
}
