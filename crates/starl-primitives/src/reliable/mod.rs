//! The communication protocol under Broadcast, Geocast, Unicast and the distributed algorithms: over
//! a network that loses, delays, duplicates and reorders datagrams it hands each message to each
//! receiver at most once, and either gets it through or reports the failure (thesis, section 3.3.1:
//! "a simple protocol that asks for acknowledgment for each message being sent").
//!
//! A message to all goes out once to all and is then repeated to each robot that has not acknowledged
//! it, with exponential back-off and jitter, a bounded number of times. Invariants:
//! - a receiver hands out a message at most once for as long as it runs, however often it is repeated;
//! - a sender that restarts draws a new incarnation number, so its first messages are not mistaken for
//!   duplicates of those it sent before the crash;
//! - every message is settled within [`Options::failure_bound`]: nobody waits for ever on a dead robot;
//! - memory is bounded by the settings and the size of the fleet, and a peer that never speaks costs
//!   nothing.
//!
//! Guarantees are per incarnation: a receiver that restarts may be handed a message that it had taken
//! before the crash, if its sender did not hear of it. With [`Options::first_in_first_out`] the
//! messages to all, and those to one robot, are each taken in order; not the ones relative to the
//! others. A message counts as acknowledged once it is handed out, so one that is held back for an
//! earlier message is repeated meanwhile.

mod inbox;
mod notice;
mod options;
mod outbox;
mod packet;
mod sending;

pub use notice::{Arrival, MessageId, Notice, Notices};
pub use options::Options;

use crate::incarnation::Incarnation;
use alloc::boxed::Box;
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use inbox::{Inbox, Taken};
use outbox::Outbox;
use packet::{Key, Packet, Stream};
use starl_core::{Destination, Input, Payload, Port, Robot, RobotId, TimerKey, message, timers};

timers! {
    /// The timers of a port that carries the protocol.
    pub(crate) enum Alarm {
        /// A message may have to be sent again, by its ticket.
        Resend(u32),
        /// What an ordered broadcast above the protocol holds back is to be looked at.
        Look,
    }
}

/// One end of the protocol, the same on every robot that carries `port`.
#[derive(Clone, Debug)]
pub struct Reliable {
    port: Port,
    options: Options,
    incarnation: Incarnation,
    /// The number of the last message to all.
    last_multicast: u32,
    /// The number of the last message to each robot.
    last_direct: BTreeMap<RobotId, u32>,
    outbox: Outbox,
    /// Boxed, since a node of the map has room for eleven, and most robots hear few.
    inboxes: BTreeMap<RobotId, Box<Inbox>>,
}

impl Reliable {
    /// An end at the owner's port: the owner hands its messages and timers to [`Reliable::handle`].
    pub fn new(port: Port, options: Options) -> Reliable {
        Reliable {
            port,
            options,
            incarnation: Incarnation::default(),
            last_multicast: 0,
            last_direct: BTreeMap::new(),
            outbox: Outbox::default(),
            inboxes: BTreeMap::new(),
        }
    }

    /// The settings.
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// Whether some receiver of the message is still being tried.
    pub fn is_outstanding(&self, message: MessageId) -> bool {
        Some(message.incarnation) == self.incarnation.known() && self.outbox.contains(message)
    }

    /// The number of messages still on their way.
    pub fn outstanding(&self) -> usize {
        self.outbox.len()
    }

    /// The name of the next message to all.
    pub fn next_to_all(&mut self, robot: &mut Robot<'_>) -> MessageId {
        let number = self.last_multicast.wrapping_add(1);
        MessageId {
            incarnation: self.incarnation.of(robot),
            to: None,
            number,
        }
    }

    /// The name of the next message to one robot.
    pub fn next_to(&mut self, robot: &mut Robot<'_>, to: RobotId) -> MessageId {
        let number = self
            .last_direct
            .get(&to)
            .map_or(1, |last| last.wrapping_add(1));
        MessageId {
            incarnation: self.incarnation.of(robot),
            to: Some(to),
            number,
        }
    }

    /// Sends to one robot.
    pub fn send(
        &mut self,
        robot: &mut Robot<'_>,
        to: RobotId,
        content: Payload,
    ) -> (MessageId, Notices) {
        let message = self.next_to(robot, to);
        self.last_direct.insert(to, message.number);
        self.dispatch(robot, message, alloc::vec![to], content)
    }

    /// Sends to all robots that the network reaches, and repeats to those of the audience until each
    /// has acknowledged. Robots outside the audience that hear it take it too.
    pub fn send_to_all(
        &mut self,
        robot: &mut Robot<'_>,
        audience: impl IntoIterator<Item = RobotId>,
        content: Payload,
    ) -> (MessageId, Notices) {
        let message = self.next_to_all(robot);
        self.last_multicast = message.number;
        let me = robot.id();
        let mut pending: Vec<RobotId> = audience.into_iter().filter(|&peer| peer != me).collect();
        pending.sort_unstable();
        pending.dedup();
        self.dispatch(robot, message, pending, content)
    }

