//! The condition of robots and links: those that recorded faults excuse.
//!
//! A primitive's properties are promised for robots that work. Faults only ever excuse; they are read
//! from the trace like everything else. That two robots are in different parts of a partition shows in
//! the datagrams that are dropped for it: a partition that swallowed no datagram from one to the other
//! kept nothing from it. Two robots that do not know each other's present lives have to hear each other before the
//! first message can be delivered.

use crate::Excuse;
use crate::report::MessageKey;
use starl_core::event::{DropReason, Event, Fault};
use starl_core::{Duration, Intervention, Record, RobotId, Time};
use std::collections::BTreeMap;

/// The condition that a guarantee demands of a robot; each includes those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Needs {
    /// It is up, its program has not failed, and its variables are its own.
    Computing,
    /// Its sensors and its positioning are not frozen.
    Sensing,
    /// Its motors are not stuck.
    Moving,
}

/// A change of a robot's condition.
#[derive(Clone, Copy, Debug)]
pub(super) enum Change<'a> {
    /// A fault.
    Fault(&'a Fault),
    /// Its program cannot continue.
    Failed,
    /// Its body is moved from outside.
    Pushed,
}

impl<'a> Change<'a> {
    /// The change of a robot's condition that a record is about, or of the network's if it names no robot.
    pub fn of(record: &'a Record) -> Option<Change<'a>> {
        match &record.event {
            Event::Fault(fault) => Some(Change::Fault(fault)),
            Event::Failed(_) => Some(Change::Failed),
            _ => None,
        }
    }

    /// Whether the robot does nothing any more, or nothing until it starts again.
    pub fn is_end(self) -> bool {
        matches!(self, Change::Fault(Fault::Crash) | Change::Failed)
    }

    /// The excuse that it gives; none if it ends a fault.
    pub fn excuse(self) -> Option<Excuse> {
        match self {
            Change::Failed => Some(Excuse::Failed),
            Change::Pushed => Some(Excuse::Push),
            Change::Fault(Fault::Crash) => Some(Excuse::Down),
            Change::Fault(Fault::FrozenSensor) => Some(Excuse::Sensors),
            Change::Fault(Fault::StuckMotor) => Some(Excuse::Motors),
            Change::Fault(Fault::CorruptState) => Some(Excuse::Corruption),
            Change::Fault(Fault::Partition | Fault::OneWay) => Some(Excuse::Partition),
            Change::Fault(
                Fault::StorageLost | Fault::Restart | Fault::Heal | Fault::Repair | Fault::Other(_),
            ) => None,
        }
    }

    /// Whether the robot's variables were overwritten.
    pub fn is_corruption(self) -> bool {
        matches!(self, Change::Fault(Fault::CorruptState))
    }
}

/// Which robots were unwell until when, and which links cut.
#[derive(Clone, Debug)]
pub(super) struct Health {
    needs: Needs,
    robots: Vec<Condition>,
    /// When a datagram from one robot to another was last dropped for a partition.
    cuts: BTreeMap<(RobotId, RobotId), Time>,
    /// Cuts older than this are forgotten.
    memory: Duration,
    /// Senders, their lives and receivers, where a message of this life has been delivered since the receiver started:
    /// the last cut of the way back before the first delivery.
    met: BTreeMap<(RobotId, u32, RobotId), Option<Time>>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Condition {
    down: bool,
    failed: bool,
    sensors_frozen: bool,
    motor_stuck: bool,
    /// The last moment at which it was unwell; [`Time::NEVER`] while it is.
    unwell: Option<Time>,
    /// Why it was unwell then.
    why: Option<Excuse>,
}

impl Health {
    /// All robots work. Queries about cuts go back at most `memory`.
    pub fn new(robots: usize, needs: Needs, memory: Duration) -> Health {
        Health {
            needs,
            robots: vec![Condition::default(); robots],
            cuts: BTreeMap::new(),
            memory,
            met: BTreeMap::new(),
        }
    }

    /// Records faults.
    pub fn observe(&mut self, record: &Record) {
        if let Some(change) = Change::of(record) {
            match record.robot {
                Some(robot) => self.change(robot, record.at, change),
                None => {
                    let oldest = record.at - self.memory;
                    self.cuts.retain(|_, at| *at >= oldest);
                }
            }
        }
        match &record.event {
            Event::Intervention(what) => {
                if let Intervention::Push { robot, .. } = **what {
                    self.change(robot, record.at, Change::Pushed);
                }
            }
            &Event::Dropped {
                from,
                to: Some(to),
                reason: DropReason::Partition,
                ..
            } => {
                self.cuts.insert((from, to), record.at);
            }
            _ => {}
        }
    }

