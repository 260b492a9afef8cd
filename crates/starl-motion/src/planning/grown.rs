//! Obstacles grown by the robot's body, so that the robot becomes a point.
//!
//! A robot is an upright cylinder and an obstacle a convex base times a vertical interval; the places
//! the robot's base centre must not be at are therefore the base moved outwards by the robot's
//! radius, with round corners, times a longer interval (the Minkowski sum; Lozano-Perez 1983,
//! "Spatial planning: a configuration space approach"). Exact, nothing is sampled or approximated.

use super::box_tree::Ray;
use super::vector::Vector;
use alloc::vec::Vec;
use starl_core::math;

/// What a point must keep out of, boundary included: a convex outline in the first two coordinates,
/// an interval in the third where there is one.
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
}

/// A corner of an outline and the way to the next.
#[derive(Clone, Copy, Debug)]
struct Corner {
    at: [f64; 2],
    /// Unit vector.
    along: [f64; 2],
    length: f64,
}

/// Grown obstacles and their corners.
#[derive(Clone, Debug, Default)]
pub struct GrownList<const D: usize> {
    list: Vec<Grown<D>>,
    corners: Vec<Corner>,
}

impl<const D: usize> GrownList<D> {
    /// The empty list.
    pub const fn new() -> Self {
        GrownList {
            list: Vec::new(),
            corners: Vec::new(),
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
        });
    }

    /// The part of the segment that is in the obstacle, as fractions of its length; `inside` is the
    /// part in the obstacle's box.
    #[inline]
    pub fn clip(&self, number: u32, ray: &Ray<D>, inside: (f64, f64)) -> Option<(f64, f64)> {
        let grown = &self.list[number as usize];
        if grown.count == 0 {
            return Some(inside);
        }
        let corners = self.corners(grown);
        let (enter, leave) = clip_outline(corners, grown.radius, ray);
        let enter = if enter > inside.0 { enter } else { inside.0 };
        let leave = if leave < inside.1 { leave } else { inside.1 };
        (enter <= leave).then_some((enter, leave))
    }

    /// Whether the segment keeps clear of all of them; looks at every one.
    pub fn is_clear(&self, a: &Vector<D>, b: &Vector<D>) -> bool {
        let ray = Ray::new(a, b);
        (0u32..).zip(&self.list).all(|(number, grown)| {
            let inside = ray.clip(&grown.low, &grown.high, 1.0);
            inside.is_none_or(|inside| self.clip(number, &ray, inside).is_none())
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

/// Where the line through the segment enters and leaves the outline; the first is greater if it does
/// not. The outline is the union of the polygon, a strip on either side of each edge and a disc about
/// each corner, and convex: it is entered where the first of these is and left where the last is.
fn clip_outline<const D: usize>(corners: &[Corner], radius: f64, ray: &Ray<D>) -> (f64, f64) {
    let mut whole = (f64::INFINITY, f64::NEG_INFINITY);
    let mut unite = |(enter, leave): (f64, f64)| {
        if enter <= leave {
            whole.0 = if enter < whole.0 { enter } else { whole.0 };
            whole.1 = if leave > whole.1 { leave } else { whole.1 };
        }
    };
    let (way_x, way_y) = (ray.way[0], ray.way[1]);
    let squared = way_x * way_x + way_y * way_y;
    let mut polygon = (f64::NEG_INFINITY, f64::INFINITY);
    for corner in corners {
        let (x, y) = (ray.from[0] - corner.at[0], ray.from[1] - corner.at[1]);
        let [along_x, along_y] = corner.along;
        let start = (x * along_x + y * along_y, along_x * y - along_y * x);
        let rate = (
            way_x * along_x + way_y * along_y,
            along_x * way_y - along_y * way_x,
        );
        polygon = common(polygon, within(start.1, rate.1, 0.0, f64::INFINITY));
        if corners.len() > 1 {
            let strip = within(start.1, rate.1, -radius, radius);
            unite(common(strip, within(start.0, rate.0, 0.0, corner.length)));
        }
        if radius > 0.0 {
            unite(within_disc(
                x * way_x + y * way_y,
                squared,
                x * x + y * y - radius * radius,
            ));
        }
    }
    if corners.len() > 2 {
        unite(polygon);
    }
    whole
}

/// The times at which `start + rate * time` lies in the interval.
fn within(start: f64, rate: f64, low: f64, high: f64) -> (f64, f64) {
    if rate == 0.0 {
        let inside = low <= start && start <= high;
        return if inside { EVER } else { NEVER };
    }
    let (a, b) = ((low - start) / rate, (high - start) / rate);
    if rate > 0.0 { (a, b) } else { (b, a) }
}

/// The times at which `squared * time^2 + 2 * half * time + rest` is not above zero.
fn within_disc(half: f64, squared: f64, rest: f64) -> (f64, f64) {
    let discriminant = half * half - squared * rest;
    if squared == 0.0 {
        return if rest <= 0.0 { EVER } else { NEVER };
    }
    if discriminant < 0.0 {
        return NEVER;
    }
    let root = math::sqrt(discriminant);
    ((-half - root) / squared, (root - half) / squared)
}

const EVER: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);
const NEVER: (f64, f64) = (f64::INFINITY, f64::NEG_INFINITY);

fn common(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    (
        if a.0 > b.0 { a.0 } else { b.0 },
        if a.1 < b.1 { a.1 } else { b.1 },
    )
}
