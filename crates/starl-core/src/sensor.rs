//! A robot's sensor readings, behind one typed interface.

use crate::event::Name;
use crate::{Point, RobotId};
use serde::{Deserialize, Serialize};

/// Where something touches the robot's body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Contact {
    /// Direction of the touch from the robot's heading, radians in (-pi, pi], left positive.
    pub bearing: f64,
}

impl Contact {
    /// Whether the left half of a two-part front bumper is pressed (as on the iRobot Create).
    pub fn left(self) -> bool {
        self.bearing > -BUMPER_OVERLAP && self.bearing <= crate::math::FRAC_PI_2
    }

    /// Whether the right half of a two-part front bumper is pressed.
    pub fn right(self) -> bool {
        self.bearing < BUMPER_OVERLAP && self.bearing >= -crate::math::FRAC_PI_2
    }
}

/// Within this angle of straight ahead both halves of the bumper are pressed, radians.
const BUMPER_OVERLAP: f64 = 0.2;

/// One ray of a proximity sensor.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ray {
    /// Direction from the robot's heading, radians, left positive.
    pub bearing: f64,
    /// Distance from the body's edge to what the ray meets, metres; the range if it meets nothing.
    pub distance: f64,
    /// How near that is: 0 at the range or beyond, 1 at contact, falling exponentially.
    pub nearness: f64,
}

/// Something a detector sees in range and line of sight.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Detection {
    /// The detected robot or thing.
    pub what: Detected,
    /// Where it is in the world frame, metres.
    pub position: Point,
}

/// The kinds of objects that a detector distinguishes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Detected {
    /// A thing to be found, by its index among the world's things.
    Thing(u32),
    /// Another robot.
    Robot(RobotId),
}

/// The readings a robot has at the moment it is activated. A sensor the robot does not carry reads
/// as absent: `None`, or an empty list.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sensors<'a> {
    /// The current contact of the body.
    pub bumper: Option<Contact>,
    /// Proximity rays in the order of their bearings.
    pub proximity: &'a [Ray],
    /// Things and robots in sight, nearest first.
    pub detections: &'a [Detection],
    /// The thing that the robot holds, by its index among the world's things.
    pub holding: Option<u32>,
    /// The names of the world's things, by index; empty for a removed thing.
    pub thing_names: &'a [Name],
}
