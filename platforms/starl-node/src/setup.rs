//! The configuration of a robot: its number and software, the fleet, and the scenario around it.

use crate::localise::Accuracy;
use crate::safety::Safety;
use starl_core::event::Name;
use starl_core::motion::Body;
use starl_core::{Duration, Obstacle, Point, Pose, Program, Random, RobotId, Time, WayPoint};
use starl_host::Hardware;
use starl_motion::sensing::SensorSuite;

/// An obstacle of the scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct MapObstacle {
    /// Its shape and place.
    pub obstacle: Obstacle,
    /// Robots have to discover it.
    pub hidden: bool,
    /// It disappears at this time.
    pub expires: Time,
}

/// A thing that detectors see, where it lies.
#[derive(Clone, Debug, PartialEq)]
pub struct Thing {
    /// Its name.
    pub name: Name,
    /// Where it is, metres.
    pub position: Point,
}

/// The configuration of a robot.
pub struct Setup {
    /// Its number.
    pub id: RobotId,
    /// The bodies of all robots, by number.
    pub bodies: Vec<Body>,
    /// The software that it runs.
    pub program: Box<dyn Program>,
    /// The stream that its software draws from.
    pub random: Random,
    /// Its hardware.
    pub hardware: Hardware,
    /// The sensors that its program may read. A bumper is the device's; the others are measured among the places of the
    /// other robots and the known obstacles.
    pub sensors: SensorSuite,
    /// The things that a detector sees.
    pub things: Vec<Thing>,
    /// The application's waypoints.
    pub way_points: Vec<WayPoint>,
    /// The obstacles of the scenario.
    pub obstacles: Vec<MapObstacle>,
    /// The period of its position estimates.
    pub positioning_period: Duration,
    /// How exact its odometry and its positions are.
    pub accuracy: Accuracy,
    /// Its position at the start, if known.
    pub start: Option<Pose>,
    /// When its motors are stopped.
    pub safety: Safety,
}
