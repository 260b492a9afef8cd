//! Regions of the world to which messages and tasks are addressed.

use super::segment::{greater, outside_both, rectangle_distance};
use super::{ConvexPolygon, Point};
use serde::{Deserialize, Serialize};

/// A region, boundary included. Circle and polygon reach from the floor to the sky.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Area {
    /// All points at most `radius` from the centre, heights left out.
    Circle {
        /// The centre; its height is ignored.
        center: Point,
        /// Metres.
        radius: f64,
    },
    /// All points above and below a polygon.
    Polygon(ConvexPolygon),
    /// All points between two corners, heights included.
    Box {
        /// The corner with the least coordinates, metres.
        low: Point,
        /// The corner with the greatest coordinates, metres.
        high: Point,
    },
}

impl Area {
    /// Whether the point lies in the area or on its boundary.
    pub fn contains(&self, p: Point) -> bool {
        match self {
            Area::Circle { center, radius } => {
                let (x, y) = (p.x - center.x, p.y - center.y);
                x * x + y * y <= radius * radius
            }
            Area::Polygon(polygon) => polygon.contains(p),
            Area::Box { low, high } => {
                (low.x <= p.x && p.x <= high.x)
                    && (low.y <= p.y && p.y <= high.y)
                    && (low.z <= p.z && p.z <= high.z)
            }
        }
    }

    /// Distance to the area, metres; zero inside. Planar for circle and polygon.
    pub fn distance(&self, p: Point) -> f64 {
        let outside = match self {
            Area::Circle { center, radius } => center.planar_distance(p) - radius,
            Area::Polygon(polygon) => polygon.signed_distance(p),
            Area::Box { low, high } => {
                let vertical = greater(low.z - p.z, p.z - high.z);
                outside_both(rectangle_distance(p, *low, *high), vertical)
            }
        };
        if self.contains(p) {
            0.0
        } else {
            greater(outside, 0.0)
        }
    }

    /// Whether all numbers are finite, the radius is not negative and the corners are in order.
    pub fn is_valid(&self) -> bool {
        match self {
            Area::Circle { center, radius } => {
                center.is_finite() && radius.is_finite() && *radius >= 0.0
            }
            Area::Polygon(_) => true,
            Area::Box { low, high } => {
                low.is_finite()
                    && high.is_finite()
                    && low.x <= high.x
                    && low.y <= high.y
                    && low.z <= high.z
            }
        }
    }
}
