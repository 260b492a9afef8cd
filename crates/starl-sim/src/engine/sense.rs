//! Sensor readings of one robot, computed from the true state of the world at a step's start.

use super::shared::Shared;
use crate::scenario::{Detector, Proximity};
use starl_core::math;
use starl_core::sensor::{Detected, Detection, Ray};
use starl_core::{Pose, RobotId};
use starl_motion::Neighbour;
use starl_motion::proximity::{Rays, Scene};

/// Room for readings, used over and over.
#[derive(Clone, Debug, Default)]
pub struct Readings {
    pub proximity: Vec<Ray>,
    pub detections: Vec<Detection>,
    /// Whether `proximity` shows anything but empty space for the sensor it was laid out for.
    marked: bool,
    /// The rays of the sensor for which `proximity` is laid out.
    rays: Option<(Proximity, Rays)>,
    nearby: Vec<Neighbour>,
}

impl Readings {
    /// Measures distances along rays from the body's edge.
    pub fn measure(&mut self, shared: &Shared, robot: RobotId, pose: &Pose, sensor: &Proximity) {
        self.lay_out(sensor);
        let Some((_, rays)) = &self.rays else { return };
        let scene = Scene {
            bodies: &shared.bodies,
            grid: &shared.grid,
            map: &shared.map,
        };
        let readings = &mut self.proximity;
        let meets = |ray: usize, distance: f64| {
            readings[ray].distance = distance;
            readings[ray].nearness = nearness(distance / sensor.range);
        };
        self.marked = rays.measure(&scene, robot.index(), pose.yaw, &mut self.nearby, meets);
    }

    fn lay_out(&mut self, sensor: &Proximity) {
        if self.rays.as_ref().is_none_or(|(laid, _)| laid != sensor) {
            let rays = Rays::even(sensor.rays, sensor.range);
            self.proximity.clear();
            self.proximity
                .extend(rays.bearings.iter().map(|&bearing| Ray {
                    bearing,
                    distance: sensor.range,
                    nearness: 0.0,
                }));
            self.rays = Some((*sensor, rays));
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
        self.rays = None;
    }
}

/// 1 at contact, 0 at the end of the range, falling exponentially between.
fn nearness(fraction: f64) -> f64 {
    const STEEPNESS: f64 = 3.0;
    let end = math::exp(-STEEPNESS);
    ((math::exp(-STEEPNESS * fraction) - end) / (1.0 - end)).max(0.0)
}
