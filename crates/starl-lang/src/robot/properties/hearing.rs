//! One property, judged at one moment of all rows of robots that it is about.

use super::docket::{CLOSED, Docket, Row, UNKNOWN};
use super::observables::Court;
use super::violation::{Reason, Violation};
use super::{Excuse, RECOVERY};
use crate::machine::{Claim, Limits, Machine, Property, Workspace};
use alloc::vec::Vec;
use starl_core::{Duration, RobotId, Time};

/// One property before the court.
pub struct Hearing<'a> {
    /// What can be seen.
    pub court: Court<'a>,
    /// Room for work.
    pub workspace: &'a mut Workspace,
    /// The versions of the states of those who have started, in their order.
    pub versions: &'a [u64],
    /// The property.
    pub property: &'a Property,
    /// Its place among the program's.
    pub index: usize,
    /// What is remembered of it.
    pub docket: &'a mut Docket,
    /// What has been found so far.
    pub violations: &'a mut Vec<Violation>,
}

impl Hearing<'_> {
    /// Judges all rows.
    pub fn run(&mut self) {
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
            } else if self.court.looked_elsewhere.get()
                || self.docket.waiting.contains_key(row)
                || self.property.is_timed()
            {
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
            return within.is_none_or(|within| self.elapsed(Time::ZERO, &[]) < Duration(within));
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
        let judged = match self.excuse(row) {
            Err(reason) => Err(reason),
            Ok(Some(excuse)) => {
                self.docket.waiting.remove(row);
                self.docket.lacks |= matches!(self.property.claim, Claim::Eventually { .. })
                    && !self.docket.settled.contains(row);
                if let Claim::Always(holds) = self.property.claim {
                    let is_true = self.holds(holds, row).unwrap_or(false);
                    self.forgive(row, is_true, excuse);
                }
                self.court.looked_elsewhere.set(true);
                return;
            }
            Ok(None) => self.claim(row),
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

    /// Why nothing is claimed of the row at this moment, if nothing is.
    fn excuse(&mut self, row: &[RobotId]) -> Result<Option<Excuse>, Reason> {
        if !row.iter().all(|robot| self.court.counts(*robot)) {
            return Ok(Some(Excuse::Down));
        }
        let now = self.court.now;
        let uncorrupted = self.court.fleet.uncorrupted();
        let recovery = self.property.recovery.map_or(RECOVERY, Duration);
        if !self.docket.reads.is_empty()
            && uncorrupted < recovery
            && uncorrupted < now.since(Time::ZERO)
        {
            return Ok(Some(Excuse::Corruption));
        }
        let is_assumed = match self.property.assumption {
            Some(assumption) => self.holds(assumption, row)?,
            None => true,
        };
        if is_assumed {
            return Ok(None);
        }
        self.docket.unassumed.insert(row.into(), now);
        Ok(Some(Excuse::Assumption))
    }

    /// Counts a row for which the property is false and excused, once each time that it becomes so.
    fn forgive(&mut self, row: &[RobotId], is_true: bool, excuse: Excuse) {
        if is_true {
            self.docket.forgiven.remove(row);
        } else if self.docket.forgiven.insert(row.into()) {
            *self.docket.excused.entry(excuse).or_default() += 1;
        }
    }

    /// Counts a deadline that is missed only because of a fault.
    fn forgive_lateness(&mut self, row: &[RobotId], since: Time, within: Duration, is_true: bool) {
        if self.court.now.since(since) > within {
            self.forgive(row, is_true, Excuse::Recovery);
        }
    }

    /// How long it is since a moment, since the last fault, and since what is assumed was not so.
    fn elapsed(&self, since: Time, row: &[RobotId]) -> Duration {
        let now = self.court.now;
        let unassumed = self.docket.unassumed.get(row);
        let since = unassumed.map_or(since, |unassumed| since.max(*unassumed));
        now.since(since).min(self.court.fleet.undisturbed())
    }

    fn claim(&mut self, row: &[RobotId]) -> Result<(), Reason> {
        match self.property.claim {
            Claim::Always(holds) => self.always(holds, row),
            Claim::EventuallyAlways { holds, within } => {
                // To be judged again although nothing may have changed.
                self.court.looked_elsewhere.set(true);
                let Some(within) = within.map(Duration) else {
                    return Ok(());
                };
                if self.elapsed(Time::ZERO, row) > within {
                    return self.always(holds, row);
                }
                if self.court.now.since(Time::ZERO) > within {
                    let is_true = self.holds(holds, row).unwrap_or(false);
                    self.forgive(row, is_true, Excuse::Recovery);
                }
                Ok(())
            }
            Claim::Eventually { holds, within } => self.eventually(holds, within, row),
            Claim::LeadsTo {
                cause,
                consequence,
                within,
            } => self.leads_to([cause, consequence], within, row),
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
        // Also where it is too late: to see for whom it does not hold.
        let is_true = self.holds(holds, row)?;
        if let Some(within) = within.map(Duration) {
            if is_late(self.elapsed(Time::ZERO, row), within, is_true) {
                return Err(Reason::NotInTime { within });
            }
            self.forgive_lateness(row, Time::ZERO, within, is_true);
        }
        if is_true {
            self.docket.settled.insert(row.into());
        } else {
            self.docket.lacks = true;
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
        let is_true = self.holds(consequence, row)?;
        if let Some(within) = within.map(Duration) {
            if is_late(self.elapsed(since, row), within, is_true) {
                return Err(Reason::NotFollowed { since, within });
            }
            self.forgive_lateness(row, since, within, is_true);
        }
        if is_true {
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

/// Whether what is or is not true now was to be true within a time of which so much has elapsed, and was not.
fn is_late(elapsed: Duration, within: Duration, is_true: bool) -> bool {
    elapsed > within || elapsed == within && !is_true
}

/// A property may look at all robots, and at all pairs of them if they are not too many.
pub(super) fn limits(robots: usize) -> Limits {
    let least = Limits::default();
    Limits {
        fuel: 10 * least.fuel + 10_000 * robots as u64,
        memory: least.memory + 1024 * robots,
    }
}
