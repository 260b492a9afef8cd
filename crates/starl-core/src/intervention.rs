//! Whatever steers a run from outside: faults, changes of the world and of the network, operators.
//!
//! A test, a schedule, a mouse or an operator steers a run by the same few interventions. Each is on
//! record, so that a run that was steered can be repeated.

use crate::event::{Fields, Name};
use crate::{Duration, Obstacle, Point, Pose, RobotId, WayPoint};
use alloc::string::String;
use alloc::vec::Vec;
use serde::{Deserialize, Serialize};

/// One intervention.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Intervention {
    /// Something breaks or is mended.
    Fault(FaultKind),
    /// The robot's body is moved, as by a hand, as far as nothing is in the way.
    Push {
        /// Which robot.
        robot: RobotId,
        /// How far, world frame, metres.
        by: Point,
    },
    /// The network changes: later knobs of the list come after earlier ones.
    Network(Vec<NetworkKnob>),
    /// An obstacle appears. It gets the next free index of the world.
    AddObstacle {
        /// Its shape and place.
        obstacle: Obstacle,
        /// Robots do not know it until they meet it.
        hidden: bool,
    },
    /// An obstacle changes its place or shape.
    MoveObstacle {
        /// Its index in the world.
        index: u32,
        /// Its new shape and place.
        obstacle: Obstacle,
    },
    /// An obstacle vanishes.
    RemoveObstacle {
        /// Its index in the world.
        index: u32,
    },
    /// A way-point appears, or the one of this name moves. Programs hear of it as of an order named
    /// `way_points`.
    SetWayPoint(WayPoint),
    /// A way-point vanishes.
    RemoveWayPoint {
        /// Its name.
        name: String,
    },
    /// A thing appears, or the one of this name moves.
    SetThing {
        /// Its name.
        name: String,
        /// Where it is, metres.
        position: Point,
    },
    /// A thing vanishes.
    RemoveThing {
        /// Its name.
        name: String,
    },
    /// An operator tells robots something.
    Tell {
        /// Which robots; all if empty.
        robots: Vec<RobotId>,
        /// What they are told.
        order: Order,
    },
    /// A robot joins the fleet, and gets the next free number.
    Join {
        /// It is of the same kind as this robot, and runs the same program.
        like: RobotId,
        /// Its name.
        name: String,
        /// Where it starts.
        pose: Pose,
    },
    /// Robots leave for good: their software stops and their bodies are taken away.
    Leave(Vec<RobotId>),
}

impl Intervention {
    /// Whether its numbers make sense: places are finite, shapes are shapes, probabilities are from 0 to 1,
    /// and lengths are not negative.
    pub fn is_valid(&self) -> bool {
        match self {
            Intervention::Push { by, .. } => by.is_finite(),
            Intervention::Network(knobs) => knobs.iter().all(NetworkKnob::is_valid),
            Intervention::AddObstacle { obstacle, .. }
            | Intervention::MoveObstacle { obstacle, .. } => obstacle.is_valid(),
            Intervention::SetWayPoint(way_point) => way_point.position.is_finite(),
            Intervention::SetThing { position, .. } => position.is_finite(),
            Intervention::Join { pose, .. } => pose.position.is_finite() && pose.yaw.is_finite(),
            _ => true,
        }
    }
}

/// What can break, and what mends it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FaultKind {
    /// The robots stop computing, receiving and moving, and lose all state.
    Crash(Vec<RobotId>),
    /// Crashed robots start afresh, their programs from the beginning.
    Restart(Vec<RobotId>),
    /// Robots in different groups do not hear each other; robots in no group form one more.
    Partition(Vec<Vec<RobotId>>),
    /// All partitions end.
    Heal,
    /// The motors act as if told to stop, whatever the program commands.
    StuckMotor(Vec<RobotId>),
    /// Sensors and positioning repeat their last readings.
    FrozenSensor(Vec<RobotId>),
    /// Ends stuck motors and frozen sensors.
    Repair(Vec<RobotId>),
    /// The programs' variables are overwritten at random, within their types.
    CorruptState(Vec<RobotId>),
}

/// One knob of the network with its new position. The first seven are those of all links that the
/// scenario does not describe one by one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum NetworkKnob {
    /// Mean delay.
    Delay(Duration),
    /// Standard deviation of the delay.
    Jitter(Duration),
    /// How delays vary.
    Distribution(DelayDistribution),
    /// Probability that a datagram is lost.
    Loss(f64),
    /// Probability that a datagram arrives twice.
    Duplication(f64),
    /// Probability that a datagram is held back.
    Reordering(f64),
    /// For how long.
    ReorderingDelay(Duration),
    /// Radio range, metres; none is everywhere.
    Range(Option<f64>),
    /// Whether bodies and obstacles stop radio waves.
    LineOfSight(bool),
    /// What a robot sends at most, bits per second; none is anything.
    Bandwidth(Option<f64>),
    /// How long a datagram may wait for the radio.
    Queue(Duration),
    /// The longest payload, bytes.
    Largest(u32),
}

impl NetworkKnob {
    /// Whether the position is one that the knob has.
    pub fn is_valid(&self) -> bool {
        match *self {
            NetworkKnob::Loss(share)
            | NetworkKnob::Duplication(share)
            | NetworkKnob::Reordering(share) => (0.0..=1.0).contains(&share),
            NetworkKnob::Range(Some(range)) => range >= 0.0,
            NetworkKnob::Bandwidth(Some(bandwidth)) => bandwidth > 0.0,
            _ => true,
        }
    }
}

/// How delays are distributed around their mean; never below zero.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DelayDistribution {
    /// Always the mean; the jitter counts for nothing.
    Constant,
    /// Evenly over the mean plus and minus the square root of three times the jitter.
    Uniform,
    /// Normal, cut off at zero.
    #[default]
    Normal,
    /// The mean less the jitter, plus an exponential part whose mean is the jitter.
    Exponential,
}

/// What an operator tells a robot's program.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Order {
    /// Its name, e.g. `go_home`.
    pub name: Name,
    /// Its details, by name.
    pub fields: Fields,
}

impl Order {
    /// The name of the order by which programs hear that the way-points have changed.
    pub const WAY_POINTS: &'static str = "way_points";
}
