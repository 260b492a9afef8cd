//! Events of primitives, with what records say besides.

use starl_core::event::messaging::MessageNumber;
use starl_core::event::{Event, PrimitiveEvent};
use starl_core::{Port, Record, RobotId, Time};

/// An event of one kind of primitive on a robot.
#[derive(Debug)]
pub(super) struct Report<'a, E> {
    pub at: Time,
    pub robot: RobotId,
    pub port: Port,
    /// The event.
    pub event: &'a E,
}

impl<E> Clone for Report<'_, E> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<E> Copy for Report<'_, E> {}

/// Names a message sent through a primitive: its sender, the sender's instance, and which of its messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct MessageKey {
    pub from: RobotId,
    pub port: Port,
    pub incarnation: u32,
    pub number: u32,
}

impl<'a, E> Report<'a, E> {
    /// The record as an event of this kind of primitive; none if it is anything else.
    pub fn of(record: &'a Record) -> Option<Report<'a, E>>
    where
        &'a E: TryFrom<&'a PrimitiveEvent>,
    {
        match &record.event {
            Event::Primitive { port, event } => Some(Report {
                at: record.at,
                robot: record.robot?,
                port: *port,
                event: event.try_into().ok()?,
            }),
            _ => None,
        }
    }

    /// A message of this instance that `from` has sent.
    pub fn message(&self, from: RobotId, message: MessageNumber) -> MessageKey {
        MessageKey {
            from,
            port: self.port,
            incarnation: message.incarnation,
            number: message.number,
        }
    }
}
