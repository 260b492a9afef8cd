//! A sender's part of one stream: the content of datagrams, retransmissions, and giving up.

use super::outgoing::{Outgoing, Receiver, Trying};
use super::packet::{Packet, Stream};
use super::{MessageId, Notice, Notices};
use alloc::vec::Vec;
use starl_core::{Destination, Duration, Robot, RobotId, Time};

/// Datagrams with several messages are not longer than this, bytes.
pub(super) const CHUNK: usize = 1000;

/// The number of datagrams that are sent again at once to a receiver.
const BURST: usize = 4;

/// The greatest number of robots that are informed that they need not answer.
const MOST_KNOWN: usize = 100;

/// The common properties of all messages of a stream.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    pub port: starl_core::Port,
    pub options: super::Options,
    pub is_local: bool,
    pub incarnation: u32,
    /// The receiver; none where it goes to all.
    pub to: Option<RobotId>,
}

/// The part of a datagram besides its messages.
#[derive(Debug)]
pub(super) struct Head {
    destination: Destination,
    token: Option<u32>,
    /// No message before this one will come to its receivers, as far as they differ from others.
    base: u32,
    known: Vec<RobotId>,
}

impl Head {
    pub fn of(destination: Destination) -> Head {
        Head {
            destination,
            token: None,
            base: 0,
            known: Vec::new(),
        }
    }

    /// To one robot. Messages that an earlier life of it has taken will not be sent again.
    pub fn to(peer: RobotId, receiver: &Receiver) -> Head {
        Head {
            token: receiver.token,
            base: receiver.taken.next(),
            ..Head::of(Destination::Robot(peer))
        }
    }
}

impl Line {
    pub fn name(&self, number: u32) -> MessageId {
        MessageId {
            incarnation: self.incarnation,
            to: self.to,
            number,
        }
    }

    pub fn destination(&self) -> Destination {
        self.to.map_or(Destination::All, Destination::Robot)
    }

    /// How many robots its messages are for.
    pub fn receivers(&self, robot: &Robot<'_>) -> usize {
        self.to.map_or(robot.fleet().len().saturating_sub(1), |_| 1)
    }

    /// A time-out with its jitter.
    pub fn stretched(&self, robot: &mut Robot<'_>, attempt: u32) -> Duration {
        self.options.stretched(attempt, robot.random().uniform())
    }

    /// Says how far the stream is, with these messages.
    pub fn send(&self, robot: &mut Robot<'_>, outgoing: &Outgoing, head: Head, numbers: &[u32]) {
        let content = |&number: &u32| Some((number, &outgoing.get(number)?.content[..]));
        let packet = Packet::Data {
            incarnation: self.incarnation,
            stream: self.stream(),
            token: head.token,
            base: head.base.max(outgoing.base()),
            next: outgoing.next(),
            known: head.known,
            messages: numbers.iter().filter_map(content).collect(),
        };
        robot.transmit(head.destination, self.port, &packet);
    }

    /// Reports the progress of the stream to those that have never answered. Those that have taken all need
    /// not answer.
    fn remind(&self, robot: &mut Robot<'_>, outgoing: &Outgoing) {
        let next_of = |peer| {
            outgoing
                .receivers
                .read(peer, |receiver| receiver.taken.next())
        };
        let mut known = outgoing.receivers.numbers();
        known.retain(|&peer| next_of(peer) == Some(outgoing.next()));
        known.truncate(MOST_KNOWN);
        let head = Head {
            known,
            ..Head::of(self.destination())
        };
        self.send(robot, outgoing, head, &[]);
    }

    fn stream(&self) -> Stream {
        self.to.map_or(Stream::Multicast, |_| Stream::Direct)
    }

