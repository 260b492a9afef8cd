//! Judging properties as time goes by: who has started, what is brought before the court, how things
//! stand.

use super::Fleet;
use super::docket::{Docket, Row, UNKNOWN};
use super::hearing::Hearing;
use super::observables::Court;
use super::violation::{Violation, read_variables};
use crate::machine::{Claim, Property};
use crate::robot::code::Code;
use crate::robot::workbench::Workbench;
use alloc::vec::Vec;
use core::cell::Cell;
use starl_core::{RobotId, Time};

/// How a property stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// It holds: as far as has been seen, if it is about all times.
    Holds,
    /// Something that it demands has not come, and is not too late.
    Open,
    /// It does not hold.
    Violated,
}

/// Judges the properties of one program.
#[derive(Clone)]
pub struct Judge {
    code: Code,
    dockets: Vec<Docket>,
    bench: Workbench,
    /// The robots that have started.
    roster: Row,
    /// The versions of their states; [`UNKNOWN`] where they are not known.
    versions: Vec<u64>,
}

impl Judge {
    /// A judge of this program's properties who has seen nothing.
    pub fn new(code: &Code) -> Judge {
        let bytecode = code.program().bytecode();
        let docket = |property: &Property| Docket {
            reads: read_variables(bytecode, property.claim),
            ..Docket::default()
        };
        Judge {
            dockets: bytecode.properties.iter().map(docket).collect(),
            bench: Workbench::default(),
            roster: Row::new(),
            versions: Vec::new(),
            code: code.clone(),
        }
    }

    /// The program whose properties are judged.
    pub fn code(&self) -> &Code {
        &self.code
    }

    /// The properties, in the order of the text.
    pub fn properties(&self) -> &[Property] {
        &self.code.program().bytecode().properties
    }

    /// Takes in the state of the fleet at a moment, which is no earlier than the one before; time
    /// counts from the start of the run. Gives what does not hold and has not been reported.
    pub fn observe(&mut self, now: Time, fleet: &dyn Fleet) -> Vec<Violation> {
        let mut violations = Vec::new();
        self.call_roll(fleet);
        let bytecode = self.code.program().bytecode();
        for ((index, property), docket) in bytecode
            .properties
            .iter()
            .enumerate()
            .zip(&mut self.dockets)
        {
            let mut hearing = Hearing {
                court: Court {
                    code: &self.code,
                    fleet,
                    now,
                    roster: &self.roster,
                    all: None,
                    memo: &mut self.bench.memo,
                    last: Cell::new(None),
                    first: None,
                    looked_elsewhere: Cell::new(false),
                },
                workspace: &mut self.bench.workspace,
                versions: &self.versions,
                property,
                index,
                docket,
                violations: &mut violations,
            };
            hearing.run();
        }
        violations
    }

    /// Sees who has started, and what states there are.
    fn call_roll(&mut self, fleet: &dyn Fleet) {
        let robots = fleet.robots().iter().copied();
        let started = || {
            robots
                .clone()
                .filter(|robot| fleet.state_of(*robot).is_some())
        };
        if !started().eq(self.roster.iter().copied()) {
            let before = core::mem::replace(&mut self.roster, started().collect());
            for docket in &mut self.dockets {
                docket.rearrange(&before, &self.roster);
            }
        }
        self.versions.clear();
        let versions = self.roster.iter().map(|&robot| fleet.version(robot));
        self.versions
            .extend(versions.map(|version| version.unwrap_or(UNKNOWN)));
    }

    /// How a property stands, by its place among [`Judge::properties`].
    pub fn standing(&self, property: usize) -> Standing {
        let Some(docket) = self.dockets.get(property) else {
            return Standing::Holds;
        };
        let claim = self.properties().get(property).map(|p| p.claim);
        let is_open = match claim {
            Some(Claim::Eventually { .. }) => docket.lacks || !docket.judged,
            _ => !docket.waiting.is_empty(),
        };
        match (docket.violated.is_empty(), is_open) {
            (false, _) => Standing::Violated,
            (true, true) => Standing::Open,
            (true, false) => Standing::Holds,
        }
    }

    /// How a property stands for one row of robots.
    pub fn standing_of(&self, property: usize, robots: &[RobotId]) -> Standing {
        let claim = self.properties().get(property).map(|p| p.claim);
        match self.dockets.get(property) {
            Some(docket) if docket.violated.contains(robots) => Standing::Violated,
            Some(docket) if docket.waiting.contains_key(robots) => Standing::Open,
            Some(docket)
                if matches!(claim, Some(Claim::Eventually { .. }))
                    && !docket.settled.contains(robots) =>
            {
                Standing::Open
            }
            _ => Standing::Holds,
        }
    }
}
