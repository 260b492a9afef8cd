//! Which robots can have the messages of a total order, by the datagrams on record.
//!
//! A robot delivers a message once a majority of the fleet has it. A robot can have it from the moment on at which a
//! datagram arrives that its sender, or another robot that can have it, has sent since it could (Lamport 1978). Only a
//! simulator's records are certain to be complete, and in the order of what happened.

use crate::Setting;
use crate::report::MessageKey;
use starl_core::RobotId;
use starl_core::event::Event;
use std::collections::{BTreeMap, VecDeque};

/// As many messages that no majority can have are remembered, the latest.
const MOST_MESSAGES: usize = 1024;

#[derive(Clone, Debug)]
pub(super) struct Reach {
    robots: usize,
    /// Whether the records are a simulator's.
    is_simulated: bool,
    /// Whether datagrams are on record: in an exploration they are not.
    has_datagrams: bool,
    /// The number of the last datagram of each robot.
    sent: BTreeMap<RobotId, u32>,
    /// The messages that no majority can have yet, by the robots that can, with the number of the last datagram that
    /// each had sent before it could.
    few: BTreeMap<MessageKey, BTreeMap<RobotId, Option<u32>>>,
    /// Their order.
    order: VecDeque<MessageKey>,
}

impl Reach {
    pub fn new(setting: &Setting) -> Reach {
        Reach {
            robots: setting.bodies.len(),
            is_simulated: setting.simulated,
            has_datagrams: false,
            sent: BTreeMap::new(),
            few: BTreeMap::new(),
            order: VecDeque::new(),
        }
    }

    /// A message is broadcast.
    pub fn broadcast(&mut self, key: MessageKey) {
        if !self.has_datagrams || self.robots < 2 {
            return;
        }
        let sender = (key.from, self.sent.get(&key.from).copied());
        self.few.insert(key, BTreeMap::from([sender]));
        self.order.push_back(key);
        if self.order.len() > MOST_MESSAGES
            && let Some(oldest) = self.order.pop_front()
        {
            self.few.remove(&oldest);
        }
    }

    /// Records a datagram that a robot has sent or received.
    pub fn observe(&mut self, robot: RobotId, event: &Event) {
        match *event {
            _ if !self.is_simulated => {}
            Event::Sent { sequence, .. } => {
                self.sent.insert(robot, sequence);
            }
            Event::Delivered { from, sequence } => {
                self.has_datagrams = true;
                self.arrived(from, sequence, robot);
            }
            _ => {}
        }
    }

    fn arrived(&mut self, from: RobotId, sequence: u32, to: RobotId) {
        if self.few.is_empty() {
            return;
        }
        let (majority, last) = (self.robots / 2 + 1, self.sent.get(&to).copied());
        self.few.retain(|_, having| {
            let since = having.get(&from);
            if since.is_some_and(|before| before.is_none_or(|before| before < sequence)) {
                having.entry(to).or_insert(last);
            }
            having.len() < majority
        });
        if self.few.len() < self.order.len() {
            self.order.retain(|key| self.few.contains_key(key));
        }
    }

    /// The robots that can have a message, if they are no majority.
    pub fn few_with(&self, key: &MessageKey) -> Option<Vec<RobotId>> {
        let having = self.few.get(key)?;
        Some(having.keys().copied().collect())
    }
}
