//! Events of primitives, taken apart.

use starl_core::event::{Event, Fields, Value};
use starl_core::{Port, Record, RobotId, Time};

/// An event of one kind of primitive on a robot.
#[derive(Clone, Copy, Debug)]
pub(super) struct Report<'a> {
    pub at: Time,
    pub robot: RobotId,
    pub port: Port,
    /// What happened.
    pub name: &'a str,
    fields: &'a Fields,
}

/// Names a message sent through a primitive: its sender, the sender's instance and incarnation, and
/// the number that these give it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct MessageKey {
    pub from: RobotId,
    pub port: Port,
    pub incarnation: i64,
    pub number: i64,
}

impl<'a> Report<'a> {
    /// The record as an event of the primitive called `kind`; none if it is anything else.
    pub fn of(record: &'a Record, kind: &str) -> Option<Report<'a>> {
        match &record.event {
            Event::Primitive {
                primitive,
                port,
                name,
                fields,
            } if primitive == kind => Some(Report {
                at: record.at,
                robot: record.robot?,
                port: *port,
                name,
                fields,
            }),
            _ => None,
        }
    }

    /// A detail.
    pub fn get(&self, field: &str) -> Option<&'a Value> {
        let named = self.fields.iter().find(|(name, _)| name == field);
        named.map(|(_, value)| value)
    }

    /// The message it is about, which `from` has sent.
    pub fn message(&self, from: RobotId) -> Option<MessageKey> {
        match (self.get("incarnation"), self.get("number")) {
            (Some(&Value::Int(incarnation)), Some(&Value::Int(number))) => Some(MessageKey {
                from,
                port: self.port,
                incarnation,
                number,
            }),
            _ => None,
        }
    }

    /// The message that it says has reached this robot.
    pub fn arrival(&self) -> Option<MessageKey> {
        match self.get("from") {
            Some(&Value::Robot(from)) => self.message(from),
            _ => None,
        }
    }
}
