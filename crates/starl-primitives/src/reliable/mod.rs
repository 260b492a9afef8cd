//! The communication protocol under Broadcast, Geocast, Unicast and the distributed algorithms. Over
//! a network that loses, delays, duplicates and reorders datagrams it delivers each message to each
//! receiver at most once, and either delivers it or reports the failure (thesis, section 3.3.1: "a
//! simple protocol that asks for acknowledgment for each message being sent").
//!
//! A message to all is sent once to all. Each receiver acknowledges the messages that it has, and is sent the missing
//! ones, several in a datagram, until it has all or their time is over (`sending`). Invariants:
//! - a receiver delivers a message at most once in each of its lives, however often it is repeated and however late its
//!   copies are;
//! - messages of a sender's later life are delivered after those of its earlier lives, for any number of lives: a
//!   handshake distinguishes them, without memory of earlier ones (`inbox`);
//! - every message is settled within [`Options::failure_bound`]: no robot waits for ever for a crashed robot;
//! - memory is bounded by the settings and the size of the fleet, and a silent peer costs none.
//!
//! Guarantees are per incarnation: a restarted receiver may deliver a message again that it had delivered before the
//! crash, if its sender had no acknowledgement; and the first message of a life to a robot that has not heard of that
//! life arrives only if its sender stays up for two more network delays. With [`Options::first_in_first_out`] the
//! messages to all, and those to one robot, are each delivered in order, but not relative to each other.

mod inbox;
mod line;
mod notice;
mod options;
mod outgoing;
mod packet;
mod peers;
mod receiving;
mod runs;
mod sending;
mod sorted;

pub use notice::{Arrival, MessageId, Notice, Notices};
pub use options::Options;

use crate::incarnation::Incarnation;
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use inbox::Inbox;
use line::Line;
use outgoing::Outgoing;
use packet::{Packet, Stream};
use peers::Peers;
use receiving::Progress;
use starl_core::{Input, Payload, Port, Robot, RobotId, Time, message, timers};

timers! {
    /// The timers of a port that carries the protocol.
    pub(crate) enum Alarm {
        /// Receivers may have to be tried again.
        Resend,
        /// Acknowledgements must be sent.
        Answer,
        /// The held messages of an ordered broadcast above the protocol must be checked.
        Look,
        /// Messages that a robot has sent to itself must be delivered.
        Deliver,
    }
}

/// One end of the protocol, the same on every robot that carries `port`.
#[derive(Clone, Debug)]
pub struct Reliable {
    port: Port,
    options: Options,
    /// Whether robots that have never answered may be out of reach, and are not failures.
    is_local: bool,
    incarnation: Incarnation,
    /// The messages of this robot to all.
    multicast: Outgoing,
    /// The messages of this robot to each robot.
    direct: BTreeMap<RobotId, Outgoing>,
    /// The senders, by [`Stream`].
    inboxes: [Peers<Inbox>; 2],
    /// When senders were last answered, where a next answer would still have to wait for that; in their order.
    answered: Vec<((RobotId, Stream), Time)>,
    /// When receivers are tried again.
    resend_at: Option<Time>,
    /// When senders are answered.
    answer_at: Option<Time>,
}

impl Reliable {
    /// An end at the owner's port: the owner hands its messages and timers to [`Reliable::handle`].
    pub fn new(port: Port, options: Options) -> Reliable {
        Reliable {
            port,
            options,
            is_local: false,
            incarnation: Incarnation::default(),
            multicast: Outgoing::default(),
            direct: BTreeMap::new(),
            inboxes: Default::default(),
            answered: Vec::new(),
            resend_at: None,
            answer_at: None,
        }
    }

    /// An endpoint whose messages to all are for robots in range: robots that have never answered are not failures.
    pub fn local(port: Port, options: Options) -> Reliable {
        Reliable {
            is_local: true,
            ..Reliable::new(port, options)
        }
    }

