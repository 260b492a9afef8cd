//! Setting the drone's configuration, one entry at a time, each acknowledged in two steps.
//!
//! The drone sets a bit once it has taken an entry, and the client must have that bit cleared before the next. Either
//! datagram may be lost, so each step is repeated until the drone shows that it is done.

use crate::at::AtCommand;
use crate::navdata::state;

/// The settings of the drone, and how many of them it has confirmed.
#[derive(Debug)]
pub(crate) struct Configuration {
    entries: Vec<(&'static str, String)>,
    /// How many are done.
    done: usize,
    /// Whether the drone has taken the entry at `done`, and is to clear its bit.
    taken: bool,
    /// Whether the entry at `done` was sent with the bit cleared, so that the bit means this entry.
    sent: bool,
}

impl Configuration {
    pub fn new(entries: Vec<(&'static str, String)>) -> Configuration {
        Configuration {
            entries,
            done: 0,
            taken: false,
            sent: false,
        }
    }

    pub fn complete(&self) -> bool {
        self.done == self.entries.len()
    }

    /// The drone was switched off and on: everything must be set again.
    pub fn restart(&mut self) {
        *self = Configuration::new(std::mem::take(&mut self.entries));
    }

    /// Takes the bits of the drone's state, and says what to send now.
    pub fn next(&mut self, bits: u32) -> Option<AtCommand> {
        let acknowledged = bits & state::ACKNOWLEDGED != 0;
        if acknowledged {
            self.taken |= self.sent;
            return Some(AtCommand::AcknowledgementSeen);
        }
        if self.taken {
            self.done += 1;
            (self.taken, self.sent) = (false, false);
        }
        let (key, value) = self.entries.get(self.done)?;
        self.sent = true;
        Some(AtCommand::Configure {
            key: (*key).to_string(),
            value: value.clone(),
        })
    }
}