    /// Sends a receiver a datagram of at most so many bytes, or one message, with messages that it lacks and that
    /// were last sent when `is_due` says, the longest ago first. Returns them.
    fn resend(
        &self,
        robot: &mut Robot<'_>,
        outgoing: &Outgoing,
        receiver: &mut Receiver,
        (peer, most): (RobotId, usize),
        is_due: impl Fn(Time) -> bool,
    ) -> Vec<u32> {
        let mut missing: Vec<(Time, u32)> = outgoing
            .missing(receiver, self.options.window)
            .filter_map(|number| Some((outgoing.last_sent(receiver, number)?, number)))
            .filter(|(sent, _)| is_due(*sent))
            .collect();
        missing.sort_unstable();
        let (mut numbers, mut size) = (Vec::new(), 0);
        for (_, number) in missing {
            let length = outgoing.get(number).map_or(0, |m| m.content.len() + 4);
            if size + length > most && !numbers.is_empty() {
                break;
            }
            size += length;
            numbers.push(number);
        }
        numbers.sort_unstable();
        if !numbers.is_empty() {
            self.send(robot, outgoing, Head::to(peer, receiver), &numbers);
        }
        let again = numbers.iter().map(|&number| (number, robot.now()));
        receiver.resent.extend(again);
        numbers
    }

    /// Sends a receiver a datagram with messages that it lacks, or where it lacks none, how far the stream is.
    pub fn bring_up(
        &self,
        robot: &mut Robot<'_>,
        outgoing: &Outgoing,
        receiver: &mut Receiver,
        (peer, most): (RobotId, usize),
        notices: &mut Notices,
    ) {
        let numbers = self.resend(robot, outgoing, receiver, (peer, most), |_| true);
        if numbers.is_empty() {
            self.send(robot, outgoing, Head::to(peer, receiver), &[]);
        }
        self.tell(&numbers, peer, notices);
    }

    /// Retransmits lost messages to a receiver, judged by those that it has: `newest` is the send time of the latest of
    /// them. Returns the time of the next attempt, if messages are missing.
    pub fn recover(
        &self,
        robot: &mut Robot<'_>,
        outgoing: &mut Outgoing,
        peer: RobotId,
        newest: Option<Time>,
        notices: &mut Notices,
    ) -> Option<Time> {
        let now = robot.now();
        let first_timeout = self.options.first_timeout;
        let mut receiver = outgoing.receivers.take(peer)?;
        if outgoing.first_pending(&receiver).is_none() {
            receiver.trying = Trying::default();
            receiver.resent.clear();
            outgoing.receivers.put(peer, receiver);
            return None;
        }
        // A robot that answers would have had messages sent one timeout ago, or well before those
        // that it has.
        let is_before = |sent: Time, later: Time, gap| sent + gap <= later;
        let lost = |sent: Time| {
            is_before(sent, now, first_timeout)
                || newest.is_some_and(|newest| is_before(sent, newest, first_timeout / 4))
        };
        for _ in 0..BURST {
            let numbers = self.resend(robot, outgoing, &mut receiver, (peer, CHUNK), lost);
            if numbers.is_empty() {
                break;
            }
            self.tell(&numbers, peer, notices);
        }
        if newest.is_some() || receiver.trying.due.is_none() {
            receiver.trying = Trying {
                attempt: 0,
                due: Some(now + self.stretched(robot, 0)),
            };
        }
        let due = receiver.trying.due;
        outgoing.receivers.put(peer, receiver);
        due
    }

    /// The notices to the owner about retransmitted messages.
    fn tell(&self, numbers: &[u32], to: RobotId, notices: &mut Notices) {
        let names = numbers.iter().map(|&number| self.name(number));
        let to = || alloc::vec![to];
        notices.extend(names.map(|message| Notice::Repeated { message, to: to() }));
    }

    /// Gives up the first message.
    pub fn give_up(&self, robot: &Robot<'_>, outgoing: &mut Outgoing, notices: &mut Notices) {
        let number = outgoing.base();
        let has_taken = |peer: &RobotId| {
            let receivers = &outgoing.receivers;
            receivers.read(*peer, |receiver| receiver.taken.contains(number))
        };
        let is_for = |peer| {
            outgoing
                .first()
                .is_some_and(|(_, first)| first.is_for(peer))
        };
        let is_meant =
            |peer: &RobotId| is_for(*peer) && (!self.is_local || has_taken(peer).is_some());
        let unreached: Vec<RobotId> = match self.to {
            Some(to) => alloc::vec![to],
            None => robot
                .peers()
                .filter(|peer| is_meant(peer) && has_taken(peer) != Some(true))
                .collect(),
        };
        let message = self.name(number);
        if outgoing.pop() {
            notices.push(match unreached.is_empty() {
                true => Notice::Acknowledged(message),
                false => Notice::Failed { message, unreached },
            });
        }
    }

