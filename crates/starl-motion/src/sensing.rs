//! The readings of a robot's sensors for bodies and obstacles whose places are known.
//!
//! The simulator measures in its true world. A real robot without such sensors uses the bodies whose positions it has
//! received: see `starl-node`.

use crate::Neighbour;
use crate::proximity::Rays;
use crate::scene::Scene;
use alloc::vec::Vec;
use starl_core::math;
use starl_core::sensor::{Detected, Detection, Ray};
use starl_core::{Point, RobotId};

/// The sensors that robots of a group carry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensorSuite {
    /// Feels contacts; default true.
    pub bumper: bool,
    /// Measures distances; default none.
    pub proximity: Option<Proximity>,
    /// Sees things and robots; default none.
    pub detector: Option<Detector>,
    /// Hidden obstacles this near to the body's edge and in line of sight become known, metres;
    /// default 0.6. A robot that bumps into one knows it in any case.
    pub discovery_range: f64,
}

/// Rays evenly round the body, the first straight ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Proximity {
    /// How many; default 24.
    pub rays: u32,
    /// How far they see beyond the body's edge, metres; default 0.1.
    pub range: f64,
}

/// Sees things and robots in line of sight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Detector {
    /// How far, from the robot's centre, metres; default 0.6.
    pub range: f64,
}

impl Default for SensorSuite {
    fn default() -> SensorSuite {
        SensorSuite {
            bumper: true,
            proximity: None,
            detector: None,
            discovery_range: 0.6,
        }
    }
}

impl Default for Proximity {
    fn default() -> Proximity {
        Proximity {
            rays: 24,
            range: 0.1,
        }
    }
}

impl Default for Detector {
    fn default() -> Detector {
        Detector { range: 0.6 }
    }
}

/// Room for readings, used over and over.
#[derive(Clone, Debug, Default)]
pub struct Readings {
    /// Proximity rays in the order of their bearings.
    pub proximity: Vec<Ray>,
    /// Things and robots in sight, nearest first.
    pub detections: Vec<Detection>,
    /// Whether `proximity` shows anything except empty space for the sensor that it was prepared for.
    marked: bool,
    /// The rays of the sensor for which `proximity` is prepared.
    rays: Option<(Proximity, Rays)>,
    nearby: Vec<Neighbour>,
}

impl Readings {
    /// Reads the sensors that a robot with this heading carries. `things` are the indices and places of what a detector
    /// sees beside robots; the bodies of the scene are in the order of the fleet.
    pub fn read(
        &mut self,
        sensors: &SensorSuite,
        scene: &Scene<'_>,
        things: impl Iterator<Item = (u32, Point)>,
        robot: RobotId,
        yaw: f64,
    ) {
        match &sensors.proximity {
            Some(sensor) => self.measure(scene, robot, yaw, sensor),
            None => self.clear(),
        }
        match &sensors.detector {
            Some(sensor) => self.detect(scene, things, robot, sensor),
            None => self.detections.clear(),
        }
    }

    /// Measures distances along rays from the edge of the body.
    fn measure(&mut self, scene: &Scene<'_>, robot: RobotId, yaw: f64, sensor: &Proximity) {
        self.lay_out(sensor);
        let Some((_, rays)) = &self.rays else { return };
        let readings = &mut self.proximity;
        let meets = |ray: usize, distance: f64| {
            readings[ray].distance = distance;
            readings[ray].nearness = nearness(distance / sensor.range);
        };
        self.marked = rays.measure(scene, robot.index(), yaw, &mut self.nearby, meets);
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
    fn detect(
        &mut self,
        scene: &Scene<'_>,
        things: impl Iterator<Item = (u32, Point)>,
        robot: RobotId,
        sensor: &Detector,
    ) {
        self.detections.clear();
        let body = &scene.bodies[robot.index()];
        let eye = body.position;
        for (index, position) in things {
            if position.planar_distance(eye) <= sensor.range
                && !scene.map.blocks_segment(eye, position, 0.0)
            {
                let what = Detected::Thing(index);
                self.detections.push(Detection { what, position });
            }
        }
        scene.grid.for_each_within(eye, sensor.range, |entry| {
            let position = scene.bodies[entry.robot as usize].position;
            if entry.robot != robot.0 && !scene.map.blocks_segment(eye, position, 0.0) {
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
