//! Things robots must not touch.
//!
//! Every obstacle is a convex base in the floor plane times a vertical interval, so distances split
//! into a planar and a vertical part. A base without a height reaches from below the floor to the sky.
//! Queries about paths and rays are in `obstacle_path.rs`.

use super::segment::{greater, lesser, nearest_on_segment, outside_both, rectangle_distance};
use super::{Area, Bounds, ConvexPolygon, HeightSpan, Point};
use serde::{Deserialize, Serialize};

/// A thing robots must not touch, boundary included.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Obstacle {
    /// Where it is.
    pub shape: Shape,
}

/// The shape and place of an [`Obstacle`]. A height of `None` means from the floor to the sky,
/// unbounded both ways.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Shape {
    /// A prism over a polygon, or a wall.
    Polygon {
        /// The outline.
        base: ConvexPolygon,
        /// Its heights.
        height: Option<HeightSpan>,
    },
    /// An upright cylinder.
    Circle {
        /// The centre; its height is ignored.
        center: Point,
        /// Metres.
        radius: f64,
        /// Its heights.
        height: Option<HeightSpan>,
    },
    /// A box with sides along the axes.
    Cuboid {
        /// The corner with the least coordinates, metres.
        low: Point,
        /// The corner with the greatest coordinates, metres.
        high: Point,
    },
}

impl From<Area> for Obstacle {
    /// An obstacle that covers the whole area, from the floor to the sky unless it is a box.
    fn from(area: Area) -> Obstacle {
        match area {
            Area::Polygon(base) => Obstacle::polygon(base),
            Area::Circle { center, radius } => Obstacle::circle(center, radius),
            Area::Box { low, high } => Obstacle::cuboid(low, high),
        }
    }
}

impl Obstacle {
    /// A polygon or wall from the floor to the sky.
    pub const fn polygon(base: ConvexPolygon) -> Obstacle {
        Obstacle {
            shape: Shape::Polygon { base, height: None },
        }
    }

    /// An upright cylinder from the floor to the sky, radius in metres.
    pub const fn circle(center: Point, radius: f64) -> Obstacle {
        Obstacle {
            shape: Shape::Circle {
                center,
                radius,
                height: None,
            },
        }
    }

    /// The box with these opposite corners, sides along the axes.
    pub fn cuboid(low: Point, high: Point) -> Obstacle {
        let Bounds { low, high } = Bounds::of_segment(low, high);
        Obstacle {
            shape: Shape::Cuboid { low, high },
        }
    }

    /// The ground that it takes; of a box its heights too.
    pub fn area(&self) -> Area {
        match &self.shape {
            Shape::Polygon { base, .. } => Area::Polygon(base.clone()),
            &Shape::Circle { center, radius, .. } => Area::Circle { center, radius },
            &Shape::Cuboid { low, high } => Area::Box { low, high },
        }
    }

    /// This obstacle limited to these heights.
    pub fn with_height(mut self, span: HeightSpan) -> Obstacle {
        match &mut self.shape {
            Shape::Polygon { height, .. } | Shape::Circle { height, .. } => *height = Some(span),
            Shape::Cuboid { low, high } => (low.z, high.z) = (span.low, span.high),
        }
        self
    }

    /// The heights it fills; none if unbounded.
    #[inline]
    pub fn height(&self) -> Option<HeightSpan> {
        match &self.shape {
            Shape::Polygon { height, .. } | Shape::Circle { height, .. } => *height,
            Shape::Cuboid { low, high } => Some(HeightSpan::new(low.z, high.z)),
        }
    }

    /// Whether all numbers are finite, the radius is not negative and low is below high. Answers
    /// about an invalid obstacle mean nothing, but asking does no harm.
    pub fn is_valid(&self) -> bool {
        let base = match &self.shape {
            Shape::Polygon { .. } => true,
            Shape::Circle { center, radius, .. } => {
                center.is_finite() && radius.is_finite() && *radius >= 0.0
            }
            Shape::Cuboid { low, high } => {
                low.is_finite() && high.is_finite() && low.x <= high.x && low.y <= high.y
            }
        };
        base && self.height().is_none_or(HeightSpan::is_valid)
    }

    /// The smallest box around it, infinite in z if it has no height.
    pub fn bounds(&self) -> Bounds {
        let mut bounds = match &self.shape {
            Shape::Polygon { base, .. } => {
                let mut bounds = Bounds::of_segment(base.vertices()[0], base.vertices()[1]);
                for vertex in base.vertices() {
                    bounds.low.x = lesser(vertex.x, bounds.low.x);
                    bounds.low.y = lesser(vertex.y, bounds.low.y);
                    bounds.high.x = greater(vertex.x, bounds.high.x);
                    bounds.high.y = greater(vertex.y, bounds.high.y);
                }
                bounds
            }
            Shape::Circle { center, radius, .. } => Bounds {
                low: *center,
                high: *center,
            }
            .inflated(*radius),
            Shape::Cuboid { low, high } => {
                return Bounds {
                    low: *low,
                    high: *high,
                };
            }
        };
        let span = self
            .height()
            .unwrap_or(HeightSpan::new(f64::NEG_INFINITY, f64::INFINITY));
        (bounds.low.z, bounds.high.z) = (span.low, span.high);
        bounds
    }

