//! Unicast: a message to one robot (the thesis's send, section 3.3.1), acknowledged like a broadcast.
//!
//! Property: as of Broadcast, for the one receiver.

use crate::Failure;
use crate::channel::{Carrier, Channel};
use crate::reliable::{MessageId, Options, encode};
use serde::Serialize;
use starl_core::event::{TransferEvent, UnicastEvent};
use starl_core::{Duration, Input, Port, Primitive, Robot, RobotId};

/// Sends messages to single robots. Received messages are passed to
/// [`starl_core::Program::receive`] with this primitive's port.
#[derive(Clone, Debug)]
pub struct Unicast(Channel);

impl Unicast {
    /// An instance; those of the same name on all robots talk to each other.
    pub fn new(name: &str, options: Options) -> Unicast {
        Unicast(Channel::new(Carrier::Unicast, name, options))
    }

    /// Sends `content` to one robot. A message to itself fails after the retries like one to a robot
    /// that is not there.
    pub fn send<T: Serialize>(
        &mut self,
        robot: &mut Robot<'_>,
        to: RobotId,
        content: &T,
    ) -> MessageId {
        let message = self.0.reliable.next_to(robot, to);
        let send = UnicastEvent::Send {
            message: message.numbered(),
            retry_span: self.0.retry_span(),
            to,
        };
        robot.report(self.0.port, send);
        self.0.send(robot, to, encode(content))
    }

    /// Whether the message has neither been acknowledged nor given up.
    pub fn is_outstanding(&self, message: MessageId) -> bool {
        self.0.reliable.is_outstanding(message)
    }

    /// How many messages are outstanding.
    pub fn backlog(&self) -> usize {
        self.0.reliable.backlog()
    }

    /// The messages that were not acknowledged, since the last call; at most the latest 64.
    pub fn take_failures(&mut self) -> alloc::vec::Vec<Failure> {
        self.0.take_failures()
    }

    /// Within this time a message arrives or never will, for the longest time that the network takes
    /// to deliver a datagram.
    pub fn delivery_bound(&self, longest_delay: Duration) -> Duration {
        self.0.reliable.options().delivery_bound(longest_delay)
    }
}

impl Primitive for Unicast {
    fn port(&self) -> Port {
        self.0.port
    }

    fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) {
        let port = self.0.port;
        self.0.handle(robot, input, |robot, arrival| {
            let (from, message) = arrival.numbered();
            robot.report(
                port,
                UnicastEvent::from(TransferEvent::Deliver { from, message }),
            );
            robot.deliver(arrival.from, port, arrival.content);
        });
    }
}
