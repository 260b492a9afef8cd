//! Broadcast: a message to every other robot (thesis, section 3.3.1).
//!
//! Property (d1): over a network that delivers a datagram within `longest_delay` or not at all, every
//! robot that receives the message does so within [`Broadcast::delivery_bound`] of the call, once; and
//! every robot receives it that is up and for which not all copies are lost. Whoever did not
//! acknowledge it is named by [`Broadcast::take_failures`].

use crate::Failure;
use crate::channel::{Channel, report_arrival};
use crate::reliable::{MessageId, Options, encode};
use serde::Serialize;
use starl_core::{Duration, Input, Port, Primitive, Robot};

const KIND: &str = "broadcast";

/// Sends messages to all other robots of the application. What arrives is handed to
/// [`starl_core::Program::receive`] with this primitive's port.
#[derive(Clone, Debug)]
pub struct Broadcast(Channel);

impl Broadcast {
    /// An instance; those of the same name on all robots talk to each other.
    pub fn new(name: &str, options: Options) -> Broadcast {
        Broadcast(Channel::new(KIND, name, options))
    }

    /// Sends `content` to every other robot.
    pub fn broadcast<T: Serialize>(&mut self, robot: &mut Robot<'_>, content: &T) -> MessageId {
        let Channel { port, .. } = self.0;
        // The command is recorded ahead of what it brings about.
        let message = self.0.reliable.next_to_all(robot);
        robot.emit_primitive(
            KIND,
            port,
            "broadcast",
            [
                ("number", message.number.into()),
                ("incarnation", message.incarnation.into()),
                ("retry_span", self.0.retry_span().into()),
            ],
        );
        self.0.send_to_peers(robot, encode(content))
    }

    /// Whether some robot has neither acknowledged the message nor been given up.
    pub fn is_outstanding(&self, message: MessageId) -> bool {
        self.0.reliable.is_outstanding(message)
    }

    /// The messages that some robot did not acknowledge, since the last call; at most the latest 64.
    pub fn take_failures(&mut self) -> alloc::vec::Vec<Failure> {
        self.0.take_failures()
    }

    /// The thesis's d1, for the longest time that the network takes to deliver a datagram.
    pub fn delivery_bound(&self, longest_delay: Duration) -> Duration {
        self.0.reliable.options().delivery_bound(longest_delay)
    }
}

impl Primitive for Broadcast {
    fn port(&self) -> Port {
        self.0.port
    }

    fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) {
        let port = self.0.port;
        self.0.handle(robot, input, |robot, arrival| {
            report_arrival(robot, KIND, port, "deliver", &arrival);
            robot.deliver(arrival.from, port, arrival.content);
        });
    }
}
