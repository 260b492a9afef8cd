//! Messages whose deadline has not passed.
//!
//! Invariant: every message in the map is in the queue. The queue is in the order of deadlines if these are inserted in
//! order, as with equal time limits; a message out of order waits for those before it.

use super::report::MessageKey;
use starl_core::Time;
use std::collections::{BTreeMap, VecDeque};

/// Messages under way, by name and by deadline.
#[derive(Clone, Debug)]
pub(super) struct Outstanding<M> {
    messages: BTreeMap<MessageKey, M>,
    queue: VecDeque<(Time, MessageKey)>,
}

impl<M> Default for Outstanding<M> {
    fn default() -> Outstanding<M> {
        Outstanding {
            messages: BTreeMap::new(),
            queue: VecDeque::new(),
        }
    }
}

impl<M> Outstanding<M> {
    pub fn insert(&mut self, key: MessageKey, deadline: Time, message: M) {
        self.messages.insert(key, message);
        self.queue.push_back((deadline, key));
    }

    pub fn get_mut(&mut self, key: &MessageKey) -> Option<&mut M> {
        self.messages.get_mut(key)
    }

    /// The message that has waited longest.
    pub fn oldest(&self) -> Option<&M> {
        self.messages.get(&self.queue.front()?.1)
    }

    pub fn remove(&mut self, key: &MessageKey) -> Option<M> {
        let removed = self.messages.remove(key);
        self.forget_settled();
        removed
    }

    /// Removes a message whose deadline was before `now`.
    pub fn pop_overdue(&mut self, now: Time) -> Option<(Time, MessageKey, M)> {
        let &(deadline, key) = self.queue.front().filter(|(deadline, _)| *deadline < now)?;
        let message = self.messages.remove(&key);
        self.forget_settled();
        message.map(|message| (deadline, key, message))
    }

    /// Keeps the front of the queue to messages that are still here.
    fn forget_settled(&mut self) {
        while let Some((_, key)) = self.queue.front()
            && !self.messages.contains_key(key)
        {
            self.queue.pop_front();
        }
    }
}
