//! Obstacles grown by the robot's body, so that the robot becomes a point.
//!
//! A robot is an upright cylinder and an obstacle a convex base times a vertical interval; the places
//! the robot's base centre must not be at are therefore the base moved outwards by the robot's
//! radius, with round corners, times a longer interval (the Minkowski sum; Lozano-Perez 1983,
//! "Spatial planning: a configuration space approach"). Exact, nothing is sampled or approximated.
//! Near the ends of a path an obstacle may be grown by less; see `dent.rs`.

use super::dent::{self, Dent};
use super::outline::{Corner, clip_outline};
use super::ray::Ray;
use super::vector::Vector;
use alloc::vec::Vec;
use starl_core::math;

/// An obstacle for a point, boundary included: a convex outline in the first two coordinates, and
/// an interval in the third if there is one.
#[derive(Clone, Copy, Debug)]
pub struct Grown<const D: usize> {
    /// The smallest box around it.
    pub low: Vector<D>,
    /// The smallest box around it.
    pub high: Vector<D>,
    /// The outline's corners among those of its list; none if it is the whole box.
    first: u32,
    count: u32,
    /// Everything this near to the polygon of the corners belongs to the outline, metres.
    radius: f64,
    /// Its dents are the ones from the first number up to the second of its list.
    dents: (u32, u32),
}

/// Grown obstacles and their corners.
#[derive(Clone, Debug, Default)]
pub struct GrownList<const D: usize> {
    list: Vec<Grown<D>>,
    corners: Vec<Corner>,
    dents: Vec<Dent<D, Grown<D>>>,
}

impl<const D: usize> GrownList<D> {
    /// The empty list.
    pub const fn new() -> Self {
        GrownList {
            list: Vec::new(),
            corners: Vec::new(),
            dents: Vec::new(),
        }
    }

    /// The obstacles in the order they were added.
    pub fn all(&self) -> &[Grown<D>] {
        &self.list
    }

    /// Adds a box.
    pub fn push_box(&mut self, low: Vector<D>, high: Vector<D>) {
        self.list.push(Grown {
            low,
            high,
            first: 0,
            count: 0,
            radius: 0.0,
            dents: (0, 0),
        });
    }

    /// Adds everything within `radius` metres of a convex polygon in the first two coordinates, its
    /// corners counter-clockwise (one for a circle, two for a wall), and within `span` in the third.
    pub fn push_round(
        &mut self,
        corners: impl Iterator<Item = [f64; 2]> + Clone,
        radius: f64,
        span: (f64, f64),
    ) {
        let first = self.corners.len();
        let (mut low, mut high) = ([span.0; D], [span.1; D]);
        (low[0], low[1]) = (f64::INFINITY, f64::INFINITY);
        (high[0], high[1]) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
        for (at, next) in corners
            .clone()
            .zip(corners.clone().skip(1).chain(corners.take(1)))
        {
            let way = [next[0] - at[0], next[1] - at[1]];
            let length = math::sqrt(way[0] * way[0] + way[1] * way[1]);
            let along = if length > 0.0 {
                way.map(|way| way / length)
            } else {
                [1.0, 0.0]
            };
            for axis in 0..2 {
                low[axis] = low[axis].min(at[axis] - radius);
                high[axis] = high[axis].max(at[axis] + radius);
            }
            self.corners.push(Corner { at, along, length });
        }
        let count = (self.corners.len() - first) as u32;
        self.list.push(Grown {
            low,
            high,
            first: first as u32,
            count,
            radius,
            dents: (0, 0),
        });
    }

    /// Dents the obstacle added last, which has corners: within `radius` metres of `center` it is
    /// as if it had been grown by `less` metres less, in all directions.
    pub fn dent_last(&mut self, center: Vector<D>, radius: f64, less: f64) {
        let Some(last) = self.list.last_mut() else {
            return;
        };
        let mut inner = *last;
        inner.radius -= less;
        inner.low = inner.low.map(|low| low + less);
        inner.high = inner.high.map(|high| high - less);
        if last.dents.1 == 0 {
            last.dents.0 = self.dents.len() as u32;
        }
        self.dents.push(Dent {
            center,
            radius,
            inner,
        });
        last.dents.1 = self.dents.len() as u32;
    }

    /// The part of the segment that is in the obstacle, dents left out, as fractions of its length;
    /// `inside` is the part in the obstacle's box.
    #[inline]
    pub fn clip(&self, number: u32, ray: &Ray<D>, inside: (f64, f64)) -> Option<(f64, f64)> {
        self.clip_grown(&self.list[number as usize], ray, inside)
    }

