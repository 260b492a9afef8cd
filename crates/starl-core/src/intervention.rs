//! Interventions steer a run from outside: faults, changes of the world and of the network, orders of operators.
//!
//! Tests, schedules, the viewer and operators use the same few interventions. Each is recorded, so that a steered run
//! can be repeated.

use crate::event::{Fields, Name, Value};
use crate::geometry::Shape;
use crate::{Duration, Obstacle, Point, Pose, RobotId, WayPoint};
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;
use serde::{Deserialize, Serialize};

/// One intervention.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Intervention {
    /// A fault begins or ends.
    Fault(FaultKind),
    /// The robot's body is moved, as by a hand, as far as nothing is in the way.
    Push {
        /// Which robot.
        robot: RobotId,
        /// How far, world frame, metres.
        by: Point,
    },
    /// The network changes; later changes of the list override earlier ones.
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
    /// A waypoint appears, or the one of this name moves. Programs receive an order named `way_points`.
    SetWayPoint(WayPoint),
    /// A waypoint vanishes.
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
        /// The order.
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
    /// Robots leave permanently: their software stops and their bodies are taken away.
    Leave(Vec<RobotId>),
}

/// Whether a robot may have this name, which becomes part of file names: it is not blank, and has neither `/` nor control
/// characters.
pub fn is_robot_name(name: &str) -> bool {
    !name.trim().is_empty() && !name.contains(|c: char| c.is_control() || c == '/')
}

impl Intervention {
    /// Whether a scenario file could say it: places are finite, shapes have an extent, probabilities are from 0
    /// to 1, ranges and bandwidths are above 0, names are not blank, and it concerns at least one robot. No robot
    /// is in two groups of a partition. Orders carry no paths, obstacles and areas.
    pub fn is_valid(&self) -> bool {
        let is_named = |name: &str| !name.trim().is_empty();
        match self {
            Intervention::Fault(FaultKind::Heal) => true,
            Intervention::Fault(FaultKind::Partition(groups) | FaultKind::OneWay(groups)) => {
                let mut robots: Vec<RobotId> = groups.iter().flatten().copied().collect();
                robots.sort_unstable();
                robots.windows(2).all(|pair| pair[0] != pair[1])
            }
            Intervention::Fault(kind) => kind.robots().is_some_and(|robots| !robots.is_empty()),
            Intervention::Leave(robots) => !robots.is_empty(),
            Intervention::Push { by, .. } => by.is_finite(),
            Intervention::Network(knobs) => {
                !knobs.is_empty() && knobs.iter().all(NetworkKnob::is_valid)
            }
            Intervention::AddObstacle { obstacle, .. }
            | Intervention::MoveObstacle { obstacle, .. } => {
                let has_extent = match &obstacle.shape {
                    Shape::Polygon { .. } => true,
                    Shape::Circle { radius, .. } => *radius > 0.0,
                    Shape::Cuboid { low, high } => low.x < high.x && low.y < high.y,
                };
                let height = obstacle.height();
                obstacle.is_valid() && has_extent && height.is_none_or(|span| span.low < span.high)
            }
            Intervention::RemoveObstacle { .. } => true,
            Intervention::SetWayPoint(WayPoint { name, position, .. })
            | Intervention::SetThing { name, position } => is_named(name) && position.is_finite(),
            Intervention::RemoveWayPoint { name } | Intervention::RemoveThing { name } => {
                is_named(name)
            }
            Intervention::Tell { order, .. } => {
                let says = |(name, value): &(Name, Value)| is_named(name) && is_plain(value);
                is_named(&order.name) && order.fields.iter().all(says)
            }
            Intervention::Join { pose, name, .. } => {
                is_robot_name(name) && pose.position.is_finite() && pose.yaw.is_finite()
            }
        }
    }

    /// The same in the one way of saying it that a scenario file has: lists of robots in ascending order, the
    /// network's knobs in the order of [`NetworkKnob`], the fields of an order by name, each once.
    pub fn tidy(mut self) -> Intervention {
        match &mut self {
            Intervention::Fault(FaultKind::Partition(groups) | FaultKind::OneWay(groups)) => {
                groups.iter_mut().for_each(sort);
                groups.retain(|group| !group.is_empty());
            }
            Intervention::Fault(kind) => kind.robots_mut().into_iter().for_each(sort),
            Intervention::Leave(robots) => sort(robots),
            Intervention::Network(knobs) => {
                // The last of several positions of a knob counts.
                knobs.reverse();
                knobs.sort_by_key(NetworkKnob::rank);
                knobs.dedup_by_key(|knob| knob.rank());
            }
            Intervention::AddObstacle { obstacle, .. }
            | Intervention::MoveObstacle { obstacle, .. } => {
                if let Shape::Circle { center, .. } = &mut obstacle.shape {
                    center.z = 0.0;
                }
            }
            Intervention::Tell { robots, order } => {
                sort(robots);
                let fields = &mut order.fields;
                fields.reverse();
                fields.sort_by(|a, b| a.0.cmp(&b.0));
                fields.dedup_by(|a, b| a.0 == b.0);
                for (_, value) in fields {
                    if let Value::Robots(robots) = value {
                        sort(robots);
                    }
                }
            }
            Intervention::Join { pose, .. } => *pose = Pose::level(pose.position, pose.yaw),
            _ => {}
        }
        self
    }

