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
mod options;
mod outbox;
mod packet;

pub use options::Options;

use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use inbox::Inbox;
use outbox::{Outbox, Outgoing};
use packet::{Key, Packet, Stream};
use smallvec::SmallVec;
use starl_core::random::hash_key;
use starl_core::{Destination, Input, Payload, Port, Robot, RobotId, TimerKey, message};

/// Names a message of this robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct MessageId {
    /// The sender's incarnation: another one each time it starts.
    pub incarnation: u32,
    /// The receiver; none where it went to all.
    pub to: Option<RobotId>,
    /// Counts from 1 what this incarnation sent to `to`.
    pub number: u32,
}

/// A message that reached this robot.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrival {
    /// Its sender.
    pub from: RobotId,
    /// The sender's incarnation.
    pub incarnation: u32,
    /// Whether it went to all, and not to this robot alone.
    pub to_all: bool,
    /// The sender's number for it: see [`MessageId`].
    pub number: u32,
    /// The sender's bytes.
    pub content: Payload,
}

/// What its owner learns from the protocol.
#[derive(Clone, Debug, PartialEq)]
pub enum Notice {
    /// A message reached this robot.
    Arrived(Arrival),
    /// All receivers have acknowledged a message of this robot.
    Acknowledged(MessageId),
    /// These receivers did not acknowledge a message of this robot within the retries. They may have
    /// taken it all the same, if it was the acknowledgements that were lost.
    Failed {
        /// Which message.
        message: MessageId,
        /// Its receivers that were not heard of, in the order of their numbers.
        unreached: Vec<RobotId>,
    },
}

/// What the protocol learns at once; usually nothing or one thing.
pub type Notices = SmallVec<[Notice; 1]>;

/// One end of the protocol, the same on every robot that carries `port`.
#[derive(Clone, Debug)]
pub struct Reliable {
    port: Port,
    timer_kind: u16,
    options: Options,
    /// Drawn when it is first needed.
    incarnation: Option<u32>,
    /// The number of the last message to all.
    last_multicast: u32,
    /// The number of the last message to each robot.
    last_direct: BTreeMap<RobotId, u32>,
    outbox: Outbox,
    inboxes: BTreeMap<RobotId, Inbox>,
}

