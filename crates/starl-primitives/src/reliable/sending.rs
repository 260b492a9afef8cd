//! The sender's half of the protocol: every message is tried until all have taken it or its time is up.
//!
//! Arrivals reveal losses: a message that was sent well before another one that a receiver has is retransmitted
//! immediately (as in RACK, RFC 8985). A silent receiver gets its missing messages again after a timeout, which
//! doubles each time. Retransmissions to a receiver share datagrams.

use super::line::{CHUNK, Head};
use super::outgoing::Credit;
use super::packet::Stream;
use super::{Alarm, MessageId, Notice, Notices, Reliable};
use alloc::vec::Vec;
use core::ops::Range;
use starl_core::{Duration, Payload, Robot, RobotId, Time, TimerKey};

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
        let last = to.or_else(|| robot.fleet().last().copied());
        let last = last.unwrap_or_else(|| robot.id());
        let most = self.options.most_outstanding.max(1) as usize;
        let outgoing = self.outgoing_mut(to);
        while outgoing.len() >= most {
            line.give_up(robot, outgoing, &mut notices);
        }
        let number = outgoing.push(content, now, receivers as u32, last);
        let message = line.name(number);
        if receivers == 0 {
            notices.push(Notice::Acknowledged(message));
            return (message, notices);
        }
        let due = now + line.stretched(robot, 0);
        // Robots that do not know this robot learn of it by any of its messages.
        let attempt = outgoing.strangers.attempt;
        outgoing.strangers.due = Some(now + line.stretched(robot, attempt));
        line.send(robot, outgoing, Head::of(line.destination()), &[number]);
        self.wake_to_resend(robot, due);
        (message, notices)
    }

    /// A robot acknowledges messages of a stream.
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
            return Notices::new(); // no robot can have taken that
        }
        let ahead = runs(before, &ahead);
        let Credit { settled, newest } = outgoing.credit(from, before, &ahead, are_taken);
        let settled = settled.into_iter().map(|number| line.name(number));
        let mut notices: Notices = settled.map(Notice::Acknowledged).collect();
        match line.recover(robot, outgoing, from, newest, &mut notices) {
            Some(due) => self.wake_to_resend(robot, due),
            None => self.rest(robot),
        }
        notices
    }

    /// A robot does not know this incarnation: it gets an answer and the missing messages.
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
        let mut receiver = outgoing.receivers.take(from).unwrap_or_default();
        // A life that does not know this one holds nothing of it.
        receiver.held = super::runs::Runs::before(1);
        receiver.token = Some(token);
        let mut notices = Notices::new();
        line.bring_up(robot, outgoing, &mut receiver, (from, CHUNK), &mut notices);
        let due = now + line.stretched(robot, 0);
        receiver.trying.due.get_or_insert(due);
        outgoing.receivers.put(from, receiver);
        if !self.is_idle() {
            self.wake_to_resend(robot, due);
        }
        notices
    }

    /// A robot that did not answer speaks: it is tried soon.
    pub(super) fn heard_of(&mut self, robot: &mut Robot<'_>, peer: RobotId) {
        let soon = robot.now() + self.options.first_timeout;
        let direct = self.direct.get_mut(&peer);
        let all = core::iter::once(&mut self.multicast).chain(direct);
        let receivers = all.filter_map(|outgoing| outgoing.receivers.busy_mut(peer));
        let mut is_tried = false;
        for receiver in receivers {
            if receiver.trying.due.is_some_and(|due| due > soon) {
                receiver.trying.due = Some(soon);
                is_tried = true;
            }
        }
        if is_tried {
            self.wake_to_resend(robot, soon);
        }
    }

    /// Retransmits due messages.
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