    /// Whether the point lies in the obstacle or on its boundary.
    pub fn contains(&self, p: Point) -> bool {
        self.height().is_none_or(|span| span.contains(p.z)) && self.planar_contains(p)
    }

    /// Distance to the boundary, metres: negative inside. In space if the obstacle has a height,
    /// planar if it has none.
    pub fn distance(&self, p: Point) -> f64 {
        let planar = self.planar_distance(p);
        let Some(span) = self.height() else {
            return planar;
        };
        let vertical = span.signed_distance(p.z);
        if planar <= 0.0 && vertical <= 0.0 {
            greater(planar, vertical)
        } else {
            outside_both(planar, vertical)
        }
    }

    /// Gap in metres between the obstacle and an upright cylinder whose base centre is at `position`,
    /// radius and height in metres. Where their heights overlap this is the planar gap, negative if
    /// one reaches into the other; elsewhere the distance in space, never negative.
    ///
    /// A body standing exactly on top of an obstacle does not overlap it in height, so a floor slab
    /// stops no robot. A body whose top touches it from below does, and so does one whose base is
    /// at the height of an obstacle without thickness.
    pub fn body_gap(&self, position: Point, radius: f64, body_height: f64) -> f64 {
        let planar = self.planar_distance(position) - radius;
        let top = position.z + body_height;
        match self.height() {
            Some(span) if !overlaps_in_height(span, position.z, top) => {
                outside_both(planar, greater(span.low - top, position.z - span.high))
            }
            _ => planar,
        }
    }

    /// The nearest point of the boundary in the plane, at the height of `p`.
    pub fn nearest_point(&self, p: Point) -> Point {
        match &self.shape {
            Shape::Polygon { base, .. } => base.nearest_boundary_point(p),
            Shape::Circle { center, radius, .. } => {
                let away = (p - *center).at_height(0.0);
                let outward = away.normalized().unwrap_or(Point::planar(1.0, 0.0));
                (*center + outward * *radius).at_height(p.z)
            }
            Shape::Cuboid { low, high } => {
                let clamped = nearest_in_rectangle(p, *low, *high);
                if clamped != p {
                    return clamped;
                }
                let sides = [
                    (p.x - low.x, Point { x: low.x, ..p }),
                    (high.x - p.x, Point { x: high.x, ..p }),
                    (p.y - low.y, Point { y: low.y, ..p }),
                    (high.y - p.y, Point { y: high.y, ..p }),
                ];
                let nearer = |a: (f64, Point), b: (f64, Point)| if b.0 < a.0 { b } else { a };
                sides.into_iter().fold((f64::INFINITY, p), nearer).1
            }
        }
    }

    /// Whether the point lies in the base or on its boundary, heights left out.
    pub(super) fn planar_contains(&self, p: Point) -> bool {
        match &self.shape {
            Shape::Polygon { base, .. } => base.contains(p),
            Shape::Circle { .. } | Shape::Cuboid { .. } => self.planar_distance(p) <= 0.0,
        }
    }

    /// Planar distance to the boundary of the base, metres: negative inside.
    pub fn planar_distance(&self, p: Point) -> f64 {
        match &self.shape {
            Shape::Polygon { base, .. } => base.signed_distance(p),
            Shape::Circle { center, radius, .. } => center.planar_distance(p) - radius,
            Shape::Cuboid { low, high } => rectangle_distance(p, *low, *high),
        }
    }

    /// The nearest point of the base, inside included, at the height of `p`.
    pub(super) fn planar_nearest(&self, p: Point) -> Point {
        match &self.shape {
            Shape::Polygon { base, .. } if base.is_wall() => {
                nearest_on_segment(p, base.vertices()[0], base.vertices()[1])
            }
            Shape::Cuboid { low, high } => nearest_in_rectangle(p, *low, *high),
            _ if self.planar_contains(p) => p,
            _ => self.nearest_point(p),
        }
    }
}

/// Whether a body that fills the heights from `bottom` to `top` shares some with an obstacle; see
/// [`Obstacle::body_gap`] for the rule at the ends.
pub(super) fn overlaps_in_height(span: HeightSpan, bottom: f64, top: f64) -> bool {
    top >= span.low && (bottom < span.high || bottom <= span.low)
}

fn nearest_in_rectangle(p: Point, low: Point, high: Point) -> Point {
    let x = lesser(greater(p.x, low.x), high.x);
    let y = lesser(greater(p.y, low.y), high.y);
    Point::new(x, y, p.z)
}
