//! The creation of a write.

use super::stamp::HybridClock;
use super::store::{self, Address, Element};
use super::{Alarm, LONGEST_NAME, SharedMemory, Stamp, WriteError, report};
use starl_core::event::SharedMemoryEvent;
use starl_core::event::storing::Written;
use starl_core::{Duration, Payload, Robot, RobotId};

impl SharedMemory {
    /// Writes an element here and now, and to all at the end of this activation.
    pub(super) fn set(
        &mut self,
        robot: &mut Robot<'_>,
        variable: &str,
        owner: Option<RobotId>,
        value: Payload,
    ) -> Result<Stamp, WriteError> {
        let key = store::key(variable, owner);
        let present = self.store.at(key);
        let is_other = |element: &Element| {
            *element.address.variable != *variable || element.address.owner != owner
        };
        let refusal = if variable.len() > LONGEST_NAME {
            Some(WriteError::NameTooLong)
        } else if value.len() > self.options.longest_value {
            Some(WriteError::ValueTooLong)
        } else if present.is_none() && self.store.len() >= self.options.most_elements {
            Some(WriteError::Full)
        } else if present.is_some_and(is_other) {
            Some(WriteError::NameTaken)
        } else {
            None
        };
        if let Some(error) = refusal {
            return Err(error);
        }
        let address = present.map_or_else(
            || self.store.address(variable, owner),
            |element| element.address.clone(),
        );
        let event = |written| SharedMemoryEvent::Write { written };
        Ok(self.put(robot, key, address, value, event))
    }

    /// Makes a value the latest at its address.
    pub(super) fn put(
        &mut self,
        robot: &mut Robot<'_>,
        key: u64,
        address: Address,
        value: Payload,
        event: fn(Written) -> SharedMemoryEvent,
    ) -> Stamp {
        let now = robot.now();
        if let Some(present) = self.store.at(key) {
            // Only after a corruption can the clock be behind it.
            self.clock.observe(present.stamp.clock());
        }
        let HybridClock { time, count } = self.clock.tick(now);
        let stamp = Stamp {
            time,
            count,
            writer: robot.id(),
            incarnation: self.incarnation.of(robot),
        };
        let is_causal = self.causal.contains(&*address.variable);
        let element = Element {
            key,
            depends: is_causal.then(|| self.store.dependencies(key)),
            address,
            stamp,
            value,
            mine: true,
            touched: now,
        };
        robot.report(self.port, event(report::written(&element)));
        self.note_change(robot);
        self.store.put(element);
        self.unsent.insert(key);
        robot.set_timer(self.timer(Alarm::Flush), Duration::ZERO);
        stamp
    }
}