    /// The settings.
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// Whether some receiver of the message is still being tried.
    pub fn is_outstanding(&self, message: MessageId) -> bool {
        let outgoing = match message.to {
            None => Some(&self.multicast),
            Some(to) => self.direct.get(&to),
        };
        Some(message.incarnation) == self.incarnation.known()
            && outgoing.is_some_and(|outgoing| outgoing.is_outstanding(message.number))
    }

    /// The number of messages that some receiver has not taken and is still tried with.
    pub fn backlog(&self) -> usize {
        let direct = self.direct.values().map(Outgoing::outstanding);
        self.multicast.outstanding() + direct.sum::<usize>()
    }

    /// The name of the next message to all.
    pub fn next_to_all(&mut self, robot: &mut Robot<'_>) -> MessageId {
        MessageId {
            incarnation: self.incarnation.of(robot),
            to: None,
            number: self.multicast.next(),
        }
    }

    /// The name of the next message to one robot.
    pub fn next_to(&mut self, robot: &mut Robot<'_>, to: RobotId) -> MessageId {
        MessageId {
            incarnation: self.incarnation.of(robot),
            to: Some(to),
            number: self.direct.get(&to).map_or(1, Outgoing::next),
        }
    }

    /// Sends to one robot.
    pub fn send(
        &mut self,
        robot: &mut Robot<'_>,
        to: RobotId,
        content: Payload,
    ) -> (MessageId, Notices) {
        self.dispatch(robot, Some(to), content)
    }

    /// Sends to all other robots of the fleet.
    pub fn send_to_all(&mut self, robot: &mut Robot<'_>, content: Payload) -> (MessageId, Notices) {
        self.dispatch(robot, None, content)
    }

    /// Takes an input of the robot: messages to the owner's port and its own timers; others are ignored.
    #[must_use]
    pub fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) -> Notices {
        match input {
            Input::Message(message) if message.port == self.port && robot.is_peer(message.from) => {
                let Some(packet) = message.read() else {
                    return Notices::new();
                };
                self.heard_of(robot, message.from);
                self.receive(robot, message.from, packet)
            }
            Input::Timer(key) if key.port == self.port => match key.read() {
                Some(Alarm::Resend) => self.resend_due(robot),
                Some(Alarm::Answer) => {
                    self.answer_due(robot);
                    Notices::new()
                }
                _ => Notices::new(),
            },
            _ => Notices::new(),
        }
    }

    fn receive(
        &mut self,
        robot: &mut Robot<'_>,
        from: RobotId,
        packet: Packet<Payload>,
    ) -> Notices {
        match packet {
            Packet::Data {
                incarnation,
                stream,
                token,
                base,
                next,
                messages,
                known,
            } => {
                let progress = Progress {
                    incarnation,
                    stream,
                    token,
                    base,
                    next,
                    is_known: known.contains(&robot.id()),
                };
                self.take(robot, from, &progress, messages)
            }
            Packet::Greet { stream, token } => self.greeted(robot, from, stream, token),
            Packet::Taken {
                incarnation,
                stream,
                before,
                ahead,
            } if Some(incarnation) == self.incarnation.known() => {
                self.taken(robot, from, stream, (before, ahead))
            }
            Packet::Taken { .. } => Notices::new(),
        }
    }

    fn line(&self, incarnation: u32, to: Option<RobotId>) -> Line {
        Line {
            port: self.port,
            options: self.options,
            is_local: self.is_local,
            incarnation,
            to,
        }
    }

    fn outgoing(&mut self, to: Option<RobotId>) -> Option<&mut Outgoing> {
        match to {
            None => Some(&mut self.multicast),
            Some(to) => self.direct.get_mut(&to),
        }
    }

    /// The same, begun where there is none.
    fn outgoing_mut(&mut self, to: Option<RobotId>) -> &mut Outgoing {
        match to {
            None => &mut self.multicast,
            Some(to) => self.direct.entry(to).or_default(),
        }
    }
}

/// Encodes the content of a message.
pub fn encode<T: serde::Serialize>(content: &T) -> Payload {
    message::encode(content)
}
