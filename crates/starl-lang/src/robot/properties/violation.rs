//! What is said of a property that does not hold.

use super::observables::Court;
use crate::machine::{Bytecode, Claim, Instruction, Layout, Property, Value};
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::fmt;
use starl_core::{Duration, Point, RobotId, Time};

/// A property that does not hold, and the state of the robots concerned.
#[derive(Clone, Debug, PartialEq)]
pub struct Violation {
    /// Which property, by its place among the program's.
    pub property: usize,
    /// Its name.
    pub name: String,
    /// Where it is written, e.g. `race.starl:40:1`; none of bytecode that was written by hand.
    pub place: Option<String>,
    /// When it was seen.
    pub at: Time,
    /// The robots that it does not hold for; none if it is about the fleet.
    pub robots: Vec<RobotId>,
    /// In what way it does not hold.
    pub reason: Reason,
    /// What those robots' state is; for a property about the fleet that of the robot which was looked
    /// at last.
    pub states: Vec<Seen>,
}

/// In what way a property does not hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reason {
    /// What is always true is not.
    Untrue,
    /// What was to come has not come in time.
    NotInTime {
        /// How long after the start it was to have come at the latest.
        within: Duration,
    },
    /// What was to follow has not followed in time.
    NotFollowed {
        /// When that was true which it is to follow.
        since: Time,
        /// How much later it was to have followed at the latest.
        within: Duration,
    },
    /// Judging it failed; the text says where and why.
    Undecided(String),
}

/// The state of a robot as it was seen.
#[derive(Clone, Debug, PartialEq)]
pub struct Seen {
    /// Which robot.
    pub robot: RobotId,
    /// Its true position, metres, if it is known.
    pub position: Option<Point>,
    /// The variables that the property reads, with their values; all variables, if it reads none.
    pub variables: Vec<(String, Value)>,
}

impl Violation {
    pub(super) fn new(
        court: &Court<'_>,
        (index, property): (usize, &Property),
        row: &[RobotId],
        reason: Reason,
        reads: &[usize],
    ) -> Violation {
        let program = court.code.program();
        let functions = &program.bytecode().functions;
        let entry = functions.get(first_function(property.claim) as usize);
        let mut concerned: Vec<RobotId> = match row {
            [] => court.last.get().into_iter().collect(),
            _ => row.into(),
        };
        concerned.dedup();
        Violation {
            property: index,
            name: property.name.clone(),
            place: entry.and_then(|function| program.source(function.entry)),
            at: court.now,
            robots: row.into(),
            reason,
            states: concerned
                .into_iter()
                .map(|robot| Seen::of(court, robot, reads))
                .collect(),
        }
    }
}

impl Seen {
    fn of(court: &Court<'_>, robot: RobotId, reads: &[usize]) -> Seen {
        let program = court.code.program();
        let state = court.fleet.state_of(robot);
        let variables = state.into_iter().flat_map(|state| program.values(state));
        let read = |index: &usize| reads.is_empty() || reads.contains(index);
        let names: Vec<&str> = program
            .bytecode()
            .variables
            .iter()
            .enumerate()
            .filter(|(index, _)| read(index))
            .map(|(_, variable)| &variable.name[..])
            .collect();
        Seen {
            robot,
            position: court.fleet.pose(robot).map(|pose| pose.position),
            variables: variables
                .filter(|(name, _)| names.contains(name))
                .map(|(name, value)| (name.into(), value))
                .collect(),
        }
    }
}

fn first_function(claim: Claim) -> u32 {
    match claim {
        Claim::Always(holds)
        | Claim::Eventually { holds, .. }
        | Claim::EventuallyAlways { holds, .. } => holds,
        Claim::LeadsTo { cause, .. } => cause,
    }
}

/// The variables that a claim reads, by their places in the program.
pub(super) fn read_variables(bytecode: &Bytecode, claim: Claim) -> Vec<usize> {
    let second = match claim {
        Claim::LeadsTo { consequence, .. } => Some(consequence),
        _ => None,
    };
    let functions = [Some(first_function(claim)), second];
    let functions = functions.into_iter().flatten();
    let functions = functions.filter_map(|index| bytecode.functions.get(index as usize));
    let instructions = functions.flat_map(|f| {
        let range = f.entry as usize..f.end as usize;
        bytecode.code.get(range).unwrap_or_default()
    });
    let (mut scalars, mut objects) = (Vec::new(), Vec::new());
    for instruction in instructions {
        match instruction {
            Instruction::LoadOther { variable, .. }
            | Instruction::LoadOtherPoint { variable, .. } => scalars.push(variable.0 as usize),
            Instruction::LoadOtherObject { variable, .. } => objects.push(variable.0 as usize),
            _ => {}
        }
    }
    let mut next = (0, 0);
    let mut read = Vec::new();
    for (index, variable) in bytecode.variables.iter().enumerate() {
        let layout = Layout::of([&variable.kind]);
        let end = (next.0 + layout.scalars.len(), next.1 + layout.objects.len());
        if scalars.iter().any(|slot| (next.0..end.0).contains(slot))
            || objects.iter().any(|slot| (next.1..end.1).contains(slot))
        {
            read.push(index);
        }
        next = end;
    }
    read
}

/// One sentence, then the robots' state: `is not true; robot 3 at (1.00, 2.00, 0.00): index = 4`.
impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.reason {
            Reason::Untrue => f.write_str("is not true")?,
            Reason::NotInTime { within } => write!(f, "has not come true within {within}")?,
            Reason::NotFollowed { since, within } => {
                write!(f, "what is to follow within {within} has not since {since}")?;
            }
            Reason::Undecided(text) => write!(f, "cannot be judged: {text}")?,
        }
        if self.robots.is_empty() && !self.states.is_empty() {
            f.write_str("; looked at last")?;
        }
        self.states
            .iter()
            .try_for_each(|seen| write!(f, "; {seen}"))
    }
}

/// So many characters of a value are shown.
const LONGEST_VALUE: usize = 160;

impl fmt::Display for Seen {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "robot {}", self.robot)?;
        if let Some(Point { x, y, z }) = self.position {
            write!(f, " at ({x:.2}, {y:.2}, {z:.2})")?;
        }
        for (index, (name, value)) in self.variables.iter().enumerate() {
            let before = if index == 0 { ": " } else { ", " };
            let text = value.to_string();
            match text.char_indices().nth(LONGEST_VALUE) {
                None => write!(f, "{before}{name} = {text}")?,
                Some((end, _)) => write!(f, "{before}{name} = {}...", &text[..end])?,
            }
        }
        Ok(())
    }
}
