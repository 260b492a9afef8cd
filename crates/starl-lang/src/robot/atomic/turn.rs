//! Which action with `atomic` a robot waits for next: they take turns.

/// The atomic actions that a pass over all actions has found.
#[derive(Clone, Copy, Debug, Default)]
pub struct Turn {
    /// Whether another action can be begun.
    pub is_idle: bool,
    /// The action that had its turn last.
    pub last: Option<u32>,
    /// The action that is waited for.
    pub waiting: Option<u32>,
    /// The action that is next.
    pub next: Option<u32>,
}

impl Turn {
    /// Whether it matters if the guard of this atomic action holds.
    pub fn asks(&self, action: u32) -> bool {
        self.is_idle || self.waiting == Some(action)
    }

    /// The guard of an action holds, or does not. Actions take turns.
    pub fn note(&mut self, action: u32, holds: bool) {
        if self.waiting == Some(action) && !holds {
            self.waiting = None;
        }
        if self.is_idle && holds {
            // After the last one comes first; then in the order of the text.
            let rank = |action: u32| (self.last.is_some_and(|last| action <= last), action);
            let is_better = self.next.is_none_or(|next| rank(action) < rank(next));
            self.next = if is_better { Some(action) } else { self.next };
        }
    }
}