    /// Whether the time of the first message is up. One that a receiver holds for another one gets a little
    /// more, in which the receiver hears that the other one was given up.
    fn is_over(&self, outgoing: &Outgoing, now: Time) -> bool {
        let Some((number, message)) = outgoing.first() else {
            return false;
        };
        let mut receivers = outgoing.receivers.busy();
        let is_held = receivers.any(|(_, receiver)| receiver.held.contains(number));
        now >= message.sent + self.options.patience(is_held)
    }

    /// Gives up expired messages and retransmits due ones. Returns the time of the next call.
    pub fn look_after(
        &self,
        robot: &mut Robot<'_>,
        outgoing: &mut Outgoing,
        notices: &mut Notices,
    ) -> Option<Time> {
        let now = robot.now();
        let base = outgoing.base();
        while self.is_over(outgoing, now) {
            self.give_up(robot, outgoing, notices);
        }
        let has_given_up = outgoing.base() > base;
        let (_, first) = outgoing.first()?;
        let mut wake = first.sent + self.options.patience(false);
        if wake <= now {
            wake = now + self.options.first_timeout;
        }
        for peer in outgoing.receivers.numbers() {
            let Some(mut receiver) = outgoing.receivers.take(peer) else {
                continue;
            };
            if let Some(pending) = outgoing.first_pending(&receiver) {
                if has_given_up && receiver.held.contains(pending) {
                    receiver.trying = Trying {
                        attempt: 0,
                        due: Some(now),
                    };
                }
                let due = self.try_again(robot, outgoing, (peer, &mut receiver), notices);
                wake = wake.min(due);
            }
            outgoing.receivers.put(peer, receiver);
        }
        if outgoing.receivers.len() < self.receivers(robot) {
            let mut trying = outgoing.strangers;
            let due = trying.due.unwrap_or(now);
            if due <= now {
                self.remind(robot, outgoing);
                trying.attempt = trying.attempt.saturating_add(1);
                trying.due = Some(now + self.stretched(robot, trying.attempt));
            }
            outgoing.strangers = trying;
            wake = wake.min(trying.due.unwrap_or(wake));
        }
        Some(wake)
    }

    /// Tries a receiver with what it lacks, if it is time; gives when it is next.
    fn try_again(
        &self,
        robot: &mut Robot<'_>,
        outgoing: &Outgoing,
        (peer, receiver): (RobotId, &mut Receiver),
        notices: &mut Notices,
    ) -> Time {
        let now = robot.now();
        let pending = outgoing.first_pending(receiver);
        let sent = pending
            .and_then(|number| outgoing.get(number))
            .map(|m| m.sent);
        let first = sent.unwrap_or(now) + self.options.first_timeout;
        let due = receiver.trying.due.unwrap_or(first);
        if due > now {
            receiver.trying.due = Some(due);
            return due;
        }
        receiver.resent = receiver.resent.split_off(&outgoing.base());
        // Where several together do not get through one alone may.
        let most = if receiver.trying.attempt < 2 {
            CHUNK
        } else {
            0
        };
        self.bring_up(robot, outgoing, receiver, (peer, most), notices);
        // A robot that is not heard may hear: each message is due a copy in each attempt.
        let is_due = |sent: Time| sent + self.options.first_timeout <= now;
        for _ in 0..BURST {
            let numbers = self.resend(robot, outgoing, receiver, (peer, CHUNK), is_due);
            if numbers.is_empty() {
                break;
            }
            self.tell(&numbers, peer, notices);
        }
        let trying = &mut receiver.trying;
        trying.attempt = trying.attempt.saturating_add(1);
        let due = now + self.stretched(robot, trying.attempt);
        trying.due = Some(due);
        due
    }
}
