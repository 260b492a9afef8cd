//! Broadcast's delivery bound (thesis, section 3.3.1): every process receives a message within d1 of
//! its broadcast.
//!
//! Every other robot must deliver the message until the bound ends or the sender reports that it has given the robot
//! up, whichever is first. If the sender reports it as acknowledged, all must have delivered it. In causal order a robot
//! may hold a message back that it has received, so that only the bound counts there. Excused are robots that were
//! down, all robots if the sender was down, and robots to which a partition dropped a datagram of the sender meanwhile.
//! A robot that passes a message over is excused if a partition dropped one of its own to the sender.

use super::health::{Health, Needs};
use super::outstanding::Outstanding;
use super::report::{MessageKey, Report};
use super::{Checker, Excuse, Excused, Kinds, Setting, Violation, robot_list};
use starl_core::event::messaging::Order;
use starl_core::event::{BroadcastEvent, Event, TransferEvent};
use starl_core::{Duration, Record, RobotId, Time};

const DELIVERY: &str = "broadcast.delivery";

/// Watches every message sent through a Broadcast.
#[derive(Clone, Debug)]
pub(super) struct Broadcast {
    robots: u32,
    bound: Duration,
    health: Health,
    outstanding: Outstanding<Message>,
    excused: Excused,
}

#[derive(Clone, Debug)]
struct Message {
    sent: Time,
    /// In causal order a robot may hold back what it has received, so that neither acknowledgements nor their absence
    /// say whether it has delivered it.
    is_causal: bool,
    /// The robots that have not delivered it, in the order of their numbers.
    owed: Vec<RobotId>,
}

impl Broadcast {
    pub fn new(setting: &Setting) -> Broadcast {
        let bound = setting.properties.broadcast_bound;
        Broadcast {
            robots: setting.bodies.len() as u32,
            bound,
            // As long as the longest bound, that of causal order.
            health: Health::new(setting.bodies.len(), Needs::Computing, bound + bound),
            outstanding: Outstanding::default(),
            excused: Excused::default(),
        }
    }

    fn reported(&mut self, report: &Report<'_, BroadcastEvent>, found: &mut Vec<Violation>) {
        let Report { at, robot, .. } = *report;
        match report.event {
            BroadcastEvent::Broadcast { message, order, .. } => {
                self.sent(at, report.message(robot, *message), *order);
            }
            BroadcastEvent::Transfer(TransferEvent::Deliver { from, message }) => {
                let key = report.message(*from, *message);
                self.health.delivered(&key, robot);
                self.delivered(key, robot);
            }
            BroadcastEvent::Transfer(TransferEvent::Fail { message, to }) => {
                self.failed(at, report.message(robot, *message), to, found);
            }
            BroadcastEvent::Transfer(TransferEvent::Acknowledged { message, .. }) => {
                self.acknowledged(at, report.message(robot, *message), found);
            }
            BroadcastEvent::PassOver { from, message } => {
                self.passed_over(report.message(*from, *message), robot);
            }
            _ => {}
        }
    }

    fn sent(&mut self, at: Time, key: MessageKey, order: Option<Order>) {
        let bound = match order {
            // That is another property: `broadcast.agreement`.
            Some(Order::Total) => return,
            // Another message may have to be given up before this one is delivered.
            Some(Order::Causal) => self.bound + self.bound,
            Some(Order::Fifo) | None => self.bound,
        };
        let others = (0..self.robots).map(RobotId);
        let message = Message {
            sent: at,
            is_causal: order == Some(Order::Causal),
            owed: others.filter(|&robot| robot != key.from).collect(),
        };
        // A robot alone has no receivers, so its message is complete at once.
        if !message.owed.is_empty() {
            self.outstanding.insert(key, at + bound, message);
        }
    }

    /// A robot is owed the message no longer. Says whether it was.
    fn delivered(&mut self, key: MessageKey, robot: RobotId) -> bool {
        let Some(message) = self.outstanding.get_mut(&key) else {
            return false;
        };
        let place = message.owed.binary_search(&robot);
        if let Ok(index) = place {
            message.owed.remove(index);
        }
        if message.owed.is_empty() {
            self.outstanding.remove(&key);
        }
        place.is_ok()
    }

    /// In causal order a robot gives a message up. It may have to ask the sender before it can deliver the message.
    fn passed_over(&mut self, key: MessageKey, robot: RobotId) {
        let sent = self.outstanding.get_mut(&key).map(|message| message.sent);
        if let Some(sent) = sent
            && !self.health.linked_since(robot, key.from, sent)
            && self.delivered(key, robot)
        {
            self.excused.note(DELIVERY, Excuse::Partition);
        }
    }

    /// The sender reports that all robots have the message. No fault excuses a sender that believes what is not so.
    fn acknowledged(&mut self, at: Time, key: MessageKey, found: &mut Vec<Violation>) {
        let message = self.outstanding.get_mut(&key);
        let Some(message) = message.filter(|message| !message.is_causal) else {
            return;
        };
        let owed = core::mem::take(&mut message.owed);
        self.outstanding.remove(&key);
        let MessageKey { from, number, .. } = key;
        let text = format!(
            "robot {from} reports that all robots have acknowledged its message {number}, which was not delivered to {}",
            robot_list(&owed)
        );
        let robots: Vec<RobotId> = [from].into_iter().chain(owed).collect();
        found.push(Violation::new(DELIVERY, at, robots, text));
    }

    /// The sender has given robots up.
    fn failed(
        &mut self,
        at: Time,
        key: MessageKey,
        given_up: &[RobotId],
        found: &mut Vec<Violation>,
    ) {
        let message = self.outstanding.get_mut(&key);
        let Some(message) = message.filter(|message| !message.is_causal) else {
            return;
        };
        let (lost, owed) = message
            .owed
            .iter()
            .partition(|robot| given_up.contains(robot));
        message.owed = owed;
        let lost = Message {
            owed: lost,
            ..*message
        };
        let settled = message.owed.is_empty();
        if settled {
            self.outstanding.remove(&key);
        }
        let how = format!(
            "before its sender gave up after {:.3} s",
            at.since(lost.sent).seconds()
        );
        self.judge(at, &key, &lost, &how, found);
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

    /// Reports a message that did not reach the robots that must deliver it.
    fn judge(
        &mut self,
        at: Time,
        key: &MessageKey,
        message: &Message,
        how: &str,
        found: &mut Vec<Violation>,
    ) {
        let MessageKey { from, number, .. } = *key;
        let sent = message.sent;
        let mut missed = Vec::new();
        for &robot in &message.owed {
            match self.health.excuse_of(key, robot, sent) {
                Some(excuse) => self.excused.note(DELIVERY, excuse),
                None => missed.push(robot),
            }
        }
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
        // Missed deadlines are found at the next record of any kind.
        match self.outstanding.oldest() {
            None => Kinds::REPORTS | Kinds::DROPPED,
            Some(_) => Kinds::ALL,
        }
    }

    fn is_owed(&self, property: &str) -> bool {
        property == DELIVERY && self.outstanding.oldest().is_some()
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
            Event::Fault(_) | Event::Failed(_) => self.health.observe(record),
            _ => {}
        }
    }

    fn advance(&mut self, now: Time, violations: &mut Vec<Violation>) {
        self.check_bound(now, violations);
    }
}
