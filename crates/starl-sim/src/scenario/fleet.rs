//! The robots of a run.

use starl_core::{Duration, Pose, RobotId};
use starl_motion::Model;
use starl_motion::sensing::SensorSuite;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The robots, in groups of the same kind, numbered through from 0.
#[derive(Clone, Debug, Default)]
pub struct Fleet {
    /// The groups.
    pub groups: Vec<Group>,
}

/// Robots of one kind.
#[derive(Clone, Debug)]
pub struct Group {
    /// The robots' names; a group of several numbers them: `create0`, `create1`, ...
    pub name: String,
    /// Numbers the robots' names even if the group has only one; default true.
    pub numbered: bool,
    /// The first number in the names; default 0.
    pub first_number: u32,
    /// How they move.
    pub model: Arc<dyn Model>,
    /// Their program.
    pub program: String,
    /// The program's parameters.
    pub parameters: BTreeMap<String, Parameter>,
    /// Where they start; as many poses as robots.
    pub starts: Vec<Pose>,
    /// Time between two activations of the program; default 100 ms.
    pub control_period: Duration,
    /// Their sensors.
    pub sensors: SensorSuite,
    /// How wrong their clocks are.
    pub clock: Clock,
}

/// A parameter of a program, set in the scenario.
#[derive(Clone, Debug, PartialEq)]
pub enum Parameter {
    /// Yes or no.
    Bool(bool),
    /// A whole number.
    Int(i64),
    /// A number; lengths in metres, angles in radians, speeds in metres per second.
    Float(f64),
    /// A text.
    Text(String),
    /// A span of time.
    Duration(Duration),
    /// Several.
    List(Vec<Parameter>),
}

/// How wrong the clocks of a group's robots are: each robot's own clock reads
/// `offset + (1 + drift) * time`, with offset and drift drawn uniformly within these bounds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Clock {
    /// Greatest offset; clocks start between 0 and this; default 0.
    pub offset: Duration,
    /// Greatest drift either way, parts per million; default 0.
    pub drift_ppm: f64,
}

impl Fleet {
    /// How many robots there are.
    pub fn len(&self) -> usize {
        self.groups.iter().map(|group| group.starts.len()).sum()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The radius of the largest robot, metres.
    pub(crate) fn largest_radius(&self) -> f64 {
        let groups = self.groups.iter().filter(|group| !group.starts.is_empty());
        groups.fold(0.0, |largest, group| group.model.body().radius.max(largest))
    }

    /// The group of a robot, and its index in it.
    pub fn group_of(&self, robot: RobotId) -> Option<(&Group, usize)> {
        let mut index = robot.index();
        for group in &self.groups {
            if index < group.starts.len() {
                return Some((group, index));
            }
            index -= group.starts.len();
        }
        None
    }

    /// A robot's name.
    pub fn name(&self, robot: RobotId) -> String {
        match self.group_of(robot) {
            Some((group, index)) if group.numbered => {
                format!("{}{}", group.name, index + group.first_number as usize)
            }
            Some((group, _)) => group.name.clone(),
            None => format!("robot{robot}"),
        }
    }

    /// The robot with this name.
    pub fn find(&self, name: &str) -> Option<RobotId> {
        (0..self.len() as u32)
            .map(RobotId)
            .find(|&robot| self.name(robot) == name)
    }
}
