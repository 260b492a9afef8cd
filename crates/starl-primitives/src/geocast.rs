//! Geocast: a message to the robots in an area (thesis, section 3.3.1).
//!
//! The message goes to all robots in radio range together with its area; each receiver decides by its own position
//! estimate at the moment of delivery. One that is outside acknowledges and never delivers that message. Properties,
//! with d2 = [`Geocast::delivery_bound`]:
//! - exclusion: a robot whose estimate is outside the area at every moment of `[t0, t0 + d2]` does not
//!   receive the message. This needs no assumption on the network;
//! - inclusion: a robot whose estimate is inside throughout receives it once within that time, if it
//!   is up, the network delivers a datagram within `longest_delay` or not at all, and not all copies
//!   are lost;
//! - a robot that moves in or out meanwhile may or may not receive it, depending on where it is when the first copy
//!   arrives.
//!
//! Estimates may be off by the positioning system's error: an area should be drawn larger or smaller
//! by that, whichever is safe.

use crate::Failure;
use crate::channel::{Carrier, Channel};
use crate::reliable::{MessageId, Options, encode};
use alloc::boxed::Box;
use alloc::vec::Vec;
use serde::Serialize;
use starl_core::event::{GeocastEvent, TransferEvent};
use starl_core::{Area, Duration, Input, Payload, Port, Primitive, Robot, message};

/// Sends messages to the other robots in an area. Received messages are passed to
/// [`starl_core::Program::receive`] with this primitive's port.
#[derive(Clone, Debug)]
pub struct Geocast(Channel);

impl Geocast {
    /// An instance; those of the same name on all robots talk to each other.
    pub fn new(name: &str, options: Options) -> Geocast {
        Geocast(Channel::new(Carrier::Geocast, name, options))
    }

    /// Sends `content` to every other robot in the area. An invalid area contains no robot.
    pub fn geocast<T: Serialize>(
        &mut self,
        robot: &mut Robot<'_>,
        content: &T,
        area: &Area,
    ) -> MessageId {
        let message = self.0.reliable.next_to_all(robot);
        let geocast = GeocastEvent::Geocast {
            message: message.numbered(),
            retry_span: self.0.retry_span(),
            area: Box::new(area.clone()),
        };
        robot.report(self.0.port, geocast);
        self.0
            .send_to_peers(robot, encode(&(area, encode(content))))
    }

    /// Whether some robot has neither acknowledged the message nor been given up.
    pub fn is_outstanding(&self, message: MessageId) -> bool {
        self.0.reliable.is_outstanding(message)
    }

    /// How many messages are outstanding.
    pub fn backlog(&self) -> usize {
        self.0.reliable.backlog()
    }

    /// The messages that a robot did not acknowledge although it has answered this one before, since the
    /// last call; at most the latest 64. Robots that were never in range are not named.
    pub fn take_failures(&mut self) -> Vec<Failure> {
        self.0.take_failures()
    }

    /// The thesis's d2, for the longest time that the network takes to deliver a datagram.
    pub fn delivery_bound(&self, longest_delay: Duration) -> Duration {
        self.0.reliable.options().delivery_bound(longest_delay)
    }
}

impl Primitive for Geocast {
    fn port(&self) -> Port {
        self.0.port
    }

    fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) {
        let port = self.0.port;
        self.0.handle(robot, input, |robot, arrival| {
            let Some((area, content)) = message::decode::<(Area, Payload)>(&arrival.content) else {
                return;
            };
            let inside = area.is_valid() && area.contains(robot.position());
            let (from, message) = arrival.numbered();
            let event = match inside {
                true => TransferEvent::Deliver { from, message }.into(),
                false => GeocastEvent::Outside { from, message },
            };
            robot.report(port, event);
            if inside {
                robot.deliver(arrival.from, port, content);
            }
        });
    }
}
