//! The sender's half of the protocol: every message is tried until all have taken it or its time is up.
//!
//! What is lost is seen from what arrives: a message that was sent well before another one that a receiver turns out
//! to have is sent again at once (as in RACK, RFC 8985). Where nothing is heard of a receiver it is tried with what it
//! lacks after a time-out, which doubles each time. What is sent again to a receiver shares datagrams.

use super::outgoing::{Credit, Outgoing, Receiver, Trying};
use super::packet::{Packet, Stream};
use super::{Alarm, MessageId, Notice, Notices, Reliable};
use alloc::vec::Vec;
use core::ops::Range;
use starl_core::{Destination, Duration, Payload, Robot, RobotId, Time, TimerKey};

/// Datagrams with several messages are not longer than this, bytes.
const CHUNK: usize = 1000;

/// So many robots at most are told that they need not answer.
const MOST_KNOWN: usize = 100;

/// So many datagrams are sent again at once to a receiver that answers.
const BURST: usize = 4;

impl Reliable {
    /// Sends a new message to one robot or to all.
    pub(super) fn dispatch(
        &mut self,
        robot: &mut Robot<'_>,
        to: Option<RobotId>,
        content: Payload,
    ) -> (MessageId, Notices) {
        let incarnation = self.incarnation.of(robot);
        let line = self.line(incarnation, to);
        let now = robot.now();
        let mut notices = Notices::new();
        let receivers = line.receivers(robot);
        let most = self.options.most_outstanding.max(1) as usize;
        let outgoing = self.outgoing_mut(to);
        while outgoing.len() >= most {
            line.give_up(robot, outgoing, &mut notices);
        }
        let number = outgoing.push(content, now, receivers as u32);
        let message = line.name(number);
        if receivers == 0 {
            notices.push(Notice::Acknowledged(message));
            return (message, notices);
        }
        let due = now + line.stretched(robot, 0);
        // Those who do not know this robot hear of it by any of its messages.
        let attempt = outgoing.strangers.attempt;
        outgoing.strangers.due = Some(now + line.stretched(robot, attempt));
        line.send(robot, outgoing, Head::of(line.destination()), &[number]);
        self.wake_to_resend(robot, due);
        (message, notices)
    }

    /// A robot says what it has taken of a stream.
    pub(super) fn taken(
        &mut self,
        robot: &mut Robot<'_>,
        from: RobotId,
        stream: Stream,
        (before, ahead): (u32, Vec<(u32, u32)>),
    ) -> Notices {
        let Some(incarnation) = self.incarnation.known() else {
            return Notices::new();
        };
        let to = (stream == Stream::Direct).then_some(from);
        let line = self.line(incarnation, to);
        let are_taken = !self.options.first_in_first_out;
        let Some(outgoing) = self.outgoing(to) else {
            return Notices::new();
        };
        if before > outgoing.next() {
            return Notices::new(); // nobody can have taken that
        }
        let ahead = runs(before, &ahead);
        let Credit { settled, newest } = outgoing.credit(from, before, &ahead, are_taken);
        let settled = settled.into_iter().map(|number| line.name(number));
        let notices: Notices = settled.map(Notice::Acknowledged).collect();
        self.recover(robot, to, from, newest, notices)
    }

    /// Sends a receiver again what was lost, as what it has shows.
    fn recover(
        &mut self,
        robot: &mut Robot<'_>,
        to: Option<RobotId>,
        peer: RobotId,
        newest: Option<Time>,
        mut notices: Notices,
    ) -> Notices {
        let incarnation = self.incarnation.of(robot);
        let line = self.line(incarnation, to);
        let now = robot.now();
        let first_timeout = self.options.first_timeout;
        let Some(outgoing) = self.outgoing(to) else {
            return notices;
        };
        let Some(mut receiver) = outgoing.receivers.remove(&peer) else {
            return notices;
        };
        let mut wake = None;
        if outgoing.first_pending(&receiver).is_none() {
            receiver.trying = Trying::default();
            receiver.resent.clear();
        } else {
            for _ in 0..BURST {
                // Whoever answers would have had what was sent a time-out ago, or well before what it has.
                let is_before = |sent: Time, later: Time, gap| sent + gap <= later;
                let lost = |sent: Time| {
                    is_before(sent, now, first_timeout)
                        || newest.is_some_and(|newest| is_before(sent, newest, first_timeout / 4))
                };
                let numbers = line.resend(robot, outgoing, &mut receiver, (peer, CHUNK), lost);
                if numbers.is_empty() {
                    break;
                }
                line.tell(&numbers, peer, &mut notices);
            }
            if newest.is_some() || receiver.trying.due.is_none() {
                receiver.trying = Trying {
                    attempt: 0,
                    due: Some(now + line.stretched(robot, 0)),
                };
            }
            wake = receiver.trying.due;
        }
        outgoing.receivers.insert(peer, receiver);
        match wake {
            Some(due) => self.wake_to_resend(robot, due),
            None => self.rest(robot),
        }
        notices
    }