    /// The robots that it names.
    pub fn robots(&self) -> Vec<RobotId> {
        match self {
            Intervention::Fault(FaultKind::Partition(groups) | FaultKind::OneWay(groups)) => {
                groups.iter().flatten().copied().collect()
            }
            Intervention::Fault(kind) => kind.robots().unwrap_or_default().to_vec(),
            Intervention::Push { robot, .. } => vec![*robot],
            Intervention::Join { like, .. } => vec![*like],
            Intervention::Leave(robots) | Intervention::Tell { robots, .. } => robots.clone(),
            _ => Vec::new(),
        }
    }
}

fn sort(robots: &mut Vec<RobotId>) {
    robots.sort_unstable();
    robots.dedup();
}

/// Whether an order can carry it.
fn is_plain(value: &Value) -> bool {
    match value {
        Value::Bool(_) | Value::Int(_) | Value::Text(_) | Value::Robot(_) => true,
        // Seconds as a float keep every nanosecond up to there, 52 days.
        Value::Time(time) => time.0 < 1 << 52,
        Value::Float(number) => number.is_finite(),
        Value::Point(point) => point.is_finite(),
        Value::Robots(robots) => !robots.is_empty(),
        Value::Path(_) | Value::Obstacles(_) | Value::Area(_) => false,
    }
}

/// The kinds of faults, and their ends.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FaultKind {
    /// The robots stop computing, receiving and moving, and lose all state.
    Crash(Vec<RobotId>),
    /// Crashed robots restart, with their programs from the beginning.
    Restart(Vec<RobotId>),
    /// Robots in different groups do not hear each other; robots in no group form one more.
    Partition(Vec<Vec<RobotId>>),
    /// Robots of a group are heard neither by groups before theirs nor by robots in no group, and hear them all.
    OneWay(Vec<Vec<RobotId>>),
    /// All partitions end, including those in one direction.
    Heal,
    /// The motors stop, whatever the program commands.
    StuckMotor(Vec<RobotId>),
    /// Sensors and positioning repeat their last readings.
    FrozenSensor(Vec<RobotId>),
    /// Ends stuck motors and frozen sensors.
    Repair(Vec<RobotId>),
    /// The programs' variables are overwritten at random, within their types.
    CorruptState(Vec<RobotId>),
}

impl FaultKind {
    /// The robots of a fault of single robots; `None` for a fault of the network.
    pub fn robots(&self) -> Option<&[RobotId]> {
        match self {
            FaultKind::Crash(robots)
            | FaultKind::Restart(robots)
            | FaultKind::StuckMotor(robots)
            | FaultKind::FrozenSensor(robots)
            | FaultKind::Repair(robots)
            | FaultKind::CorruptState(robots) => Some(robots),
            FaultKind::Partition(_) | FaultKind::OneWay(_) | FaultKind::Heal => None,
        }
    }

    /// As [`FaultKind::robots`], to be changed.
    pub fn robots_mut(&mut self) -> Option<&mut Vec<RobotId>> {
        match self {
            FaultKind::Crash(robots)
            | FaultKind::Restart(robots)
            | FaultKind::StuckMotor(robots)
            | FaultKind::FrozenSensor(robots)
            | FaultKind::Repair(robots)
            | FaultKind::CorruptState(robots) => Some(robots),
            FaultKind::Partition(_) | FaultKind::OneWay(_) | FaultKind::Heal => None,
        }
    }
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
    /// The maximum rate at which a robot sends, bits per second; none is unlimited.
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
            NetworkKnob::Range(Some(limit)) | NetworkKnob::Bandwidth(Some(limit)) => {
                limit > 0.0 && limit.is_finite()
            }
            NetworkKnob::Largest(bytes) => (1..=NetworkKnob::MOST_BYTES).contains(&bytes),
            _ => true,
        }
    }

    /// The most that [`NetworkKnob::Largest`] can be, bytes.
    pub const MOST_BYTES: u32 = 1 << 30;

    /// The place of the knob in the declaration.
    fn rank(&self) -> u8 {
        match self {
            NetworkKnob::Delay(_) => 0,
            NetworkKnob::Jitter(_) => 1,
            NetworkKnob::Distribution(_) => 2,
            NetworkKnob::Loss(_) => 3,
            NetworkKnob::Duplication(_) => 4,
            NetworkKnob::Reordering(_) => 5,
            NetworkKnob::ReorderingDelay(_) => 6,
            NetworkKnob::Range(_) => 7,
            NetworkKnob::LineOfSight(_) => 8,
            NetworkKnob::Bandwidth(_) => 9,
            NetworkKnob::Queue(_) => 10,
            NetworkKnob::Largest(_) => 11,
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
    /// The mean minus the jitter, plus an exponential part whose mean is the jitter.
    Exponential,
}

/// An order of an operator to a robot's program.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Order {
    /// Its name, e.g. `go_home`.
    pub name: Name,
    /// Its details, by name.
    pub fields: Fields,
}

impl Order {
    /// The name of the order by which programs hear that the waypoints have changed.
    pub const WAY_POINTS: &'static str = "way_points";
}
