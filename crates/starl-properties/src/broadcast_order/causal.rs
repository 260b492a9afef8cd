//! Causal order: what happened before a message was sent (Lamport 1978) is handed out before it.
//!
//! As each sender's messages are handed out in its order, what comes before a message is told by one number
//! for each sender.

use super::{CAUSAL, Finding, Process};
use crate::report::MessageKey;
use starl_core::{Duration, RobotId, Time};
use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;

/// Messages are forgotten after this time: whoever is handed one then is not judged for it.
const MEMORY: Duration = Duration::from_seconds(300);

/// The last message of each process that comes before something.
type Past = BTreeMap<Process, u32>;

#[derive(Clone, Debug, Default)]
pub(super) struct Causality {
    /// What came before each message.
    before: BTreeMap<MessageKey, Arc<Past>>,
    sent: VecDeque<(Time, MessageKey)>,
    /// What has happened before now at each robot: sent, handed out, and before that.
    known: BTreeMap<RobotId, Past>,
    /// What each robot was handed or passed over.
    settled: BTreeMap<RobotId, Past>,
}

impl Causality {
    pub fn begin_anew(&mut self, robot: RobotId) {
        self.known.remove(&robot);
        self.settled.remove(&robot);
    }

    pub fn sent(&mut self, robot: RobotId, key: MessageKey, at: Time) {
        while let Some(&(time, oldest)) = self.sent.front()
            && time + MEMORY < at
        {
            self.before.remove(&oldest);
            self.sent.pop_front();
        }
        let known = self.known.entry(robot).or_default();
        self.before.insert(key, Arc::new(known.clone()));
        self.sent.push_back((at, key));
        known.insert((robot, key.incarnation), key.number);
    }

    pub fn passed(&mut self, robot: RobotId, key: MessageKey) {
        let settled = self.settled.entry(robot).or_default();
        raise(settled, (key.from, key.incarnation), key.number);
    }

    pub fn handed(&mut self, robot: RobotId, key: MessageKey, finding: &mut Finding<'_>) {
        let process = (key.from, key.incarnation);
        let settled = self.settled.entry(robot).or_default();
        let number = key.number;
        if settled.get(&process).is_some_and(|&last| last >= number) {
            let text = format!(
                "was handed message {number} of robot {}, which it had passed over",
                key.from
            );
            finding.add(CAUSAL, key.from, text);
        }
        let Some(before) = self.before.get(&key) else {
            return;
        };
        // Its own messages are not handed to a robot.
        let mut others = before.iter().filter(|(process, _)| process.0 != robot);
        let is_missing = |(process, number): &(&Process, &u32)| {
            settled.get(process).is_none_or(|last| last < *number)
        };
        if let Some(((sender, _), missing)) = others.find(is_missing) {
            let text = format!(
                "was handed message {number} of robot {} before message {missing} of robot {sender}, \
                 which comes before it",
                key.from
            );
            finding.add(CAUSAL, key.from, text);
        }
        raise(settled, process, number);
        let known = self.known.entry(robot).or_default();
        for (&process, &number) in &**before {
            raise(known, process, number);
        }
        raise(known, process, number);
    }
}

fn raise(past: &mut Past, process: Process, number: u32) {
    let last = past.entry(process).or_insert(number);
    *last = (*last).max(number);
}
