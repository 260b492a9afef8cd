//! Causal order: messages that happened before a message (Lamport 1978) are delivered before it.
//!
//! Each sender's messages are delivered in its order, so the predecessors of a message are one number for each sender.
//! Messages of a robot's earlier life are not required at robots that delivered, or passed over, a message of a later
//! one.

use super::{CAUSAL, Finding, Process};
use crate::report::MessageKey;
use starl_core::{Duration, RobotId, Time};
use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;

/// A receiver waits for a missing message for at least 2 s if its sender does not answer. It looks four times a second, by
/// a clock that may drift.
const PATIENCE: Duration = Duration::from_millis(1500);

/// Messages are forgotten after this time: later deliveries of them are not judged.
const MEMORY: Duration = Duration::from_seconds(300);

/// The last message of each process that comes before something.
type Past = BTreeMap<Process, u32>;

#[derive(Clone, Debug, Default)]
pub(super) struct Causality {
    /// The predecessors of each message, and when it was sent.
    before: BTreeMap<MessageKey, (Arc<Past>, Time)>,
    sent: VecDeque<(Time, MessageKey)>,
    /// The past of each robot: messages that it sent and delivered, and their predecessors.
    known: BTreeMap<RobotId, Past>,
    /// The messages that each robot delivered or passed over.
    settled: BTreeMap<RobotId, Past>,
    /// The lives of all robots in the order in which they first sent.
    lives: BTreeMap<Process, u64>,
    /// By receiver and sender, the latest life of which something was delivered or passed over.
    latest: BTreeMap<(RobotId, RobotId), u64>,
    /// When each robot, since it last crashed, first delivered a message of each process.
    heard: BTreeMap<RobotId, BTreeMap<Process, Time>>,
    /// The last crash of each robot.
    crashed: BTreeMap<RobotId, Time>,
    /// The last message of each process that its sender gave up.
    failed: Past,
}

impl Causality {
    pub fn begin_anew(&mut self, robot: RobotId, at: Time) {
        self.crashed.insert(robot, at);
        self.heard.remove(&robot);
        self.known.remove(&robot);
        self.settled.remove(&robot);
        self.latest.retain(|(receiver, _), _| *receiver != robot);
    }

    pub fn sent(&mut self, robot: RobotId, key: MessageKey, at: Time) {
        while let Some(&(time, oldest)) = self.sent.front()
            && time + MEMORY < at
        {
            self.before.remove(&oldest);
            self.sent.pop_front();
        }
        let lives = self.lives.len() as u64;
        self.lives.entry((robot, key.incarnation)).or_insert(lives);
        let known = self.known.entry(robot).or_default();
        self.before.insert(key, (Arc::new(known.clone()), at));
        self.sent.push_back((at, key));
        known.insert((robot, key.incarnation), key.number);
    }

    /// Records the incarnation of a message that a robot delivered or skipped.
    fn settle(&mut self, robot: RobotId, process: Process) {
        let life = self.lives.get(&process).copied().unwrap_or(0);
        let latest = self.latest.entry((robot, process.0)).or_insert(life);
        *latest = life.max(*latest);
    }

    /// Whether a robot has come to a later life of the sender.
    fn is_over(&self, robot: RobotId, process: Process) -> bool {
        let latest = self.latest.get(&(robot, process.0));
        latest.is_some_and(|latest| self.lives.get(&process).is_some_and(|life| life < latest))
    }

    /// A sender gives a message up.
    pub fn failed(&mut self, key: MessageKey) {
        raise(&mut self.failed, (key.from, key.incarnation), key.number);
    }

    pub fn passed(&mut self, robot: RobotId, key: MessageKey, at: Time, finding: &mut Finding<'_>) {
        if self.is_owed(robot, key, at) {
            let text = format!(
                "passed over message {} of robot {} within {PATIENCE} of its broadcast",
                key.number, key.from
            );
            finding.add(CAUSAL, key.from, text);
        }
        self.settle(robot, (key.from, key.incarnation));
        let settled = self.settled.entry(robot).or_default();
        raise(settled, (key.from, key.incarnation), key.number);
    }

    /// Whether a robot must still wait for a message: it knew the sender's life, which has neither ended nor given the
    /// message up.
    fn is_owed(&self, robot: RobotId, key: MessageKey, at: Time) -> bool {
        let process = (key.from, key.incarnation);
        let Some(&(_, sent)) = self.before.get(&key) else {
            return false;
        };
        let heard = self.heard.get(&robot).and_then(|heard| heard.get(&process));
        let has_crashed = self.crashed.get(&key.from).is_some_and(|&at| at >= sent);
        let is_failed = self.failed.get(&process) >= Some(&key.number);
        at < sent + PATIENCE && heard.is_some_and(|&at| at < sent) && !has_crashed && !is_failed
    }

    pub fn handed(&mut self, robot: RobotId, key: MessageKey, at: Time, finding: &mut Finding<'_>) {
        let process = (key.from, key.incarnation);
        let number = key.number;
        if self.is_over(robot, process) {
            let text = format!(
                "delivered message {number} of an earlier life of robot {} after one of a later life",
                key.from
            );
            finding.add(CAUSAL, key.from, text);
        }
        self.settle(robot, process);
        let heard = self.heard.entry(robot).or_default();
        heard.entry(process).or_insert(at);
        let settled = self.settled.entry(robot).or_default();
        if settled.get(&process).is_some_and(|&last| last >= number) {
            let text = format!(
                "delivered message {number} of robot {}, which it had passed over",
                key.from
            );
            finding.add(CAUSAL, key.from, text);
        }
        let Some((before, _)) = self.before.get(&key) else {
            return;
        };
        // Its own messages are not handed to a robot.
        let before = Arc::clone(before);
        let settled = self.settled.get(&robot);
        let mut others = before.iter().filter(|(process, _)| process.0 != robot);
        let is_missing = |(process, number): &(&Process, &u32)| {
            let last = settled.and_then(|settled| settled.get(process));
            last.is_none_or(|last| last < *number) && !self.is_over(robot, **process)
        };
        if let Some(((sender, _), missing)) = others.find(is_missing) {
            let text = format!(
                "delivered message {number} of robot {} before message {missing} of robot {sender}, \
                 which comes before it",
                key.from
            );
            finding.add(CAUSAL, key.from, text);
        }
        raise(self.settled.entry(robot).or_default(), process, number);
        let known = self.known.entry(robot).or_default();
        for (&process, &number) in &*before {
            raise(known, process, number);
        }
        raise(known, process, number);
    }
}

fn raise(past: &mut Past, process: Process, number: u32) {
    let last = past.entry(process).or_insert(number);
    *last = (*last).max(number);
}