    /// A robot does not know this incarnation: it is told, and sent what it lacks.
    pub(super) fn greeted(
        &mut self,
        robot: &mut Robot<'_>,
        from: RobotId,
        stream: Stream,
        token: u32,
    ) -> Notices {
        let to = (stream == Stream::Direct).then_some(from);
        let incarnation = self.incarnation.of(robot);
        let line = self.line(incarnation, to);
        let now = robot.now();
        let outgoing = self.outgoing_mut(to);
        let mut receiver = outgoing.receivers.remove(&from).unwrap_or_default();
        // A life that does not know this one holds nothing of it.
        receiver.held = super::runs::Runs::before(1);
        receiver.token = Some(token);
        let any = |_: Time| true;
        let numbers = line.resend(robot, outgoing, &mut receiver, (from, CHUNK), any);
        if numbers.is_empty() {
            line.send(robot, outgoing, Head::to(from, &receiver), &[]);
        }
        let due = now + line.stretched(robot, 0);
        receiver.trying.due.get_or_insert(due);
        outgoing.receivers.insert(from, receiver);
        if !self.is_idle() {
            self.wake_to_resend(robot, due);
        }
        let mut notices = Notices::new();
        line.tell(&numbers, from, &mut notices);
        notices
    }

    /// A robot that did not answer speaks: it is tried soon.
    pub(super) fn heard_of(&mut self, robot: &mut Robot<'_>, peer: RobotId) {
        let soon = robot.now() + self.options.first_timeout;
        let direct = self.direct.get_mut(&peer);
        let all = core::iter::once(&mut self.multicast).chain(direct);
        let mut receivers = all.filter_map(|outgoing| outgoing.receivers.get_mut(&peer));
        let mut is_tried = false;
        for receiver in receivers.by_ref() {
            if receiver.trying.due.is_some_and(|due| due > soon) {
                receiver.trying.due = Some(soon);
                is_tried = true;
            }
        }
        if is_tried {
            self.wake_to_resend(robot, soon);
        }
    }

    /// Looks after all that is on its way.
    pub(super) fn resend_due(&mut self, robot: &mut Robot<'_>) -> Notices {
        let incarnation = self.incarnation.of(robot);
        let mut notices = Notices::new();
        let mut wake: Option<Time> = None;
        self.resend_at = None;
        let peers: Vec<Option<RobotId>> = core::iter::once(None)
            .chain(self.direct.keys().copied().map(Some))
            .collect();
        for to in peers {
            let line = self.line(incarnation, to);
            let Some(outgoing) = self.outgoing(to) else {
                continue;
            };
            if let Some(next) = line.look_after(robot, outgoing, &mut notices) {
                wake = Some(wake.map_or(next, |wake| wake.min(next)));
            }
        }
        if let Some(wake) = wake {
            self.wake_to_resend(robot, wake);
        }
        notices
    }

    fn wake_to_resend(&mut self, robot: &mut Robot<'_>, at: Time) {
        if self.resend_at.is_none_or(|earlier| at < earlier) {
            self.resend_at = Some(at);
            // A clock that was set back must not put it off.
            let longest = self.options.longest_timeout.max(self.options.first_timeout) * 2;
            let after = at.since(robot.now()).min(longest);
            let after = after.max(Duration::from_millis(1));
            robot.set_timer(TimerKey::new(self.port, Alarm::Resend), after);
        }
    }

    /// Whether nothing is on its way.
    fn is_idle(&self) -> bool {
        self.multicast.len() == 0 && self.direct.values().all(|outgoing| outgoing.len() == 0)
    }

    /// Needs no timer where there is nothing to do.
    fn rest(&mut self, robot: &mut Robot<'_>) {
        if self.is_idle() && self.resend_at.take().is_some() {
            robot.cancel_timer(TimerKey::new(self.port, Alarm::Resend));
        }
    }
}

/// Runs of numbers from how many are missing before each, and how many it has.
fn runs(before: u32, ahead: &[(u32, u32)]) -> Vec<Range<u32>> {
    let mut end = before;
    let runs = ahead.iter().map(|&(skipped, count)| {
        let start = end.saturating_add(skipped);
        end = start.saturating_add(count);
        start..end
    });
    runs.collect()
}

