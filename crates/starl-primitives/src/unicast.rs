//! Unicast: a message to one robot (the thesis's send, section 3.3.1), acknowledged like a broadcast.
//!
//! Property: as of Broadcast, for the one receiver. A message to the robot itself is delivered after a millisecond,
//! without the network.

use crate::Failure;
use crate::channel::{Carrier, Channel};
use crate::reliable::{Alarm, MessageId, Options, encode};
use alloc::vec::Vec;
use serde::Serialize;
use starl_core::event::{TransferEvent, UnicastEvent};
use starl_core::{Duration, Input, Payload, Port, Primitive, Robot, RobotId, TimerKey};

/// After this time a robot has a message to itself. It is above zero, so that a robot that answers itself does not stop
/// time.
const OWN_DELAY: Duration = Duration::from_millis(1);

/// Sends messages to single robots. Received messages are passed to
/// [`starl_core::Program::receive`] with this primitive's port.
#[derive(Clone, Debug)]
pub struct Unicast {
    channel: Channel,
    /// The messages to this robot itself that wait for their delivery.
    own: Vec<(MessageId, Payload)>,
    /// The number of messages to this robot itself.
    own_count: u32,
}

impl Unicast {
    /// An instance; those of the same name on all robots talk to each other.
    pub fn new(name: &str, options: Options) -> Unicast {
        Unicast {
            channel: Channel::new(Carrier::Unicast, name, options),
            own: Vec::new(),
            own_count: 0,
        }
    }

    /// Sends `content` to one robot, which may be this one.
    pub fn send<T: Serialize>(
        &mut self,
        robot: &mut Robot<'_>,
        to: RobotId,
        content: &T,
    ) -> MessageId {
        let is_own = to == robot.id();
        let mut message = self.channel.reliable.next_to(robot, to);
        if is_own {
            self.own_count = self.own_count.saturating_add(1);
            message.number = self.own_count;
        }
        let send = UnicastEvent::Send {
            message: message.numbered(),
            retry_span: self.channel.retry_span(),
            to,
        };
        robot.report(self.channel.port, send);
        if is_own {
            self.own.push((message, encode(content)));
            robot.set_timer(TimerKey::new(self.channel.port, Alarm::Deliver), OWN_DELAY);
            return message;
        }
        self.channel.send(robot, to, encode(content))
    }

    /// Delivers the messages that this robot has sent to itself.
    fn deliver_own(&mut self, robot: &mut Robot<'_>) {
        let port = self.channel.port;
        for (message, content) in core::mem::take(&mut self.own) {
            let (from, to, message) = (robot.id(), message.to, message.numbered());
            for event in [
                TransferEvent::Deliver { from, message },
                TransferEvent::Acknowledged { message, to },
            ] {
                robot.report(port, UnicastEvent::from(event));
            }
            robot.deliver(from, port, content);
        }
    }

    /// Whether the message has neither been acknowledged nor given up.
    pub fn is_outstanding(&self, message: MessageId) -> bool {
        let is_own = self.own.iter().any(|(own, _)| *own == message);
        is_own || self.channel.reliable.is_outstanding(message)
    }

    /// How many messages are outstanding.
    pub fn backlog(&self) -> usize {
        self.own.len() + self.channel.reliable.backlog()
    }

    /// The messages that were not acknowledged, since the last call; at most the latest 64.
    pub fn take_failures(&mut self) -> Vec<Failure> {
        self.channel.take_failures()
    }

    /// Within this time a message arrives or never will, for the longest time that the network takes
    /// to deliver a datagram.
    pub fn delivery_bound(&self, longest_delay: Duration) -> Duration {
        self.channel
            .reliable
            .options()
            .delivery_bound(longest_delay)
    }
}

impl Primitive for Unicast {
    fn port(&self) -> Port {
        self.channel.port
    }

    fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) {
        let port = self.channel.port;
        if matches!(input, Input::Timer(key) if key.port == port && key.read() == Some(Alarm::Deliver))
        {
            return self.deliver_own(robot);
        }
        self.channel.handle(robot, input, |robot, arrival| {
            let (from, message) = arrival.numbered();
            robot.report(
                port,
                UnicastEvent::from(TransferEvent::Deliver { from, message }),
            );
            robot.deliver(arrival.from, port, arrival.content);
        });
    }
}
