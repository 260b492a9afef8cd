//! Evaluates one property at one moment for all tuples of robots.

use super::excuse::{Excuse, RECOVERY};
use super::history::{CLOSED, History, Row, UNKNOWN};
use super::host::PropertyHost;
use super::violation::{Reason, Violation};
use crate::machine::{Claim, Limits, Machine, Property, Workspace};
use alloc::vec::Vec;
use starl_core::{Duration, RobotId, Time};

/// The evaluation of one property.
pub struct Evaluation<'a> {
    /// The state that the property reads.
    pub host: PropertyHost<'a>,
    /// Scratch memory.
    pub workspace: &'a mut Workspace,
    /// The versions of the states of the started robots, in their order.
    pub versions: &'a [u64],
    pub property: &'a Property,
    /// Its index among the program's properties.
    pub index: usize,
    pub history: &'a mut History,
    /// The violations found so far.
    pub violations: &'a mut Vec<Violation>,
}

impl Evaluation<'_> {
    /// Judges all rows.
    pub fn run(&mut self) {
        let size = usize::from(self.property.robots);
        if size > 0 && self.host.roster.is_empty() {
            return;
        }
        self.history.judged = true;
        self.history.lacks = false;
        if size == 1 {
            return self.run_singly();
        }
        // Found once and not for each row: whether a robot counts depends on where all robots that are down lie.
        let roster = self.host.roster.iter();
        let counted: Vec<bool> = roster.map(|robot| self.host.counts(*robot)).collect();
        let mut places: Vec<usize> = alloc::vec![0; size];
        let mut row: Row = Row::new();
        loop {
            row.clear();
            row.extend(
                places
                    .iter()
                    .filter_map(|&place| self.host.roster.get(place)),
            );
            if self.history.violated.is_empty() || !self.history.violated.contains(&row) {
                let all_count = places.iter().all(|&place| counted[place]);
                self.judge(&row, all_count);
            }
            // The next row, as an odometer counts.
            let last = self.host.roster.len().saturating_sub(1);
            let Some(turning) = places.iter().rposition(|&place| place < last) else {
                return;
            };
            places[turning] += 1;
            places[turning + 1..].fill(0);
        }
    }

    /// Judges the property of each robot whose state has changed, or that waits for something.
    fn run_singly(&mut self) {
        let (roster, versions) = (self.host.roster, self.versions);
        let mut marks = core::mem::take(&mut self.history.marks);
        marks.resize(roster.len(), UNKNOWN);
        for ((robot, &version), mark) in roster.iter().zip(versions).zip(&mut marks) {
            if *mark == CLOSED {
                continue;
            }
            if *mark == version && version != UNKNOWN && self.stays_ordinary() {
                continue;
            }
            let row = core::slice::from_ref(robot);
            if !self.history.violated.contains(row) {
                let counts = self.host.counts(*robot);
                self.judge(row, counts);
            }
            *mark = if self.is_closed(row) {
                CLOSED
            } else if self.host.looked_elsewhere.get()
                || self.history.waiting.contains_key(row)
                || self.property.is_timed()
            {
                UNKNOWN
            } else {
                version
            };
        }
        self.history.marks = marks;
    }

    /// Judges a robot whose state is unchanged; false if it must be evaluated again.
    fn stays_ordinary(&mut self) -> bool {
        if let Claim::Eventually { within, .. } = self.property.claim {
            self.history.lacks = true;
            return within.is_none_or(|within| self.elapsed(Time::ZERO, &[]) < Duration(within));
        }
        true
    }

    /// Whether the verdict on the row is final.
    fn is_closed(&self, row: &[RobotId]) -> bool {
        self.history.violated.contains(row) || self.history.settled.contains(row)
    }

    /// Judges the property for one row of robots, unless the verdict is final. `all_count` tells whether it is judged
    /// for each of them now.
    fn judge(&mut self, row: &[RobotId], all_count: bool) {
        self.host.first = row.first().copied();
        self.host.looked_elsewhere.set(false);
        let judged = match self.excuse(row, all_count) {
            Err(reason) => Err(reason),
            Ok(Some(excuse)) => {
                self.history.waiting.remove(row);
                self.history.lacks |= matches!(self.property.claim, Claim::Eventually { .. })
                    && !self.history.settled.contains(row);
                if let Claim::Always(holds) = self.property.claim {
                    let is_true = self.holds(holds, row).unwrap_or(false);
                    self.forgive(row, is_true, excuse);
                }
                self.host.looked_elsewhere.set(true);
                return;
            }
            Ok(None) => self.claim(row),
        };
        if let Err(reason) = judged {
            self.history.waiting.remove(row);
            self.history.violated.insert(row.into());
            let violation = Violation::new(
                &self.host,
                (self.index, self.property),
                row,
                reason,
                &self.history.reads,
            );
            self.violations.push(violation);
        }
    }

    /// The excuse of the row at this moment, if it has one.
    fn excuse(&mut self, row: &[RobotId], all_count: bool) -> Result<Option<Excuse>, Reason> {
        if !all_count {
            return Ok(Some(Excuse::Down));
        }
        let now = self.host.now;
        let uncorrupted = self.host.fleet.uncorrupted();
        let recovery = self.property.recovery.map_or(RECOVERY, Duration);
        if self.history.reads.has_variables()
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
        self.history.unassumed.insert(row.into(), now);
        Ok(Some(Excuse::Assumption))
    }

    /// Counts a row for which the property is false and excused, once each time that it becomes so.
    fn forgive(&mut self, row: &[RobotId], is_true: bool, excuse: Excuse) {
        if is_true {
            self.history.forgiven.remove(row);
        } else if self.history.forgiven.insert(row.into()) {
            *self.history.excused.entry(excuse).or_default() += 1;
        }
    }

    /// Counts a deadline that is missed only because of a fault.
    fn forgive_lateness(&mut self, row: &[RobotId], since: Time, within: Duration, is_true: bool) {
        if self.host.now.since(since) > within {
            self.forgive(row, is_true, Excuse::Recovery);
        }
    }

    /// The time since the latest of three moments: the given one, the last fault, and the last time the assumption was
    /// false.
    fn elapsed(&self, since: Time, row: &[RobotId]) -> Duration {
        let now = self.host.now;
        let unassumed = self.history.unassumed.get(row);
        let since = unassumed.map_or(since, |unassumed| since.max(*unassumed));
        now.since(since).min(self.host.fleet.undisturbed())
    }

    fn claim(&mut self, row: &[RobotId]) -> Result<(), Reason> {
        match self.property.claim {
            Claim::Always(holds) => self.always(holds, row),
            Claim::EventuallyAlways { holds, within } => {
                // Judge it again even if the state has not changed.
                self.host.looked_elsewhere.set(true);
                let Some(within) = within.map(Duration) else {
                    return Ok(());
                };
                if self.elapsed(Time::ZERO, row) > within {
                    return self.always(holds, row);
                }
                if self.host.now.since(Time::ZERO) > within {
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
        if self.history.settled.contains(row) {
            return Ok(());
        }
        // Evaluated even after the deadline, to find the robots for which it is false.
        let is_true = self.holds(holds, row)?;
        if let Some(within) = within.map(Duration) {
            if is_late(self.elapsed(Time::ZERO, row), within, is_true) {
                return Err(Reason::NotInTime { within });
            }
            self.forgive_lateness(row, Time::ZERO, within, is_true);
        }
        if is_true {
            self.history.settled.insert(row.into());
        } else {
            self.history.lacks = true;
        }
        Ok(())
    }

    fn leads_to(
        &mut self,
        [cause, consequence]: [u32; 2],
        within: Option<u64>,
        row: &[RobotId],
    ) -> Result<(), Reason> {
        let now = self.host.now;
        let since = match self.history.waiting.get(row).copied() {
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
            self.history.waiting.remove(row);
        } else if since == now {
            self.history.waiting.insert(row.into(), since);
        }
        Ok(())
    }

    fn holds(&mut self, function: u32, row: &[RobotId]) -> Result<bool, Reason> {
        let code = self.host.code;
        let program = code.program();
        let limits = limits(self.host.roster.len());
        self.host.last.set(None);
        Machine::holds(
            program,
            function,
            row,
            self.workspace,
            &mut self.host,
            limits,
        )
        .map_err(|error| Reason::Undecided(code.describe(&error)))
    }
}

/// Whether a condition is late: its deadline has passed without it being true before.
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