    #[inline]
    fn clip_grown(&self, grown: &Grown<D>, ray: &Ray<D>, inside: (f64, f64)) -> Option<(f64, f64)> {
        if grown.count == 0 {
            return Some(inside);
        }
        let corners = self.corners(grown);
        let (enter, leave) = clip_outline(corners, grown.radius, ray);
        let enter = if enter > inside.0 { enter } else { inside.0 };
        let leave = if leave < inside.1 { leave } else { inside.1 };
        (enter <= leave).then_some((enter, leave))
    }

    /// Where the segment is first in the obstacle, its dents taken into account, as a fraction of its
    /// length; `inside` as in [`GrownList::clip`].
    #[inline]
    pub fn met(&self, number: u32, ray: &Ray<D>, inside: (f64, f64)) -> Option<f64> {
        let part = self.clip(number, ray, inside)?;
        match self.list[number as usize].dents {
            (_, 0) => Some(part.0),
            (from, to) => {
                let dents = &self.dents[from as usize..to as usize];
                dent::first_met(dents, ray, part, |inner| {
                    let inside = ray.clip(&inner.low, &inner.high, 1.0)?;
                    self.clip_grown(inner, ray, inside)
                })
            }
        }
    }

    /// Whether the segment is clear of all of them; checks every one.
    pub fn is_clear(&self, a: &Vector<D>, b: &Vector<D>) -> bool {
        let ray = Ray::new(a, b);
        (0u32..).zip(&self.list).all(|(number, grown)| {
            let inside = ray.clip(&grown.low, &grown.high, 1.0);
            inside.is_none_or(|inside| self.met(number, &ray, inside).is_none())
        })
    }

    /// The unit vector across the surface where the segment enters the obstacle, at the fraction
    /// `enter` of its length; its sign means nothing.
    pub fn normal(&self, number: u32, ray: &Ray<D>, enter: f64) -> Option<Vector<D>> {
        let grown = &self.list[number as usize];
        let sides = if grown.count == 0 { 0 } else { 2 };
        let (mut axis, mut latest) = (D, f64::NEG_INFINITY);
        for candidate in sides..D {
            let at = ray.enters(candidate, grown.low[candidate], grown.high[candidate]);
            if at > latest {
                (axis, latest) = (candidate, at);
            }
        }
        let mut normal = [0.0; D];
        if axis < D && (sides == 0 || latest >= enter) {
            normal[axis] = 1.0;
            return Some(normal);
        }
        let point = core::array::from_fn(|axis| ray.from[axis] + enter * ray.way[axis]);
        // On the surface the way from the polygon is as long as the radius, or no way at all.
        let across = match self.gap(number, &point) {
            Some((_, across)) if grown.radius > 0.0 => across,
            _ => self.edge_normal(grown, &point)?,
        };
        (normal[0], normal[1]) = (across[0], across[1]);
        Some(normal)
    }

    /// The unit vector across the edge whose line the point is farthest outside of.
    fn edge_normal(&self, grown: &Grown<D>, point: &Vector<D>) -> Option<[f64; 2]> {
        let corners = self.corners(grown);
        let outside = |corner: &Corner| {
            let offset = [point[0] - corner.at[0], point[1] - corner.at[1]];
            corner.along[1] * offset[0] - corner.along[0] * offset[1]
        };
        let farthest = corners
            .iter()
            .max_by(|a, b| outside(a).total_cmp(&outside(b)))?;
        Some([farthest.along[1], -farthest.along[0]])
    }

    fn corners(&self, grown: &Grown<D>) -> &[Corner] {
        &self.corners[grown.first as usize..(grown.first + grown.count) as usize]
    }

    /// Planar distance from a point to the polygon of the corners less the radius, metres (negative
    /// inside the outline), and the unit vector straight away from the polygon; none on it, or if
    /// the outline is a box.
    pub fn gap(&self, number: u32, point: &Vector<D>) -> Option<(f64, [f64; 2])> {
        let grown = &self.list[number as usize];
        let corners = self.corners(grown);
        let mut nearest = (f64::INFINITY, [0.0; 2]);
        let mut inside = corners.len() > 2;
        for corner in corners {
            let offset = [point[0] - corner.at[0], point[1] - corner.at[1]];
            let along = offset[0] * corner.along[0] + offset[1] * corner.along[1];
            let left = corner.along[0] * offset[1] - corner.along[1] * offset[0];
            inside &= left >= 0.0;
            let along = along.clamp(0.0, corner.length);
            let away = [
                offset[0] - along * corner.along[0],
                offset[1] - along * corner.along[1],
            ];
            let squared = away[0] * away[0] + away[1] * away[1];
            if squared < nearest.0 {
                nearest = (squared, away);
            }
        }
        let distance = math::sqrt(nearest.0);
        (!inside && distance > 0.0 && distance.is_finite()).then(|| {
            (
                distance - grown.radius,
                nearest.1.map(|away| away / distance),
            )
        })
    }
}
