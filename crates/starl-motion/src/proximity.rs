//! Distances along rays from the edge of a body to obstacles and other bodies: a laser scanner, or a ring of
//! proximity sensors.

use crate::Neighbour;
use crate::scene::Scene;
use alloc::vec::Vec;
use starl_core::Point;
use starl_core::geometry::Bounds;
use starl_core::math;

/// Rays evenly round a body, the first straight ahead.
#[derive(Clone, Debug)]
pub struct Rays {
    /// Direction of each ray from the robot's heading, radians in (-pi, pi], left positive.
    pub bearings: Vec<f64>,
    /// How far they see beyond the body's edge, metres.
    pub range: f64,
    /// Sine and cosine of each bearing.
    directions: Vec<(f64, f64)>,
}

impl Rays {
    /// This number of rays of this range, metres.
    pub fn even(count: u32, range: f64) -> Rays {
        let bearing = |ray| math::wrap_angle(math::TAU * f64::from(ray) / f64::from(count));
        let bearings: Vec<f64> = (0..count).map(bearing).collect();
        let directions = bearings.iter().map(|&bearing| math::sincos(bearing));
        Rays {
            directions: directions.collect(),
            bearings,
            range,
        }
    }

    /// Calls `meets` with each ray that meets something in its range and the distance to that from the edge of the
    /// body, metres. `nearby` is room for work. Returns false at once if nothing is in the range of any ray.
    pub fn measure(
        &self,
        scene: &Scene<'_>,
        robot: usize,
        yaw: f64,
        nearby: &mut Vec<Neighbour>,
        mut meets: impl FnMut(usize, f64),
    ) -> bool {
        let body = &scene.bodies[robot];
        let reach = body.radius + self.range;
        nearby.clear();
        let center = body.position;
        let farthest = reach + scene.grid.greatest_radius();
        scene.grid.for_each_near(center, farthest, |entry| {
            let apart = reach + f64::from(entry.radius);
            let other = entry.robot as usize;
            if other != robot && entry.distance_squared(center) < apart * apart {
                let other = &scene.bodies[other];
                if same_height(body, other) {
                    nearby.push(*other);
                }
            }
        });
        let window = Bounds::of_segment(center, center).inflated(reach);
        let obstacles = scene.map.any_near(&window, |_| true);
        if nearby.is_empty() && !obstacles {
            return false;
        }
        let (sin, cos) = math::sincos(yaw);
        for (ray, &(ray_sin, ray_cos)) in self.directions.iter().enumerate() {
            let direction =
                Point::planar(cos * ray_cos - sin * ray_sin, sin * ray_cos + cos * ray_sin);
            let mut met = reach;
            for other in &*nearby {
                met = met.min(to_circle(center, direction, other.position, other.radius));
            }
            if obstacles {
                let eye = center.at_height(center.z + body.height * 0.5);
                if let Some((_, distance)) = scene.map.ray(eye, direction, met) {
                    met = met.min(distance);
                }
            }
            if met < reach {
                meets(ray, (met - body.radius).clamp(0.0, self.range));
            }
        }
        true
    }
}

/// Whether two bodies overlap in height.
fn same_height(a: &Neighbour, b: &Neighbour) -> bool {
    a.position.z < b.position.z + b.height && b.position.z < a.position.z + a.height
}

/// Distance along a ray to a circle's edge; infinite if it misses.
fn to_circle(origin: Point, direction: Point, center: Point, radius: f64) -> f64 {
    let to = center - origin;
    let along = to.x * direction.x + to.y * direction.y;
    let aside = to.cross_planar(direction);
    let half_chord_squared = radius * radius - aside * aside;
    if half_chord_squared < 0.0 || along < 0.0 {
        return f64::INFINITY;
    }
    (along - math::sqrt(half_chord_squared)).max(0.0)
}
