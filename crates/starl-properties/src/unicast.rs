//! Unicast: a message to a robot reaches it in time, and once.
//!
//! If a sender reports a message as acknowledged, it must have arrived. A message is judged at the end of the bound
//! or when its sender reports that it gives up, whichever is first. A message is excused if its sender or its
//! receiver was down, or if a partition dropped it.

use super::health::{Health, Needs};
use super::report::{MessageKey, Report};
use super::taken::Taken;
use super::{Checker, Excuse, Excused, Kinds, Setting, Violation};
use starl_core::event::{Event, Fault, TransferEvent, UnicastEvent};
use starl_core::{Duration, Record, RobotId, Time};
use std::collections::{BTreeMap, VecDeque};

const DELIVERY: &str = "unicast.delivery";
const INTEGRITY: &str = "unicast.integrity";

/// Watches every instance of Unicast in the fleet.
#[derive(Clone, Debug)]
pub(super) struct Unicast {
    robots: usize,
    bound: Duration,
    health: Health,
    /// When each message was sent that has not been delivered. Numbers are counted for each receiver.
    owed: BTreeMap<(MessageKey, RobotId), Time>,
    /// By when each is owed, in this order.
    due: VecDeque<(Time, MessageKey, RobotId)>,
    taken: Taken,
    /// Until then violations by invented state of a corruption do not count.
    void_until: Time,
    excused: Excused,
}

impl Unicast {
    pub fn new(setting: &Setting) -> Unicast {
        let bound = setting.properties.unicast_bound;
        let robots = setting.bodies.len();
        Unicast {
            robots,
            bound,
            health: Health::new(robots, Needs::Computing, bound),
            owed: BTreeMap::new(),
            due: VecDeque::new(),
            taken: Taken::default(),
            void_until: Time::ZERO,
            excused: Excused::default(),
        }
    }

    fn reported(&mut self, report: &Report<'_, UnicastEvent>, found: &mut Vec<Violation>) {
        let Report { at, robot, .. } = *report;
        match report.event {
            UnicastEvent::Send { message, to, .. } => {
                let key = report.message(robot, *message);
                self.taken.sent(&key, Some(*to));
                if to.index() < self.robots {
                    self.owed.insert((key, *to), at);
                    self.due.push_back((at + self.bound, key, *to));
                }
            }
            UnicastEvent::Transfer(TransferEvent::Deliver { from, message }) => {
                let key = report.message(*from, *message);
                self.health.delivered(&key, robot);
                self.owed.remove(&(key, robot));
                if let Some(what) = self.taken.take(robot, &key, Some(robot)) {
                    self.took(at, robot, &key, what, found);
                }
            }
            UnicastEvent::Transfer(TransferEvent::Fail { message, to }) => {
                let key = report.message(robot, *message);
                for &to in to {
                    self.judge(at, key, to, "before its sender gave it up", found);
                }
            }
            UnicastEvent::Transfer(TransferEvent::Acknowledged { message, to }) => {
                let key = report.message(robot, *message);
                self.acknowledged(at, key, *to, found);
            }
            UnicastEvent::Transfer(_) => {}
        }
    }

    fn took(
        &mut self,
        at: Time,
        robot: RobotId,
        key: &MessageKey,
        what: &str,
        found: &mut Vec<Violation>,
    ) {
        if at < self.void_until {
            return self.excused.note(INTEGRITY, Excuse::Corruption);
        }
        let MessageKey { from, number, .. } = *key;
        let text = format!("robot {robot} delivered message {number} of robot {from}, {what}");
        found.push(Violation::new(INTEGRITY, at, [robot, from], text));
    }

    /// No fault excuses a sender that believes what is not so.
    fn acknowledged(
        &mut self,
        at: Time,
        key: MessageKey,
        to: Option<RobotId>,
        found: &mut Vec<Violation>,
    ) {
        let Some(to) = to.filter(|to| self.owed.remove(&(key, *to)).is_some()) else {
            return;
        };
        let MessageKey { from, number, .. } = key;
        let text = format!(
            "robot {from} says that robot {to} has acknowledged its message {number}, which did not reach it"
        );
        found.push(Violation::new(DELIVERY, at, [from, to], text));
    }

    /// The message was to have reached the robot by now.
    fn judge(
        &mut self,
        at: Time,
        key: MessageKey,
        to: RobotId,
        how: &str,
        found: &mut Vec<Violation>,
    ) {
        let Some(sent) = self.owed.remove(&(key, to)) else {
            return;
        };
        let MessageKey { from, number, .. } = key;
        if let Some(excuse) = self.health.excuse_of(&key, to, sent) {
            return self.excused.note(DELIVERY, excuse);
        }
        let text = format!(
            "message {number} that robot {from} sent to robot {to} at {sent} did not reach it {how}"
        );
        found.push(Violation::new(DELIVERY, at, [from, to], text));
    }

    fn check_bound(&mut self, now: Time, found: &mut Vec<Violation>) {
        let how = format!("within {}", self.bound);
        while let Some((due, key, to)) = self.due.pop_front_if(|(due, ..)| *due < now) {
            self.judge(due, key, to, &how, found);
        }
    }
}

impl Checker for Unicast {
    fn properties(&self) -> &'static [&'static str] {
        &[DELIVERY, INTEGRITY]
    }

    fn heeds(&self) -> Kinds {
        Kinds::REPORTS | Kinds::DROPPED
    }

    fn is_owed(&self, property: &str) -> bool {
        property == DELIVERY && !self.owed.is_empty()
    }

    fn excused(&self, property: &str) -> Vec<(Excuse, u64)> {
        self.excused.of(property)
    }

    fn observe(&mut self, record: &Record, violations: &mut Vec<Violation>) {
        // Recorded ahead of its time where a datagram waits in the sender's queue.
        if matches!(record.event, Event::Dropped { .. }) {
            return self.health.observe(record);
        }
        self.check_bound(record.at, violations);
        match &record.event {
            Event::Primitive { .. } => {
                if let Some(report) = Report::of(record) {
                    self.reported(&report, violations);
                }
            }
            Event::Fault(fault) => {
                self.health.observe(record);
                match (record.robot, fault) {
                    (Some(robot), Fault::Crash) => self.taken.forget(robot),
                    (Some(_), Fault::CorruptState) => self.void_until = record.at + self.bound,
                    _ => {}
                }
            }
            Event::Failed(_) => self.health.observe(record),
            _ => {}
        }
    }

    fn advance(&mut self, now: Time, violations: &mut Vec<Violation>) {
        self.check_bound(now, violations);
    }
}