    /// Takes an input of the robot: messages to the owner's port and its own timers; others are ignored.
    #[must_use]
    pub fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) -> Notices {
        match input {
            Input::Message(message) if message.port == self.port => {
                match message.read::<Packet<Payload>>() {
                    Some(Packet::Data {
                        key,
                        oldest_back,
                        content,
                    }) => self.take(robot, message.from, key, oldest_back, content),
                    Some(Packet::Acknowledge(key)) => self.acknowledged(robot, message.from, key),
                    Some(Packet::Ask { ticket }) => self.answer(robot, message.from, ticket),
                    Some(Packet::Oldest {
                        incarnation,
                        number,
                        next,
                        ticket,
                    }) => {
                        let notice = Notice::Settled {
                            from: message.from,
                            incarnation,
                            before: number,
                            next,
                            ticket,
                        };
                        self.settled(robot, notice)
                    }
                    None => Notices::new(),
                }
            }
            Input::Timer(key) if key.port == self.port => match key.read() {
                Some(Alarm::Resend(ticket)) => self.timed_out(robot, ticket),
                _ => Notices::new(),
            },
            _ => Notices::new(),
        }
    }

    fn take(
        &mut self,
        robot: &mut Robot<'_>,
        from: RobotId,
        key: Key,
        oldest_back: u32,
        content: Payload,
    ) -> Notices {
        let Key {
            incarnation,
            stream,
            number,
        } = key;
        let oldest = match number.checked_sub(oldest_back) {
            Some(oldest) if oldest > 0 && is_peer(robot, from) => oldest,
            _ => return Notices::new(), // no message of ours looks like this
        };
        let inbox = self.inboxes.entry(from).or_default();
        let sequence = inbox.sequence(incarnation, stream);
        let most_gaps = self.options.most_gaps;
        let taken = if self.options.first_in_first_out {
            sequence.take_in_order(number, oldest, content, most_gaps)
        } else {
            sequence.take(number, oldest, content, most_gaps)
        };
        let again = taken.again.then_some(number);
        self.hand_out(robot, from, key, taken, again)
    }

    /// Acknowledges what was taken, and what was taken before and came again.
    fn hand_out(
        &self,
        robot: &mut Robot<'_>,
        from: RobotId,
        key: Key,
        taken: Taken,
        again: Option<u32>,
    ) -> Notices {
        let numbers = taken.arrived.iter().map(|&(number, _)| number);
        for number in numbers.chain(again) {
            let acknowledgement = Packet::<Payload>::Acknowledge(Key { number, ..key });
            robot.transmit(Destination::Robot(from), self.port, &acknowledgement);
        }
        let arrivals = taken.arrived.into_iter().map(|(number, content)| {
            Notice::Arrived(Arrival {
                from,
                incarnation: key.incarnation,
                to_all: key.stream == Stream::Multicast,
                number,
                content,
            })
        });
        arrivals.collect()
    }

    /// Asks a robot which of its messages to all may still come; the answer is a
    /// [`Notice::Settled`] with this ticket, if it comes.
    pub fn ask(&self, robot: &mut Robot<'_>, peer: RobotId, ticket: u32) {
        let question = Packet::<Payload>::Ask { ticket };
        robot.transmit(Destination::Robot(peer), self.port, &question);
    }

    fn answer(&mut self, robot: &mut Robot<'_>, to: RobotId, ticket: u32) -> Notices {
        let next = self.last_multicast.wrapping_add(1);
        let answer = Packet::<Payload>::Oldest {
            incarnation: self.incarnation.of(robot),
            number: self.outbox.oldest_outstanding(to).unwrap_or(next),
            next,
            ticket,
        };
        robot.transmit(Destination::Robot(to), self.port, &answer);
        Notices::new()
    }

    /// Releases what was held for messages that will not come.
    fn settled(&mut self, robot: &mut Robot<'_>, notice: Notice) -> Notices {
        let Notice::Settled {
            from,
            incarnation,
            before,
            ..
        } = notice
        else {
            return Notices::new();
        };
        if !is_peer(robot, from) {
            return Notices::new();
        }
        let inbox = self.inboxes.entry(from).or_default();
        let taken = inbox
            .sequence(incarnation, Stream::Multicast)
            .settle(before);
        let key = Key {
            incarnation,
            stream: Stream::Multicast,
            number: before,
        };
        let mut notices = self.hand_out(robot, from, key, taken, None);
        notices.push(notice);
        notices
    }

    fn timer(&self, ticket: u32) -> TimerKey {
        TimerKey::new(self.port, Alarm::Resend(ticket))
    }
}

/// Whether this is another robot of the application.
fn is_peer(robot: &Robot<'_>, id: RobotId) -> bool {
    id != robot.id() && robot.fleet().binary_search(&id).is_ok()
}

/// Encodes the content of a message.
pub fn encode<T: serde::Serialize>(content: &T) -> Payload {
    message::encode(content)
}
