//! The order of broadcasts (thesis, section 3.3.1: "FIFO ordering, causal ordering, and total ordering").
//!
//! The record of each sent message contains the order that its instance promises. Deliveries of a robot are
//! judged from one start to the next, because it keeps nothing when it stops. A message that it reports as
//! passed over, or a gap that it reports, excuses it from the delivery, never from the order.

mod agreement;
mod causal;
mod reach;
mod sequence;

use super::report::{MessageKey, Report};
use super::taken::Taken;
use super::{Checker, Excuse, Excused, Kinds, Setting, Violation, robot_list};
use agreement::Agreement;
use causal::Causality;
use reach::Reach;
use sequence::Sequences;
use starl_core::event::messaging::{LeaveReason, Order};
use starl_core::event::{BroadcastEvent, Event, Fault, TransferEvent};
use starl_core::{Duration, Port, Record, RobotId, Time};
use std::collections::BTreeMap;

const INTEGRITY: &str = "broadcast.integrity";
const FIFO: &str = "broadcast.fifo";
const CAUSAL: &str = "broadcast.causal_order";
const TOTAL: &str = "broadcast.total_order";
const AGREEMENT: &str = "broadcast.agreement";

/// A sender from one start to the next: the robot and its incarnation.
type Process = (RobotId, u32);

/// Watches all instances that promise an order.
#[derive(Clone, Debug)]
pub(super) struct BroadcastOrder {
    bound: Duration,
    instances: BTreeMap<Port, Instance>,
    /// The messages that were broadcast without order, and delivered.
    unordered: Taken,
    agreement: Agreement,
    /// For total order: which robots can have its messages.
    reach: Reach,
    /// Whether some state was corrupted.
    was_corrupted: bool,
    /// After a corruption nothing is judged until then; none from the first report after that on.
    void_until: Option<Time>,
    excused: Excused,
}

/// One instance, on all robots.
#[derive(Clone, Debug)]
struct Instance {
    is_total: bool,
    /// The last message that each process has sent.
    sent: BTreeMap<Process, u32>,
    /// The last message of each process that each robot delivered.
    handed: BTreeMap<RobotId, BTreeMap<Process, u32>>,
    /// For causal order.
    causality: Option<Causality>,
    /// For total order.
    sequences: Sequences,
}

impl Instance {
    fn new(order: Order) -> Instance {
        Instance {
            is_total: order == Order::Total,
            sent: BTreeMap::new(),
            handed: BTreeMap::new(),
            causality: (order == Order::Causal).then(Causality::default),
            sequences: Sequences::default(),
        }
    }

    /// The robots that delivered messages of an instance start again.
    fn begin_anew(&mut self, robot: RobotId, at: Time) {
        self.handed.remove(&robot);
        self.sequences.end(robot);
        if let Some(causality) = &mut self.causality {
            causality.begin_anew(robot, at);
        }
    }
}

/// An observation at a robot, and its violations.
struct Finding<'a> {
    report: &'a Report<'a, BroadcastEvent>,
    violations: &'a mut Vec<Violation>,
    /// After a corruption nothing counts as a violation.
    excused: Option<&'a mut Excused>,
}

impl Finding<'_> {
    fn add(&mut self, property: &'static str, other: RobotId, text: String) {
        if let Some(excused) = &mut self.excused {
            return excused.note(property, Excuse::Corruption);
        }
        let Report { robot, at, .. } = *self.report;
        let mut robots = vec![robot, other];
        robots.dedup();
        self.violations.push(Violation {
            property: property.into(),
            at,
            robots,
            text: format!("robot {robot} {text}"),
        });
    }
}

impl BroadcastOrder {
    pub fn new(setting: &Setting) -> BroadcastOrder {
        let bound = setting.properties.broadcast_bound;
        BroadcastOrder {
            bound,
            instances: BTreeMap::new(),
            unordered: Taken::default(),
            agreement: Agreement::new(setting.bodies.len(), bound),
            reach: Reach::new(setting),
            was_corrupted: false,
            void_until: None,
            excused: Excused::default(),
        }
    }

    /// All robots start again: what a corruption made up is in what they have delivered so far.
    fn begin_anew(&mut self) {
        for instance in self.instances.values_mut() {
            instance.handed.clear();
            instance.sequences = Sequences::default();
            let is_causal = instance.causality.is_some();
            instance.causality = is_causal.then(Causality::default);
        }
    }

