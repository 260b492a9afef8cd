//! Which boxes does a segment meet: a tree whose nodes have eight children side by side.
//!
//! The boxes of a node's children are stored coordinate by coordinate, so that one pass of plain
//! arithmetic clips a segment against all eight. Up to eight boxes form one node; all leaves except
//! the last are full, so a list of forty boxes is searched in six steps. After Dammertz, Hanika and
//! Keller 2008, "Shallow bounding volume hierarchies for fast SIMD ray tracing of incoherent rays".
//! The partition here is by medians along the widest side rather than by surface area, which is
//! quicker to build: many trees answer only a handful of queries.
//!
//! Invariant: a box is visited if the segment meets it, boundary included.

use super::ray::Ray;
use super::vector::Vector;
use alloc::vec::Vec;

/// Children of a node.
const WIDTH: usize = 8;

/// More nodes than ever wait to be looked at: seven a level, and eleven levels hold 2^32 boxes.
const WAITING: usize = 80;

/// Boxes with sides along the axes, numbered as in the list they came in.
#[derive(Clone, Debug)]
pub struct BoxTree<const D: usize> {
    nodes: Vec<Node<D>>,
}

#[derive(Clone, Debug)]
struct Node<const D: usize> {
    low: [[f64; WIDTH]; D],
    high: [[f64; WIDTH]; D],
    children: [u32; WIDTH],
    is_leaf: bool,
}

impl<const D: usize> Node<D> {
    const fn new(is_leaf: bool) -> Self {
        // The unused places are boxes turned inside out, which nothing meets.
        Node {
            low: [[f64::INFINITY; WIDTH]; D],
            high: [[f64::NEG_INFINITY; WIDTH]; D],
            children: [0; WIDTH],
            is_leaf,
        }
    }

    fn set(&mut self, place: usize, low: &Vector<D>, high: &Vector<D>, child: u32) {
        for axis in 0..D {
            self.low[axis][place] = low[axis];
            self.high[axis][place] = high[axis];
        }
        self.children[place] = child;
    }

    /// Where the segment enters and leaves each child's box, as fractions.
    #[inline]
    fn clip(&self, ray: &Ray<D>, limit: f64) -> ([f64; WIDTH], [f64; WIDTH]) {
        let (mut enter, mut leave) = ([0.0; WIDTH], [limit; WIDTH]);
        for axis in 0..D {
            let (from, inverse, slack) = (ray.from[axis], ray.inverse[axis], ray.slack[axis]);
            let (near, far) = if inverse > 0.0 {
                (&self.low[axis], &self.high[axis])
            } else {
                (&self.high[axis], &self.low[axis])
            };
            for place in 0..WIDTH {
                let near = (near[place] - from) * inverse;
                let far = (far[place] - from) * inverse + slack;
                enter[place] = if near > enter[place] {
                    near
                } else {
                    enter[place]
                };
                leave[place] = if far < leave[place] {
                    far
                } else {
                    leave[place]
                };
            }
        }
        (enter, leave)
    }
}

impl<const D: usize> BoxTree<D> {
    /// The tree of these boxes, given as low and high corner.
    pub fn new(boxes: impl ExactSizeIterator<Item = (Vector<D>, Vector<D>)>) -> Self {
        let mut tree = BoxTree {
            nodes: Vec::with_capacity(boxes.len() / WIDTH * 8 / 7 + 2),
        };
        let mut items: Vec<Item<D>> = boxes
            .enumerate()
            .map(|(number, (low, high))| Item {
                low,
                high,
                number: number as u32,
            })
            .collect();
        tree.build(&mut items);
        tree
    }

    /// Adds the node of these boxes and those below it; answers its number.
    fn build(&mut self, items: &mut [Item<D>]) -> u32 {
        let number = self.nodes.len();
        self.nodes.push(Node::new(items.len() <= WIDTH));
        if items.len() <= WIDTH {
            for (place, item) in items.iter().enumerate() {
                self.nodes[number].set(place, &item.low, &item.high, item.number);
            }
            return number as u32;
        }
        let mut capacity = WIDTH;
        while capacity * WIDTH < items.len() {
            capacity *= WIDTH;
        }
        let mut place = 0;
        divide(items, capacity, &mut |part| {
            let child = self.build(part);
            let (low, high) = around(part);
            self.nodes[number].set(place, &low, &high, child);
            place += 1;
        });
        number as u32
    }

    /// Calls `visit` for every box that the segment meets up to `limit`, a fraction of its length,
    /// with the box's number and the points where the segment enters and leaves it. The return
    /// value of `visit` becomes the new limit; below zero it ends the search.
    #[inline]
    pub fn cast(
        &self,
        ray: &Ray<D>,
        mut limit: f64,
        mut visit: impl FnMut(u32, f64, f64, f64) -> f64,
    ) {
        let mut waiting = [0u32; WAITING];
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let node = &self.nodes[waiting[count] as usize];
            let (enter, leave) = node.clip(ray, limit);
            for place in 0..WIDTH {
                if enter[place] <= leave[place] && enter[place] <= limit {
                    if node.is_leaf {
                        limit = visit(node.children[place], enter[place], leave[place], limit);
                        if limit < 0.0 {
                            return;
                        }
                    } else {
                        waiting[count] = node.children[place];
                        count += 1;
                    }
                }
            }
        }
    }
}

struct Item<const D: usize> {
    low: Vector<D>,
    high: Vector<D>,
    number: u32,
}

/// The smallest box around these.
fn around<const D: usize>(items: &[Item<D>]) -> (Vector<D>, Vector<D>) {
    let (mut low, mut high) = ([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
    for item in items {
        for axis in 0..D {
            low[axis] = if item.low[axis] < low[axis] {
                item.low[axis]
            } else {
                low[axis]
            };
            high[axis] = if item.high[axis] > high[axis] {
                item.high[axis]
            } else {
                high[axis]
            };
        }
    }
    (low, high)
}

/// Divides the boxes into parts of at most `capacity` that are near together, all full but one.
fn divide<const D: usize>(
    items: &mut [Item<D>],
    capacity: usize,
    visit: &mut impl FnMut(&mut [Item<D>]),
) {
    let parts = items.len().div_ceil(capacity);
    if parts <= 1 {
        return visit(items);
    }
    // Twice the centre; that of a box without limits both ways is put at zero.
    let center = |item: &Item<D>, axis: usize| {
        let sum = item.low[axis] + item.high[axis];
        if sum.is_nan() { 0.0 } else { sum }
    };
    let (mut axis, mut widest) = (0, -1.0);
    for candidate in 0..D {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for item in items.iter() {
            let at = center(item, candidate);
            low = if at < low { at } else { low };
            high = if at > high { at } else { high };
        }
        if high - low > widest {
            (axis, widest) = (candidate, high - low);
        }
    }
    let middle = parts / 2 * capacity;
    items.select_nth_unstable_by(middle, |a, b| {
        center(a, axis)
            .total_cmp(&center(b, axis))
            .then(a.number.cmp(&b.number))
    });
    let (below, above) = items.split_at_mut(middle);
    divide(below, capacity, visit);
    divide(above, capacity, visit);
}
