//! The space planners search: a box of the world less the grown obstacles.

use super::box_tree::BoxTree;
use super::grown::GrownList;
use super::ray::Ray;
use super::space::{Reach, Space};
use super::vector::Vector;
use starl_core::Random;

/// A box of the world and the obstacles in it. Obstacles may stick out of the box; planners stay in.
#[derive(Clone, Debug)]
pub struct FreeSpace<const D: usize> {
    low: Vector<D>,
    high: Vector<D>,
    grown: GrownList<D>,
    tree: BoxTree<D>,
}

impl<const D: usize> FreeSpace<D> {
    /// The free space between these corners.
    pub fn new(low: Vector<D>, high: Vector<D>, grown: GrownList<D>) -> Self {
        let tree = BoxTree::new(grown.all().iter().map(|grown| (grown.low, grown.high)));
        FreeSpace {
            low,
            high,
            grown,
            tree,
        }
    }

    /// The corners of the box.
    pub fn bounds(&self) -> (&Vector<D>, &Vector<D>) {
        (&self.low, &self.high)
    }

    /// The obstacles.
    pub fn obstacles(&self) -> &GrownList<D> {
        &self.grown
    }

    fn contains(&self, point: &Vector<D>) -> bool {
        (0..D).all(|axis| self.low[axis] <= point[axis] && point[axis] <= self.high[axis])
    }

    /// A place off a random corner or edge of the bounds of a random obstacle, by up to a tenth of
    /// the longest side of those bounds, more often less.
    fn near_corner(&self, random: &mut Random) -> Vector<D> {
        let all = self.grown.all();
        let grown = &all[random.below(all.len() as u32) as usize];
        let edge = if D > 2 {
            random.below(D as u32) as usize
        } else {
            D
        };
        let sides = random.bits();
        let longest = (0..2).fold(0.0, |most, axis| {
            let side = grown.high[axis] - grown.low[axis];
            if side > most { side } else { most }
        });
        let part = random.uniform();
        let off = 0.1 * longest * part * part;
        core::array::from_fn(|axis| {
            let (low, high) = (grown.low[axis], grown.high[axis]);
            let side = if (sides >> axis) & 1 == 0 {
                low - off
            } else {
                high + off
            };
            // Where an obstacle sticks out of the box one can only be beside it.
            if axis != edge && self.low[axis] <= side && side <= self.high[axis] {
                return side;
            }
            let low = if low > self.low[axis] {
                low
            } else {
                self.low[axis]
            };
            let high = if high < self.high[axis] {
                high
            } else {
                self.high[axis]
            };
            random.between(low, high)
        })
    }

    /// Whether the segment is clear of all obstacles, inside or outside the box.
    #[inline]
    pub fn is_clear(&self, a: &Vector<D>, b: &Vector<D>) -> bool {
        let ray = Ray::new(a, b);
        let mut free = true;
        self.tree.cast(&ray, 1.0, |number, enter, leave, limit| {
            match self.grown.met(number, &ray, (enter, leave)) {
                Some(_) => {
                    free = false;
                    -1.0
                }
                None => limit,
            }
        });
        free
    }

    /// Calls `visit` with every obstacle the segment meets, dents left out, and the part of it inside,
    /// as fractions.
    pub fn for_each_met(&self, a: &Vector<D>, b: &Vector<D>, mut visit: impl FnMut(u32, f64, f64)) {
        let ray = Ray::new(a, b);
        self.tree.cast(&ray, 1.0, |number, enter, leave, limit| {
            if let Some((enter, leave)) = self.grown.clip(number, &ray, (enter, leave)) {
                visit(number, enter, leave);
            }
            limit
        });
    }
}

impl<const D: usize> Space<D> for FreeSpace<D> {
    /// Half of the samples are uniform in the box. The others lie just off a corner, or in space an
    /// edge, of an obstacle's bounds, because that is what shortest paths turn about and where narrow
    /// passages are (after Amato and others 1998, "OBPRM: an obstacle-based PRM for 3D workspaces").
    fn sample(&self, random: &mut Random) -> Vector<D> {
        if random.bits() & 1 == 0 && !self.grown.all().is_empty() {
            for _ in 0..CORNERS_TRIED {
                let place = self.near_corner(random);
                if self.is_free(&place) {
                    return place;
                }
            }
        }
        core::array::from_fn(|axis| random.between(self.low[axis], self.high[axis]))
    }

    fn volume(&self) -> f64 {
        (0..D)
            .map(|axis| self.high[axis] - self.low[axis])
            .product()
    }

    #[inline]
    fn reach(&self, a: &Vector<D>, b: &Vector<D>) -> Reach<D> {
        let ray = Ray::new(a, b);
        let Some((0.0, inside)) = ray.clip(&self.low, &self.high, 1.0) else {
            return Reach::NONE;
        };
        let mut met = None;
        self.tree.cast(&ray, inside, |number, enter, leave, limit| {
            match self.grown.met(number, &ray, (enter, leave)) {
                // In its box it may be come to after something else that has been found.
                Some(enter) if enter <= limit => {
                    met = Some((number, enter));
                    if enter > 0.0 { enter } else { -1.0 }
                }
                _ => limit,
            }
        });
        match met {
            Some((number, enter)) => Reach {
                free: enter * SHORT_OF,
                wall: self.grown.normal(number, &ray, enter),
            },
            None if inside < 1.0 => Reach {
                free: inside * SHORT_OF,
                wall: None,
            },
            None => Reach::ALL,
        }
    }

    #[inline]
    fn sees(&self, a: &Vector<D>, b: &Vector<D>) -> bool {
        self.contains(a) && self.contains(b) && self.is_clear(a, b)
    }
}

/// Corners drawn before settling for a uniform sample.
const CORNERS_TRIED: u32 = 8;

/// The part of the way to an obstacle that a robot drives, so that its end is free whatever the rounding.
const SHORT_OF: f64 = 1.0 - 1e-6;