    fn reported(&mut self, report: &Report<'_, BroadcastEvent>, violations: &mut Vec<Violation>) {
        let Report {
            at, robot, port, ..
        } = *report;
        if self.void_until.take_if(|until| at >= *until).is_some() {
            self.begin_anew();
        }
        match report.event {
            BroadcastEvent::Broadcast {
                order: Some(order), ..
            } => {
                let new = || Instance::new(*order);
                self.instances.entry(port).or_insert_with(new);
            }
            BroadcastEvent::Broadcast { message, .. } => {
                return self.unordered.sent(&report.message(robot, *message), None);
            }
            // Before any message there may be members.
            BroadcastEvent::Join { .. } => return self.agreement.joined(port, robot, at),
            BroadcastEvent::Voter => return self.agreement.votes(port, robot),
            BroadcastEvent::Leave { .. } => self.agreement.left(port, robot),
            _ => {}
        }
        let is_judged = self.void_until.is_none();
        let mut finding = Finding {
            report,
            violations,
            excused: (!is_judged).then_some(&mut self.excused),
        };
        let Some(instance) = self.instances.get_mut(&port) else {
            if let BroadcastEvent::Transfer(TransferEvent::Deliver { from, message }) = report.event
            {
                let key = report.message(*from, *message);
                if let Some(what) = self.unordered.take(robot, &key, None) {
                    let text = format!("delivered message {} of robot {from}, {what}", key.number);
                    finding.add(INTEGRITY, *from, text);
                }
            }
            return;
        };
        match report.event {
            BroadcastEvent::Broadcast { message, .. } => {
                let key = report.message(robot, *message);
                instance.sent.insert((robot, key.incarnation), key.number);
                if let Some(causality) = &mut instance.causality {
                    causality.sent(robot, key, at);
                }
                if instance.is_total && is_judged {
                    self.reach.broadcast(key);
                    self.agreement.sent(key, at);
                } else if instance.is_total {
                    self.excused.note(AGREEMENT, Excuse::Corruption);
                }
            }
            BroadcastEvent::Transfer(TransferEvent::Deliver { from, message }) => {
                let key = report.message(*from, *message);
                instance.handed(robot, key, &mut finding);
                if instance.is_total {
                    self.agreement.handed(key, robot);
                    if let Some(having) = self.reach.few_with(&key) {
                        let text = format!(
                            "delivered message {} of robot {}, which only {} can have, no majority of the fleet",
                            key.number,
                            key.from,
                            robot_list(&having)
                        );
                        finding.add(AGREEMENT, key.from, text);
                    }
                }
            }
            BroadcastEvent::PassOver { from, message } => {
                if let Some(causality) = &mut instance.causality {
                    causality.passed(robot, report.message(*from, *message), at, &mut finding);
                }
            }
            BroadcastEvent::Leave {
                reason: LeaveReason::Corrupt,
            } if !self.was_corrupted => {
                let text = "found that what it had delivered differs from the order of others, though no state was \
                            corrupted";
                finding.add(TOTAL, robot, text.into());
            }
            BroadcastEvent::Gap => {
                instance.sequences.gap(robot);
                self.agreement.joined(port, robot, at);
            }
            BroadcastEvent::Transfer(TransferEvent::Fail { message, .. }) => {
                let key = report.message(robot, *message);
                if instance.is_total {
                    self.agreement.failed(key, &mut self.excused);
                }
                if let Some(causality) = &mut instance.causality {
                    causality.failed(key);
                }
            }
            _ => {}
        }
    }
}

impl Instance {
    fn handed(&mut self, robot: RobotId, key: MessageKey, finding: &mut Finding<'_>) {
        let process = (key.from, key.incarnation);
        let number = key.number;
        let name = format!("message {number} of robot {}", key.from);
        let is_sent = self.sent.get(&process).is_some_and(|&last| number <= last);
        if !is_sent {
            let text = format!("delivered {name}, which was not sent");
            return finding.add(INTEGRITY, key.from, text);
        }
        let last = self.handed.entry(robot).or_default();
        match last.insert(process, number) {
            Some(before) if before == number => {
                return finding.add(INTEGRITY, key.from, format!("delivered {name} twice"));
            }
            Some(before) if before > number => {
                let text = format!("delivered {name} after message {before}");
                finding.add(FIFO, key.from, text);
            }
            _ => {}
        }
        if let Some(causality) = &mut self.causality {
            causality.handed(robot, key, finding.report.at, finding);
        }
        if self.is_total {
            self.sequences.handed(robot, key, finding);
        }
    }
}

impl Checker for BroadcastOrder {
    fn properties(&self) -> &'static [&'static str] {
        &[INTEGRITY, FIFO, CAUSAL, TOTAL, AGREEMENT]
    }

    fn has_subject(&self, property: &str) -> bool {
        let mut instances = self.instances.values();
        property == INTEGRITY
            || instances.any(|instance| match property {
                CAUSAL => instance.causality.is_some(),
                TOTAL | AGREEMENT => instance.is_total,
                _ => true,
            })
    }

    fn heeds(&self) -> Kinds {
        // Missed deadlines are found at the next record of any kind.
        match self.agreement.is_owed() {
            false => Kinds::REPORTS | Kinds::SENT | Kinds::DELIVERED,
            true => Kinds::ALL,
        }
    }

    fn is_owed(&self, property: &str) -> bool {
        property == AGREEMENT && self.agreement.is_owed()
    }

    fn excused(&self, property: &str) -> Vec<(Excuse, u64)> {
        self.excused.of(property)
    }

    fn observe(&mut self, record: &Record, violations: &mut Vec<Violation>) {
        // Datagrams that wait for their turn may be on record ahead of their time.
        if let Event::Dropped { .. } = &record.event {
            return;
        }
        self.agreement
            .check(record.at, violations, &mut self.excused);
        match &record.event {
            Event::Sent { .. } | Event::Delivered { .. } => {
                self.agreement.observe(record);
                if let Some(robot) = record.robot {
                    self.reach.observe(robot, &record.event);
                }
            }
            Event::Primitive { .. } => {
                if let Some(report) = Report::of(record) {
                    self.reported(&report, violations);
                }
            }
            Event::Fault(fault) => {
                self.agreement.observe(record);
                match (record.robot, fault) {
                    (Some(robot), Fault::Crash) => {
                        self.unordered.forget(robot);
                        for instance in self.instances.values_mut() {
                            instance.begin_anew(robot, record.at);
                        }
                    }
                    (Some(_), Fault::CorruptState) => {
                        self.was_corrupted = true;
                        self.void_until = Some(record.at + self.bound);
                        self.begin_anew();
                    }
                    _ => {}
                }
            }
            Event::Failed(_) => self.agreement.observe(record),
            _ => {}
        }
    }

    fn advance(&mut self, now: Time, violations: &mut Vec<Violation>) {
        self.agreement.check(now, violations, &mut self.excused);
    }
}
