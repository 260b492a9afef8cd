//! The writes that robots must show, with their deadlines.

use super::element::{Element, Shown, Stamp};
use super::{CONVERGENCE, SharedMemory};
use crate::{Excuse, Violation, robot_list};
use starl_core::{Port, RobotId, Time};
use std::fmt;
use std::sync::Arc;

/// An element by its names.
#[derive(Clone, Debug)]
pub(super) struct Address {
    pub port: Port,
    pub variable: Arc<str>,
    pub owner: Option<RobotId>,
}

/// A write that a robot must show.
#[derive(Clone, Debug)]
pub(super) struct Debt {
    pub address: Address,
    pub stamp: Stamp,
    /// When it was written.
    pub written: Time,
    /// To this robot; none where it is all.
    pub to: Option<RobotId>,
}

/// Whether a robot is yet to show a write.
enum Verdict {
    /// It shows the write, according to the records.
    Settled,
    /// It does not show the write, and no remaining robot does.
    Lost,
    /// It does not, and should have by now.
    Late,
    /// It must show it by then.
    Due(Time),
}

impl SharedMemory {
    pub(super) fn owe(&mut self, due: Time, debt: Debt) {
        self.debts += 1;
        self.owed.insert((due, self.debts), debt);
    }

    /// Judges the writes with a deadline before `now`.
    pub(super) fn check_bound(&mut self, now: Time, found: &mut Vec<Violation>) {
        while let Some(first) = self.owed.first_entry() {
            let due = first.key().0;
            if due >= now {
                return;
            }
            let debt = first.remove();
            self.settle(due, &debt, found);
        }
    }

    fn settle(&mut self, now: Time, debt: &Debt, found: &mut Vec<Violation>) {
        let Address {
            port,
            variable,
            owner,
        } = &debt.address;
        let Some(memory) = self.memories.get(port) else {
            return;
        };
        let elements = memory.variables.get(variable);
        let Some(element) = elements.and_then(|elements| elements.get(owner)) else {
            return;
        };
        let is_latest = element.latest().is_none_or(|latest| latest <= debt.stamp);
        let (mut late, mut due) = (Vec::new(), Vec::new());
        let mut excused = Vec::new();
        let mut everyone = debt.to.is_none();
        // Robots that joined later have their own entries.
        let members = memory.members.iter();
        let robots = members.filter_map(|(&robot, &joined)| match debt.to {
            None => (joined <= debt.written).then_some(robot),
            Some(to) => (to == robot).then_some(robot),
        });
        for robot in robots {
            match self.judge(robot, debt, element, now) {
                Verdict::Settled => continue,
                Verdict::Lost => {
                    excused.push(self.health.excuse(debt.stamp.writer));
                    continue;
                }
                Verdict::Late => late.push(robot),
                // A later write is to be shown too, and stands for this one.
                Verdict::Due(time) if is_latest => {
                    excused.push(self.excuse(robot, debt, now));
                    due.push((time, robot));
                }
                Verdict::Due(_) => {}
            }
            everyone = false;
        }
        for excuse in excused {
            self.excused.note(CONVERGENCE, excuse);
        }
        if everyone {
            self.forget(debt);
        }
        for (time, robot) in due {
            let to = Some(robot);
            self.owe(time, Debt { to, ..debt.clone() });
        }
        if !late.is_empty() {
            let text = format!(
                "{} did not show what robot {} wrote to {} at {} within {}",
                robot_list(&late),
                debt.stamp.writer,
                debt.address,
                debt.written,
                self.bound
            );
            found.push(Violation {
                property: CONVERGENCE.into(),
                at: now,
                robots: [debt.stamp.writer].into_iter().chain(late).collect(),
                text,
            });
        }
    }

    /// Whether a robot shows a write, or else which robot must pass it on, and since when.
    fn judge(&self, robot: RobotId, debt: &Debt, element: &Element, now: Time) -> Verdict {
        let shown = element.shown.get(&robot);
        if shown.is_some_and(|shown| shown.may_be_at_least(debt.stamp)) {
            return Verdict::Settled;
        }
        // Since when a robot has been in a state to keep the promise.
        let ready = |robot| self.health.well_from(robot);
        let holders = element.shown.iter().filter_map(|(&holder, shown)| {
            let Shown::Write(stamp, since) = *shown else {
                return None;
            };
            // The writer has shown it or later ones ever since.
            let is_writer = holder == debt.stamp.writer && holder != robot;
            let since = if is_writer {
                since.min(debt.written)
            } else {
                since
            };
            let together = self.parts.together_since(holder, robot);
            (stamp >= debt.stamp).then(|| since.max(ready(holder)).max(together))
        });
        let Some(owed_since) = holders.min() else {
            return Verdict::Lost;
        };
        let owed_since = owed_since.max(ready(robot));
        if owed_since == Time::NEVER {
            // No robot can pass it on now.
            return Verdict::Due(now + self.bound);
        }
        let due = owed_since + self.bound;
        if due <= now {
            Verdict::Late
        } else {
            Verdict::Due(due)
        }
    }

    /// Why a robot need not show a write yet.
    fn excuse(&self, robot: RobotId, debt: &Debt, now: Time) -> Excuse {
        let concerned = [robot, debt.stamp.writer].into_iter();
        let mut unwell = concerned.filter(|robot| {
            let since = self.health.well_from(*robot);
            since != Time::ZERO && (since == Time::NEVER || since + self.bound > now)
        });
        unwell
            .next()
            .map_or(Excuse::Partition, |robot| self.health.excuse(robot))
    }

    /// Everyone shows a write; those before it are not asked for again.
    fn forget(&mut self, debt: &Debt) {
        let Address {
            port,
            variable,
            owner,
        } = &debt.address;
        let memory = self.memories.get_mut(port);
        let elements = memory.and_then(|memory| memory.variables.get_mut(variable));
        if let Some(element) = elements.and_then(|elements| elements.get_mut(owner)) {
            element.forget_before(debt.stamp);
        }
    }
}

impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.owner {
            None => write!(f, "{}", self.variable),
            Some(owner) => write!(f, "{}[{owner}]", self.variable),
        }
    }
}
