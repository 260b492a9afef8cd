//! Sensor readings of one robot, computed from the true state of the world at a step's start.

use super::shared::Shared;
use crate::scenario::{Detector, Proximity};
use starl_core::geometry::Bounds;
use starl_core::math;
use starl_core::sensor::{Detected, Detection, Ray};
use starl_core::{Point, Pose, RobotId};
use starl_motion::Neighbour;

/// Room for readings, used over and over.
#[derive(Clone, Debug, Default)]
pub struct Readings {
    pub proximity: Vec<Ray>,
    pub detections: Vec<Detection>,
    /// Whether `proximity` shows anything but empty space for the sensor it was laid out for.
    marked: bool,
    laid_out_for: Option<Proximity>,
    nearby: Vec<Neighbour>,
}

impl Readings {
    /// Measures distances along rays from the body's edge.
    pub fn measure(&mut self, shared: &Shared, robot: RobotId, pose: &Pose, sensor: &Proximity) {
        self.lay_out(sensor);
        let body = &shared.bodies[robot.index()];
        let reach = body.radius + sensor.range;
        self.nearby.clear();
        let center = body.position;
        shared
            .grid
            .for_each_near(center, reach + shared.grid.greatest_radius(), |entry| {
                let apart = reach + f64::from(entry.radius);
                if entry.robot != robot.0 && entry.distance_squared(center) < apart * apart {
                    let other = &shared.bodies[entry.robot as usize];
                    if same_height(body, other) {
                        self.nearby.push(*other);
                    }
                }
            });
        let window = Bounds::of_segment(center, center).inflated(reach);
        let obstacles = shared.map.any_near(&window, |_| true);
        if self.nearby.is_empty() && !obstacles {
            return;
        }
        self.marked = true;
        let (sin, cos) = math::sincos(pose.yaw);
        for ray in &mut self.proximity {
            let (ray_sin, ray_cos) = math::sincos(ray.bearing);
            let direction =
                Point::planar(cos * ray_cos - sin * ray_sin, sin * ray_cos + cos * ray_sin);
            let mut met = reach;
            for other in &self.nearby {
                met = met.min(ray_to_circle(
                    center,
                    direction,
                    other.position,
                    other.radius,
                ));
            }
            if obstacles {
                let eye = center.at_height(center.z + body.height * 0.5);
                if let Some((_, distance)) = shared.map.ray(eye, direction, met) {
                    met = met.min(distance);
                }
            }
            if met < reach {
                ray.distance = (met - body.radius).clamp(0.0, sensor.range);
                ray.nearness = nearness(ray.distance / sensor.range);
            }
        }
    }

    fn lay_out(&mut self, sensor: &Proximity) {
        if self.laid_out_for != Some(*sensor) {
            self.laid_out_for = Some(*sensor);
            self.proximity.clear();
            self.proximity.extend((0..sensor.rays).map(|ray| Ray {
                bearing: math::wrap_angle(math::TAU * f64::from(ray) / f64::from(sensor.rays)),
                distance: sensor.range,
                nearness: 0.0,
            }));
        } else if self.marked {
            for ray in &mut self.proximity {
                ray.distance = sensor.range;
                ray.nearness = 0.0;
            }
        }
        self.marked = false;
    }

    /// Sees things and robots in range and line of sight, nearest first.
    pub fn detect(&mut self, shared: &Shared, robot: RobotId, sensor: &Detector) {
        self.detections.clear();
        let body = &shared.bodies[robot.index()];
        let eye = body.position;
        for (index, position) in shared.things.lying() {
            if position.planar_distance(eye) <= sensor.range
                && !shared.map.blocks_segment(eye, position, 0.0)
            {
                let what = Detected::Thing(index);
                self.detections.push(Detection { what, position });
            }
        }
        shared.grid.for_each_within(eye, sensor.range, |entry| {
            let position = shared.bodies[entry.robot as usize].position;
            if entry.robot != robot.0 && !shared.map.blocks_segment(eye, position, 0.0) {
                let what = Detected::Robot(entry.robot());
                self.detections.push(Detection { what, position });
            }
        });
        // The grid's order is fixed, so that equal distances keep one order too.
        self.detections.sort_by(|a, b| {
            a.position
                .planar_distance(eye)
                .total_cmp(&b.position.planar_distance(eye))
        });
    }

    /// No readings.
    pub fn clear(&mut self) {
        self.proximity.clear();
        self.detections.clear();
        self.laid_out_for = None;
    }
}

/// Whether two bodies overlap in height.
pub fn same_height(a: &Neighbour, b: &Neighbour) -> bool {
    a.position.z < b.position.z + b.height && b.position.z < a.position.z + a.height
}

/// Distance along a ray to a circle's edge; infinite if it misses.
fn ray_to_circle(origin: Point, direction: Point, center: Point, radius: f64) -> f64 {
    let to = center - origin;
    let along = to.x * direction.x + to.y * direction.y;
    let aside = to.cross_planar(direction);
    let half_chord_squared = radius * radius - aside * aside;
    if half_chord_squared < 0.0 || along < 0.0 {
        return f64::INFINITY;
    }
    (along - half_chord_squared.sqrt()).max(0.0)
}

/// 1 at contact, 0 at the end of the range, falling exponentially between.
fn nearness(fraction: f64) -> f64 {
    const STEEPNESS: f64 = 3.0;
    let end = math::exp(-STEEPNESS);
    ((math::exp(-STEEPNESS * fraction) - end) / (1.0 - end)).max(0.0)
}
