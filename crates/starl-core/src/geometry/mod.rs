//! Points, poses and obstacles in one common right-handed frame: metres, radians, z up.

mod area;
mod bounds;
mod grid;
mod obstacle;
mod obstacle_index;
mod obstacle_path;
mod point;
mod polygon;
mod pose;
mod segment;

pub use area::Area;
pub use bounds::{Bounds, HeightSpan};
pub use obstacle::{Obstacle, Shape};
pub use obstacle_index::ObstacleIndex;
pub use point::Point;
pub use polygon::{ConvexPolygon, PolygonError};
pub use pose::{Pose, Twist};