    /// Whether the robot has been well from `since` on.
    pub fn well_since(&self, robot: RobotId, since: Time) -> bool {
        let condition = self.robots.get(robot.index());
        condition.is_none_or(|condition| condition.unwell.is_none_or(|until| until < since))
    }

    /// Why the robot was unwell when it was last.
    pub fn excuse(&self, robot: RobotId) -> Excuse {
        let condition = self.robots.get(robot.index());
        let why = condition.and_then(|condition| condition.why);
        why.unwrap_or(Excuse::Recovery)
    }

    /// Since when the robot has been well; [`Time::NEVER`] while it is not.
    pub fn well_from(&self, robot: RobotId) -> Time {
        let condition = self.robots.get(robot.index());
        condition
            .and_then(|condition| condition.unwell)
            .unwrap_or_default()
    }

    /// Whether no datagram from one robot to another fell victim to a partition from `since` on.
    pub fn linked_since(&self, from: RobotId, to: RobotId, since: Time) -> bool {
        self.cuts.get(&(from, to)).is_none_or(|&at| at < since)
    }

    /// The excuse for a message that was sent at `since` and did not reach a robot; none if there is none.
    pub fn excuse_of(&self, message: &MessageKey, to: RobotId, since: Time) -> Option<Excuse> {
        let &MessageKey {
            from, incarnation, ..
        } = message;
        let unwell = [from, to]
            .into_iter()
            .find(|robot| !self.well_since(*robot, since));
        // Until they have met, the sender has to hear the receiver too.
        let is_heard = match self.met.get(&(from, incarnation, to)) {
            Some(cut) => cut.is_none_or(|at| at < since),
            None => self.linked_since(to, from, since),
        };
        let is_linked = is_heard && self.linked_since(from, to, since);
        let parted = (!is_linked).then_some(Excuse::Partition);
        unwell.map(|robot| self.excuse(robot)).or(parted)
    }

    /// A message was delivered to a robot, perhaps of a life of its sender that is over.
    pub fn delivered(&mut self, message: &MessageKey, to: RobotId) {
        let lives = (message.from, message.incarnation, to);
        let cut = self.cuts.get(&(to, message.from)).copied();
        self.met.entry(lives).or_insert(cut);
    }

    fn change(&mut self, robot: RobotId, at: Time, change: Change<'_>) {
        if change.is_end() {
            self.met
                .retain(|&(from, _, to), _| from != robot && to != robot);
        }
        let needs = self.needs;
        let Some(condition) = self.robots.get_mut(robot.index()) else {
            return;
        };
        let was_unwell = condition.is_unwell(needs);
        let mut for_a_moment = false;
        match change {
            Change::Failed => condition.failed = true,
            // It has to move back by itself, or is where it is not to be.
            Change::Pushed => for_a_moment = needs >= Needs::Moving,
            // A robot that crashes has no other trouble.
            Change::Fault(Fault::Crash) => {
                *condition = Condition {
                    down: true,
                    ..Condition::default()
                }
            }
            Change::Fault(Fault::Restart) => condition.down = false,
            Change::Fault(Fault::FrozenSensor) => condition.sensors_frozen = true,
            Change::Fault(Fault::StuckMotor) => condition.motor_stuck = true,
            Change::Fault(Fault::Repair) => {
                (condition.sensors_frozen, condition.motor_stuck) = (false, false);
            }
            Change::Fault(Fault::CorruptState) => for_a_moment = true,
            Change::Fault(
                Fault::StorageLost
                | Fault::Partition
                | Fault::OneWay
                | Fault::Heal
                | Fault::Other(_),
            ) => {}
        }
        if condition.is_unwell(needs) {
            condition.unwell = Some(Time::NEVER);
            condition.why = change.excuse().or(condition.why);
        } else if was_unwell || for_a_moment {
            condition.unwell = Some(at);
            condition.why = change.excuse().or(condition.why);
        }
    }
}

impl Condition {
    fn is_unwell(&self, needs: Needs) -> bool {
        self.down
            || self.failed
            || (needs >= Needs::Sensing && self.sensors_frozen)
            || (needs >= Needs::Moving && self.motor_stuck)
    }
}