/// What is the same for all messages of a stream.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    pub port: starl_core::Port,
    pub options: super::Options,
    pub is_local: bool,
    pub incarnation: u32,
    /// The receiver; none where it goes to all.
    pub to: Option<RobotId>,
}

/// What a datagram says besides its messages.
#[derive(Debug)]
struct Head {
    destination: Destination,
    token: Option<u32>,
    /// No message before this one will come to its receivers, as far as they differ from others.
    base: u32,
    known: Vec<RobotId>,
}

impl Head {
    fn of(destination: Destination) -> Head {
        Head {
            destination,
            token: None,
            base: 0,
            known: Vec::new(),
        }
    }

    /// To one robot. What an earlier life of it has taken will not come again.
    fn to(peer: RobotId, receiver: &Receiver) -> Head {
        Head {
            token: receiver.token,
            base: receiver.taken.next(),
            ..Head::of(Destination::Robot(peer))
        }
    }
}

impl Line {
    fn name(&self, number: u32) -> MessageId {
        MessageId {
            incarnation: self.incarnation,
            to: self.to,
            number,
        }
    }

    fn destination(&self) -> Destination {
        self.to.map_or(Destination::All, Destination::Robot)
    }

    /// How many robots its messages are for.
    fn receivers(&self, robot: &Robot<'_>) -> usize {
        self.to.map_or(robot.fleet().len().saturating_sub(1), |_| 1)
    }

    /// A time-out with its jitter.
    fn stretched(&self, robot: &mut Robot<'_>, attempt: u32) -> Duration {
        let timeout = self.options.timeout(attempt).seconds();
        let factor = 1.0 + self.options.safe_jitter() * robot.random().uniform();
        Duration::from_seconds_f64(timeout * factor)
    }

    /// Says how far the stream is, with these messages.
    fn send(&self, robot: &mut Robot<'_>, outgoing: &Outgoing, head: Head, numbers: &[u32]) {
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

    /// Says how far the stream is to those who have never answered. Those who have taken all need not answer.
    fn remind(&self, robot: &mut Robot<'_>, outgoing: &Outgoing) {
        let receivers = outgoing.receivers.iter();
        let have_all = receivers.filter(|(_, receiver)| receiver.taken.next() == outgoing.next());
        let known = have_all.map(|(&peer, _)| peer).take(MOST_KNOWN).collect();
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
    /// were last sent when `is_due` says, the longest ago first. Gives them.
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

    /// What the owner learns of messages that were sent again.
    fn tell(&self, numbers: &[u32], to: RobotId, notices: &mut Notices) {
        let names = numbers.iter().map(|&number| self.name(number));
        let to = || alloc::vec![to];
        notices.extend(names.map(|message| Notice::Repeated { message, to: to() }));
    }

    /// Gives up the first message.
    fn give_up(&self, robot: &Robot<'_>, outgoing: &mut Outgoing, notices: &mut Notices) {
        let number = outgoing.base();
        let has_taken = |peer: &RobotId| {
            let receiver = outgoing.receivers.get(peer);
            receiver.is_some_and(|receiver| receiver.taken.contains(number))
        };
        let is_meant = |peer: &RobotId| !self.is_local || outgoing.receivers.contains_key(peer);
        let unreached: Vec<RobotId> = match self.to {
            Some(to) => alloc::vec![to],
            None => robot
                .peers()
                .filter(|peer| is_meant(peer) && !has_taken(peer))
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
        let mut receivers = outgoing.receivers.values();
        let is_held = receivers.any(|receiver| receiver.held.contains(number));
        now >= message.sent + self.options.patience(is_held)
    }

    /// Gives up what is over and tries those again that are due. Gives when to do so next.
    fn look_after(
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
        let receivers: Vec<RobotId> = outgoing.receivers.keys().copied().collect();
        for peer in receivers {
            let Some(mut receiver) = outgoing.receivers.remove(&peer) else {
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
            outgoing.receivers.insert(peer, receiver);
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
        let numbers = self.resend(robot, outgoing, receiver, (peer, most), |_| true);
        if numbers.is_empty() {
            self.send(robot, outgoing, Head::to(peer, receiver), &[]);
        }
        self.tell(&numbers, peer, notices);
        let trying = &mut receiver.trying;
        trying.attempt = trying.attempt.saturating_add(1);
        let due = now + self.stretched(robot, trying.attempt);
        trying.due = Some(due);
        due
    }
}
