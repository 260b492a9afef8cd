//! Violations of properties.

use super::host::PropertyHost;
use super::reads::{Reads, first_function};
use crate::machine::{Property, Value};
use crate::robot::failure::Failure;
use crate::robot::words::shortened;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::fmt;
use starl_core::{Duration, Point, RobotId, Time};

/// A violated property, with the state of the robots concerned.
#[derive(Clone, Debug, PartialEq)]
pub struct Violation {
    /// The property's index in the program.
    pub property: usize,
    /// Its name.
    pub name: String,
    /// Its position in the source, e.g. `race.starl:40:1`; none for bytecode written by hand.
    pub place: Option<String>,
    /// The time of the violation.
    pub at: Time,
    /// The robots that violate it; none if it is about the fleet.
    pub robots: Vec<RobotId>,
    /// The reason.
    pub reason: Reason,
    /// The state of those robots; for a property of the fleet, the state of the robot that was evaluated last.
    pub states: Vec<Seen>,
}

/// The reason of a violation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reason {
    /// An invariant is false.
    Untrue,
    /// An eventual condition has missed its deadline.
    NotInTime {
        /// The deadline, counted from the start.
        within: Duration,
    },
    /// A consequence has missed its deadline.
    NotFollowed {
        /// The time at which the cause was true.
        since: Time,
        /// The deadline, counted from the cause.
        within: Duration,
    },
    /// Evaluating it failed.
    Undecided(Failure),
}

/// The state of a robot at the violation.
#[derive(Clone, Debug, PartialEq)]
pub struct Seen {
    /// The robot.
    pub robot: RobotId,
    /// Its true position in metres, if known.
    pub position: Option<Point>,
    /// The variables that the property reads, with their values; all variables, if it reads none.
    pub variables: Vec<(String, Value)>,
}

impl Violation {
    pub(super) fn new(
        host: &PropertyHost<'_>,
        (index, property): (usize, &Property),
        row: &[RobotId],
        reason: Reason,
        reads: &Reads,
    ) -> Violation {
        let program = host.code.program();
        let functions = &program.bytecode().functions;
        let entry = functions.get(first_function(property.claim) as usize);
        let mut concerned: Vec<RobotId> = match row {
            [] => host.last.get().into_iter().collect(),
            _ => row.into(),
        };
        concerned.dedup();
        Violation {
            property: index,
            name: property.name.clone(),
            place: entry.and_then(|function| program.source(function.entry)),
            at: host.now,
            robots: row.into(),
            reason,
            states: concerned
                .into_iter()
                .map(|robot| Seen::of(host, robot, reads))
                .collect(),
        }
    }
}

impl Seen {
    fn of(host: &PropertyHost<'_>, robot: RobotId, reads: &Reads) -> Seen {
        Seen {
            robot,
            position: host.fleet.pose(robot).map(|pose| pose.position),
            variables: reads.values(host.code.program(), host.fleet, robot),
        }
    }
}

/// One sentence, then the robots' state: `is not true; robot 3 at (1.00, 2.00, 0.00): index = 4`.
impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.reason {
            Reason::Untrue => f.write_str("is not true")?,
            Reason::NotInTime { within } => write!(f, "has not become true within {within}")?,
            Reason::NotFollowed { since, within } => {
                write!(f, "the consequence is not true within {within} of {since}")?;
            }
            Reason::Undecided(failure) => write!(f, "cannot be judged: {failure}")?,
        }
        if self.robots.is_empty() && !self.states.is_empty() {
            f.write_str("; looked at last")?;
        }
        self.states
            .iter()
            .try_for_each(|seen| write!(f, "; {seen}"))
    }
}

/// The most characters shown of a value.
const LONGEST_VALUE: usize = 160;

impl fmt::Display for Seen {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "robot {}", self.robot)?;
        if let Some(Point { x, y, z }) = self.position {
            write!(f, " at ({x:.2}, {y:.2}, {z:.2})")?;
        }
        for (index, (name, value)) in self.variables.iter().enumerate() {
            let before = if index == 0 { ": " } else { ", " };
            let text = shortened(value.to_string(), LONGEST_VALUE);
            write!(f, "{before}{name} = {text}")?;
        }
        Ok(())
    }
}
