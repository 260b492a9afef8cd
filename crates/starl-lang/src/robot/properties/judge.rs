//! Judging properties as time goes by: who has started, what is brought before the court, how things
//! stand.

use super::docket::{Docket, Row, UNKNOWN};
use super::hearing::Hearing;
use super::observables::{Counted, Court};
use super::violation::{Violation, read_variables};
use super::{Excuse, Fleet};
use crate::machine::{Claim, Property};
use crate::robot::code::Code;
use crate::robot::workbench::Workbench;
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use core::cell::Cell;
use starl_core::{Duration, RobotId, Time};

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

/// A robot that has restarted has learned from the others after this time what it has to remember.
const REMEMBERS: Duration = Duration::from_seconds(10);

/// Judges the properties of one program.
#[derive(Clone)]
pub struct Judge {
    code: Code,
    dockets: Vec<Docket>,
    bench: Workbench,
    /// When robots were down last.
    down: BTreeMap<RobotId, Time>,
    /// Whether at some moment no more than half of the robots were up and remembered what others had told them.
    lost_majority: bool,
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
            down: BTreeMap::new(),
            lost_majority: false,
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
        self.count_majority(now, fleet);
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
                    counted: counted(property),
                    has_majority: !self.lost_majority,
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

    /// Sees whether a majority of the robots is there.
    fn count_majority(&mut self, now: Time, fleet: &dyn Fleet) {
        for &robot in fleet.robots() {
            if !fleet.is_up(robot) {
                self.down.insert(robot, now);
            }
        }
        let is_back = |down: &Time| now.since(*down) >= REMEMBERS;
        self.down.retain(|_, down| !is_back(down));
        self.lost_majority |= !self.down.is_empty() && 2 * self.down.len() >= fleet.robots().len();
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

    /// How often a property was false of some robots and that was excused, by reason.
    pub fn excused(&self, property: usize) -> impl Iterator<Item = (Excuse, u64)> + '_ {
        let dockets = self.dockets.get(property).into_iter();
        dockets.flat_map(|docket| {
            docket
                .excused
                .iter()
                .map(|(excuse, count)| (*excuse, *count))
        })
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

/// Robots that are down are owed nothing, and what is to come is not owed to one that a wreck keeps from its target.
fn counted(property: &Property) -> Counted {
    match property.claim {
        _ if property.is_despite_crashes => Counted::All,
        Claim::Always(_) => Counted::Up,
        _ => Counted::Able,
    }
}
