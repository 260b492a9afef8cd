//! Broadcast's delivery bound (thesis, section 3.3.1): every process receives a message within d1 of
//! its broadcast.
//!
//! It is owed by every other robot until the bound runs out or the sender reports that it has given
//! the robot up, whichever is first. Excused are robots that were down, and all of them where the
//! sender was; and those to which a partition swallowed a datagram of the sender's meanwhile.

use super::health::{Health, Needs};
use super::outstanding::Outstanding;
use super::report::{MessageKey, Report};
use super::{Checker, Kinds, Setting, Violation, robot_list};
use crate::scenario::Scenario;
use starl_core::event::{Event, Value};
use starl_core::{Duration, Record, RobotId, Time};

const DELIVERY: &str = "broadcast.delivery";

/// Watches every message sent through a Broadcast.
#[derive(Clone, Debug)]
pub(super) struct Broadcast {
    robots: u32,
    bound: Duration,
    health: Health,
    outstanding: Outstanding<Message>,
}

#[derive(Clone, Debug)]
struct Message {
    sent: Time,
    /// Who has not delivered it, in the order of their numbers.
    owed: Vec<RobotId>,
}

impl Broadcast {
    pub fn new(scenario: &Scenario, setting: &Setting) -> Broadcast {
        let bound = scenario.properties.broadcast_bound;
        Broadcast {
            robots: setting.bodies.len() as u32,
            bound,
            health: Health::new(setting.bodies.len(), Needs::Computing, bound),
            outstanding: Outstanding::default(),
        }
    }

    fn sent(&mut self, report: &Report<'_>) {
        let bound = match report.get("order") {
            // That is another property: `broadcast.agreement`.
            Some(Value::Text(order)) if order == "total" => return,
            // Another message may have to be given up before this one is handed out.
            Some(Value::Text(order)) if order == "causal" => self.bound + self.bound,
            _ => self.bound,
        };
        if let Some(key) = report.message(report.robot) {
            let others = (0..self.robots).map(RobotId);
            let message = Message {
                sent: report.at,
                owed: others.filter(|&robot| robot != report.robot).collect(),
            };
            self.outstanding.insert(key, report.at + bound, message);
        }
    }

    fn delivered(&mut self, report: &Report<'_>) {
        let Some(key) = report.arrival() else { return };
        if let Some(message) = self.outstanding.get_mut(&key) {
            if let Ok(index) = message.owed.binary_search(&report.robot) {
                message.owed.remove(index);
            }
            if message.owed.is_empty() {
                self.outstanding.remove(&key);
            }
        }
    }

    /// The sender has given robots up.
    fn failed(&mut self, report: &Report<'_>, found: &mut Vec<Violation>) {
        let (Some(key), Some(Value::Robots(given_up))) =
            (report.message(report.robot), report.get("to"))
        else {
            return;
        };
        let Some(message) = self.outstanding.get_mut(&key) else {
            return;
        };
        let (lost, owed) = message
            .owed
            .iter()
            .partition(|robot| given_up.contains(robot));
        message.owed = owed;
        let lost = Message {
            sent: message.sent,
            owed: lost,
        };
        let settled = message.owed.is_empty();
        if settled {
            self.outstanding.remove(&key);
        }
        let how = format!(
            "before its sender gave up after {:.3} s",
            report.at.since(lost.sent).seconds()
        );
        self.judge(report.at, &key, &lost, &how, found);
    }

    fn check_bound(&mut self, now: Time, found: &mut Vec<Violation>) {
        while let Some((due, key, message)) = self.outstanding.pop_overdue(now) {
            self.judge(
                due,
                &key,
                &message,
                &format!("within {}", self.bound),
                found,
            );
        }
    }

    /// Reports a message that did not get through to those who are still owed it.
    fn judge(
        &self,
        at: Time,
        key: &MessageKey,
        message: &Message,
        how: &str,
        found: &mut Vec<Violation>,
    ) {
        let MessageKey { from, number, .. } = *key;
        let sent = message.sent;
        if !self.health.well_since(from, sent) {
            return;
        }
        let to_blame = |&robot: &RobotId| {
            self.health.well_since(robot, sent) && self.health.linked_since(from, robot, sent)
        };
        let missed: Vec<RobotId> = message.owed.iter().copied().filter(to_blame).collect();
        if missed.is_empty() {
            return;
        }
        found.push(Violation {
            property: DELIVERY.into(),
            at,
            text: format!(
                "message {number} that robot {from} broadcast at {sent} did not reach {} {how}",
                robot_list(&missed),
            ),
            robots: [from].into_iter().chain(missed).collect(),
        });
    }
}

impl Checker for Broadcast {
    fn properties(&self) -> &'static [&'static str] {
        &[DELIVERY]
    }

    fn heeds(&self) -> Kinds {
        // What is overdue is found at the next record of any kind.
        match self.outstanding.oldest() {
            None => Kinds::REPORTS | Kinds::DROPPED,
            Some(_) => Kinds::ALL,
        }
    }

    fn observe(&mut self, record: &Record, violations: &mut Vec<Violation>) {
        // Recorded ahead of its time where a datagram waits in the sender's queue.
        if matches!(record.event, Event::Dropped { .. }) {
            return self.health.observe(record);
        }
        self.check_bound(record.at, violations);
        match &record.event {
            Event::Primitive { .. } => {
                let Some(report) = Report::of(record, "broadcast") else {
                    return;
                };
                match report.name {
                    "broadcast" => self.sent(&report),
                    "deliver" => self.delivered(&report),
                    "fail" => self.failed(&report, violations),
                    _ => {}
                }
            }
            Event::Fault(_) | Event::Failed(_) => self.health.observe(record),
            _ => {}
        }
    }

    fn advance(&mut self, now: Time, violations: &mut Vec<Violation>) {
        self.check_bound(now, violations);
    }
}
