//! Judging properties as time goes by.
//!
//! Only what is out of the ordinary is remembered: rows of robots for which something came true that
//! was to come once, or that wait for what is to follow, or for which the property was violated.

use super::Fleet;
use super::observables::Court;
use super::violation::{Reason, Violation, read_variables};
use crate::machine::{Claim, Limits, Machine, Property, Workspace};
use crate::robot::code::Code;
use crate::robot::workbench::Workbench;
use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;
use core::cell::Cell;
use starl_core::{Duration, RobotId, Time};

/// Robots that a property is judged of together.
type Row = Vec<RobotId>;

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

/// In the place of a version: nothing is known.
const UNKNOWN: u64 = 0;
/// In the place of a version: there is nothing more to judge.
const CLOSED: u64 = u64::MAX;

/// What is remembered of one property.
#[derive(Clone, Debug, Default)]
struct Docket {
    /// The variables that it reads, by their places in the program.
    reads: Vec<usize>,
    /// Whether it was ever judged.
    judged: bool,
    /// Rows for which it was violated.
    violated: BTreeSet<Row>,
    /// Rows for which what was to come once has come.
    settled: BTreeSet<Row>,
    /// Rows that wait for what is to follow, and since when.
    waiting: BTreeMap<Row, Time>,
    /// Whether some row has not seen what is to come.
    lacks: bool,
    /// For a property of single robots the version of each one's state, in the order of the roster,
    /// at which nothing was out of the ordinary and nothing else was looked at: while it is the same
    /// the robot need not be judged again.
    marks: Vec<u64>,
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
            self.roster.clear();
            self.roster.extend(started());
            self.dockets
                .iter_mut()
                .for_each(|docket| docket.marks.clear());
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

/// One property before the court.
struct Hearing<'a> {
    court: Court<'a>,
    workspace: &'a mut Workspace,
    versions: &'a [u64],
    property: &'a Property,
    index: usize,
    docket: &'a mut Docket,
    violations: &'a mut Vec<Violation>,
}

impl Hearing<'_> {
    fn run(&mut self) {
        let size = usize::from(self.property.robots);
        if size > 0 && self.court.roster.is_empty() {
            return;
        }
        self.docket.judged = true;
        self.docket.lacks = false;
        if size == 1 {
            return self.run_singly();
        }
        let mut places: Vec<usize> = alloc::vec![0; size];
        let mut row: Row = Row::new();
        loop {
            row.clear();
            row.extend(
                places
                    .iter()
                    .filter_map(|&place| self.court.roster.get(place)),
            );
            if self.docket.violated.is_empty() || !self.docket.violated.contains(&row) {
                self.judge(&row);
            }
            // The next row, as an odometer counts.
            let last = self.court.roster.len().saturating_sub(1);
            let Some(turning) = places.iter().rposition(|&place| place < last) else {
                return;
            };
            places[turning] += 1;
            places[turning + 1..].fill(0);
        }
    }

    /// Judges the property of each robot whose state has changed, or that waits for something.
    fn run_singly(&mut self) {
        let (roster, versions) = (self.court.roster, self.versions);
        let mut marks = core::mem::take(&mut self.docket.marks);
        marks.resize(roster.len(), UNKNOWN);
        for ((robot, &version), mark) in roster.iter().zip(versions).zip(&mut marks) {
            if *mark == CLOSED {
                continue;
            }
            if *mark == version && version != UNKNOWN && self.stays_ordinary() {
                continue;
            }
            let row = core::slice::from_ref(robot);
            if !self.docket.violated.contains(row) {
                self.judge(row);
            }
            *mark = if self.is_closed(row) {
                CLOSED
            } else if self.court.looked_elsewhere.get() || self.docket.waiting.contains_key(row) {
                UNKNOWN
            } else {
                version
            };
        }
        self.docket.marks = marks;
    }

    /// What is said anew of a robot of which nothing has changed; false if it is to be judged again.
    fn stays_ordinary(&mut self) -> bool {
        if let Claim::Eventually { within, .. } = self.property.claim {
            self.docket.lacks = true;
            return within.is_none_or(|within| self.court.now <= Time(within));
        }
        true
    }

    /// Whether nothing can change any more for the row.
    fn is_closed(&self, row: &[RobotId]) -> bool {
        self.docket.violated.contains(row) || self.docket.settled.contains(row)
    }

    /// Judges the property of one row of robots; nothing, if it cannot be judged any more.
    fn judge(&mut self, row: &[RobotId]) {
        self.court.first = row.first().copied();
        self.court.looked_elsewhere.set(false);
        let judged = match self.property.claim {
            Claim::Always(holds) => self.always(holds, row),
            Claim::Eventually { holds, within } => self.eventually(holds, within, row),
            Claim::LeadsTo {
                cause,
                consequence,
                within,
            } => self.leads_to([cause, consequence], within, row),
        };
        if let Err(reason) = judged {
            self.docket.waiting.remove(row);
            self.docket.violated.insert(row.into());
            let violation = Violation::new(
                &self.court,
                (self.index, self.property),
                row,
                reason,
                &self.docket.reads,
            );
            self.violations.push(violation);
        }
    }

    fn always(&mut self, holds: u32, row: &[RobotId]) -> Result<(), Reason> {
        match self.holds(holds, row)? {
            true => Ok(()),
            false => Err(Reason::Untrue),
        }
    }

    fn eventually(
        &mut self,
        holds: u32,
        within: Option<u64>,
        row: &[RobotId],
    ) -> Result<(), Reason> {
        if self.docket.settled.contains(row) {
            return Ok(());
        }
        let within = within.map(Duration);
        if let Some(within) = within
            && self.court.now > Time::ZERO + within
        {
            self.holds(holds, row)?; // to see for whom it does not
            return Err(Reason::NotInTime { within });
        }
        match self.holds(holds, row)? {
            true => {
                self.docket.settled.insert(row.into());
            }
            false => self.docket.lacks = true,
        }
        Ok(())
    }

    fn leads_to(
        &mut self,
        [cause, consequence]: [u32; 2],
        within: Option<u64>,
        row: &[RobotId],
    ) -> Result<(), Reason> {
        let now = self.court.now;
        let since = match self.docket.waiting.get(row).copied() {
            Some(since) => since,
            None if self.holds(cause, row)? => now,
            None => return Ok(()),
        };
        let within = within.map(Duration);
        if let Some(within) = within
            && now > since + within
        {
            self.holds(consequence, row)?; // to see for whom it does not
            return Err(Reason::NotFollowed { since, within });
        }
        if self.holds(consequence, row)? {
            self.docket.waiting.remove(row);
        } else if since == now {
            self.docket.waiting.insert(row.into(), since);
        }
        Ok(())
    }

    fn holds(&mut self, function: u32, row: &[RobotId]) -> Result<bool, Reason> {
        let code = self.court.code;
        let program = code.program();
        let limits = limits(self.court.roster.len());
        self.court.last.set(None);
        Machine::holds(
            program,
            function,
            row,
            self.workspace,
            &mut self.court,
            limits,
        )
        .map_err(|error| Reason::Undecided(code.describe(&error)))
    }
}

/// A property may look at all robots, and at all pairs of them if they are not too many.
fn limits(robots: usize) -> Limits {
    let least = Limits::default();
    Limits {
        fuel: 10 * least.fuel + 10_000 * robots as u64,
        memory: least.memory + 1024 * robots,
    }
}
