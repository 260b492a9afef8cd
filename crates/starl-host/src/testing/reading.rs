//! The records of a fleet.

use super::Fleet;
use alloc::collections::BTreeMap;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use starl_core::event::{Value, ValueRef, borrowed};
use starl_core::{Destination, Event, Payload, Port, RobotId, Time};

/// The fields of an event by their names.
pub type Fields = BTreeMap<String, Value>;

/// A datagram that a robot has handed to the network.
#[derive(Clone, Copy, Debug)]
pub struct Sent<'a> {
    /// The sender.
    pub from: RobotId,
    /// The receivers.
    pub destination: Destination,
    /// For which endpoint.
    pub port: Port,
    /// The content.
    pub payload: &'a Payload,
}

impl Fleet {
    /// Events of primitives and programs under this name: their places among the records, and what they say.
    fn named(&self, wanted: &str) -> impl Iterator<Item = (usize, Time, RobotId, Fields)> {
        let records = self.records.iter().enumerate();
        records.filter_map(move |(place, (at, robot, event))| {
            let fields = match event {
                Event::Program { name, fields } if name == wanted => borrowed(fields),
                Event::Primitive { event, .. } if event.name() == wanted => event.fields(),
                _ => return None,
            };
            let named = |(name, value): (&str, ValueRef<'_>)| (name.to_string(), value.into());
            Some((place, *at, *robot, fields.into_iter().map(named).collect()))
        })
    }

    /// Events of primitives and programs under this name: when, where, and their fields.
    pub fn events(&self, wanted: &str) -> Vec<(Time, RobotId, Fields)> {
        let events = self.named(wanted);
        events
            .map(|(_, at, robot, fields)| (at, robot, fields))
            .collect()
    }

    /// [`Fleet::events`] with their places among the records instead of their times.
    pub fn indexed_events(&self, wanted: &str) -> Vec<(usize, RobotId, Fields)> {
        let events = self.named(wanted);
        events
            .map(|(place, _, robot, fields)| (place, robot, fields))
            .collect()
    }

    /// All datagrams that have been sent, in the order of time.
    pub fn sent(&self) -> impl DoubleEndedIterator<Item = Sent<'_>> {
        self.records
            .iter()
            .filter_map(|(_, from, event)| match event {
                Event::Sent {
                    destination,
                    port,
                    payload,
                    ..
                } => Some(Sent {
                    from: *from,
                    destination: *destination,
                    port: *port,
                    payload,
                }),
                _ => None,
            })
    }

    /// Why the program of a robot cannot continue; none if it can, or if the robot is down.
    pub fn failure(&self, robot: usize) -> Option<&str> {
        if !self.robots[robot].node.condition().failed {
            return None;
        }
        let mut records = self.records.iter().rev();
        records.find_map(|(_, id, event)| match event {
            Event::Failed(reason) if id.index() == robot => Some(&**reason),
            _ => None,
        })
    }
}
