//! The readings of one robot's sensors at the present moment, as plain data.

use serde::Serialize;
use starl_core::sensor::Detected;
use starl_core::{Point, RobotId};
use starl_sim::Run;

/// The sensor readings that a robot's program would get if it ran now. Lengths are in metres, angles in radians from
/// the robot's heading, left positive.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct SensorReport {
    /// The bearing of what touches the bumper; none if nothing does, or without a bumper.
    pub bumper: Option<f64>,
    /// How far the rays of the proximity sensor reach beyond the body's edge; none without that sensor.
    pub proximity_range: Option<f64>,
    /// The rays of the proximity sensor, in the order of their bearings.
    pub proximity: Vec<RayReport>,
    /// How far the detector sees from the robot's centre; none without a detector.
    pub detector_range: Option<f64>,
    /// The things and robots that the detector sees, the nearest first.
    pub detections: Vec<DetectionReport>,
}

/// A ray of a proximity sensor.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RayReport {
    /// Its direction.
    pub bearing: f64,
    /// The distance from the body's edge to what it meets; the range if it meets nothing.
    pub distance: f64,
}

/// A thing or a robot that a detector sees.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DetectionReport {
    /// Its name.
    pub name: String,
    /// Where it is in the world.
    pub position: Point,
}

impl SensorReport {
    /// The readings of a robot; nothing if there is no such robot, or while its software does not run.
    pub(super) fn of(run: &Run, robot: RobotId) -> SensorReport {
        let simulation = run.simulation();
        let fleet = &simulation.scenario().fleet;
        let Some((group, _)) = fleet.group_of(robot) else {
            return SensorReport::default();
        };
        if !simulation.node(robot).runs() {
            return SensorReport::default();
        }
        let suite = &group.sensors;
        simulation.rehearse(robot, |_, handle| {
            let readings = handle.sensors();
            let rays = readings.proximity.iter();
            let name = |what: &Detected| match *what {
                Detected::Robot(other) => fleet.name(other),
                Detected::Thing(thing) => readings.thing_names[thing as usize].to_string(),
            };
            SensorReport {
                bumper: readings.bumper.map(|contact| contact.bearing),
                proximity_range: suite.proximity.map(|sensor| sensor.range),
                proximity: rays
                    .map(|ray| RayReport {
                        bearing: ray.bearing,
                        distance: ray.distance,
                    })
                    .collect(),
                detector_range: suite.detector.map(|sensor| sensor.range),
                detections: readings
                    .detections
                    .iter()
                    .map(|seen| DetectionReport {
                        name: name(&seen.what),
                        position: seen.position,
                    })
                    .collect(),
            }
        })
    }
}