impl Reliable {
    /// An end at the owner's port, whose timers are those of `timer_kind`: the owner hands both its
    /// messages and these timers to [`Reliable::handle`].
    pub fn new(port: Port, timer_kind: u16, options: Options) -> Reliable {
        Reliable {
            port,
            timer_kind,
            options,
            incarnation: None,
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
        Some(message.incarnation) == self.incarnation && self.outbox.contains(message)
    }

    /// The number of messages still on their way.
    pub fn outstanding(&self) -> usize {
        self.outbox.len()
    }

    /// The name of the next message to all.
    pub fn next_to_all(&mut self, robot: &mut Robot<'_>) -> MessageId {
        let number = self.last_multicast.wrapping_add(1);
        MessageId {
            incarnation: self.incarnation(robot),
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
            incarnation: self.incarnation(robot),
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

    /// Takes an input of the robot: messages to the owner's port and timers of its `timer_kind`;
    /// others are ignored.
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
                    None => Notices::new(),
                }
            }
            Input::Timer(key) if key.port == self.port && key.kind == self.timer_kind => {
                self.timed_out(robot, key.number)
            }
            _ => Notices::new(),
        }
    }

    fn dispatch(
        &mut self,
        robot: &mut Robot<'_>,
        message: MessageId,
        pending: Vec<RobotId>,
        content: Payload,
    ) -> (MessageId, Notices) {
        let mut notices = Notices::new();
        if pending.is_empty() {
            notices.push(Notice::Acknowledged(message));
            return (message, notices);
        }
        if self.outbox.len() >= self.options.most_outstanding.max(1) as usize
            && let Some((ticket, oldest)) = self.outbox.pop_oldest()
        {
            robot.cancel_timer(self.timer(ticket));
            notices.push(Notice::Failed {
                message: oldest.message,
                unreached: oldest.pending,
            });
        }
        let ticket = self.outbox.insert(Outgoing {
            message,
            content,
            pending,
            attempt: 0,
        });
        self.transmit(robot, ticket);
        (message, notices)
    }

    /// Sends a message of the outbox, to all the first time and then to each that is pending.
    fn transmit(&mut self, robot: &mut Robot<'_>, ticket: u32) {
        let Some(outgoing) = self.outbox.get(ticket) else {
            return;
        };
        let MessageId {
            incarnation,
            to,
            number,
        } = outgoing.message;
        let stream = if to.is_some() {
            Stream::Direct
        } else {
            Stream::Multicast
        };
        let key = Key {
            incarnation,
            stream,
            number,
        };
        let send = |robot: &mut Robot<'_>, destination, oldest: u32| {
            let oldest_back = number.saturating_sub(oldest);
            let packet = Packet::Data {
                key,
                oldest_back,
                content: &outgoing.content[..],
            };
            robot.transmit(destination, self.port, &packet);
        };
        if to.is_none() && outgoing.attempt == 0 {
            send(robot, Destination::All, self.outbox.oldest_to_all());
        } else {
            for &peer in &outgoing.pending {
                send(
                    robot,
                    Destination::Robot(peer),
                    self.outbox.oldest_to(peer, to),
                );
            }
        }
        let timeout = self.options.timeout(outgoing.attempt).seconds();
        let stretched = timeout * (1.0 + self.options.safe_jitter() * robot.random().uniform());
        let after = starl_core::Duration::from_seconds_f64(stretched);
        robot.set_timer(self.timer(ticket), after);
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
        let inbox = self
            .inboxes
            .entry(from)
            .or_insert_with(|| Inbox::new(incarnation));
        let Some(sequence) = inbox.sequence(incarnation, stream) else {
            return Notices::new();
        };
        let most_gaps = self.options.most_gaps;
        let taken = if self.options.first_in_first_out {
            sequence.take_in_order(number, oldest, content, most_gaps)
        } else {
            sequence.take(number, oldest, content, most_gaps)
        };
        let to_all = stream == Stream::Multicast;
        let numbers = taken.arrived.iter().map(|&(number, _)| number);
        for number in numbers.chain(taken.again.then_some(number)) {
            let acknowledgement = Packet::<Payload>::Acknowledge(Key { number, ..key });
            robot.transmit(Destination::Robot(from), self.port, &acknowledgement);
        }
        let arrivals = taken.arrived.into_iter().map(|(number, content)| {
            Notice::Arrived(Arrival {
                from,
                incarnation,
                to_all,
                number,
                content,
            })
        });
        arrivals.collect()
    }

    fn acknowledged(&mut self, robot: &mut Robot<'_>, from: RobotId, key: Key) -> Notices {
        let Key {
            incarnation,
            stream,
            number,
        } = key;
        let to = (stream == Stream::Direct).then_some(from);
        let message = MessageId {
            incarnation,
            to,
            number,
        };
        let mut notices = Notices::new();
        if let Some(ticket) = self.outbox.acknowledge(message, from) {
            robot.cancel_timer(self.timer(ticket));
            notices.push(Notice::Acknowledged(message));
        }
        notices
    }

    fn timed_out(&mut self, robot: &mut Robot<'_>, ticket: u32) -> Notices {
        let mut notices = Notices::new();
        let Some(outgoing) = self.outbox.get_mut(ticket) else {
            return notices;
        };
        if outgoing.attempt < self.options.retries {
            outgoing.attempt += 1;
            self.transmit(robot, ticket);
        } else if let Some(outgoing) = self.outbox.remove(ticket) {
            let Outgoing {
                message,
                pending: unreached,
                ..
            } = outgoing;
            notices.push(Notice::Failed { message, unreached });
        }
        notices
    }

    /// This run's number. The clock is mixed in so that a robot whose random stream starts over draws
    /// another one.
    fn incarnation(&mut self, robot: &mut Robot<'_>) -> u32 {
        *self.incarnation.get_or_insert_with(|| {
            let bits = u64::from(robot.random().bits());
            hash_key(robot.now().0, &[bits]) as u32
        })
    }

    fn timer(&self, ticket: u32) -> TimerKey {
        TimerKey {
            port: self.port,
            kind: self.timer_kind,
            number: ticket,
        }
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
