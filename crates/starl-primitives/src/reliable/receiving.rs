//! The receiver's half of the protocol: messages are delivered once and acknowledged.

use super::inbox::{Arrived, Owed};
use super::packet::{Packet, Stream};
use super::sorted::trim;
use super::{Alarm, Arrival, Notice, Notices, Reliable};
use alloc::vec::Vec;
use starl_core::{Destination, Duration, Payload, Robot, RobotId, Time, TimerKey};

/// The number of runs of messages that one acknowledgement reports.
const MOST_RUNS: usize = 24;

/// How far a stream is, as its sender says.
pub(super) struct Progress {
    pub incarnation: u32,
    pub stream: Stream,
    pub token: Option<u32>,
    pub base: u32,
    pub next: u32,
    /// Whether this robot need not answer if it has all.
    pub is_known: bool,
}

impl Reliable {
    /// A robot says how far its stream is, and sends some of it.
    pub(super) fn take(
        &mut self,
        robot: &mut Robot<'_>,
        from: RobotId,
        progress: &Progress,
        messages: Vec<(u32, Payload)>,
    ) -> Notices {
        let &Progress {
            incarnation,
            stream,
            token,
            base,
            next,
            is_known,
        } = progress;
        let are_sound = messages.iter().all(|(number, _)| *number < next);
        if base == 0 || base > next || !are_sound {
            return Notices::new(); // no robot of ours says this
        }
        let mut notices = Notices::new();
        let window = self.options.window;
        let inboxes = &mut self.inboxes[stream as usize];
        let mut inbox = inboxes.take(from).unwrap_or_default();
        let is_answer = token.is_some_and(|token| inbox.begin(incarnation, token, base));
        let mut arrived = Arrived::new();
        inbox.owed = match inbox.lives.of(incarnation) {
            None => {
                inbox.asking.attempt = 0;
                Owed::Greeting
            }
            Some(sequence) => {
                sequence.settle(base, &mut arrived);
                for (number, content) in messages {
                    match self.options.first_in_first_out {
                        true => sequence.hold(number, content, window, &mut arrived),
                        false => sequence.take(number, content, window, &mut arrived),
                    }
                }
                match is_known && sequence.has_all(next) {
                    true => inbox.owed,
                    false => Owed::Taken,
                }
            }
        };
        inboxes.put(from, inbox);
        notices.extend(arrived.into_iter().map(|(number, content)| {
            Notice::Arrived(Arrival {
                from,
                incarnation,
                to_all: stream == Stream::Multicast,
                number,
                content,
            })
        }));
        if let Some(ticket) = token.filter(|_| is_answer && stream == Stream::Multicast) {
            notices.push(Notice::Settled {
                from,
                incarnation,
                before: base,
                next,
                ticket,
            });
        }
        self.answer_soon(robot, (from, stream));
        notices
    }

    /// Asks a robot which of its messages to all may still come. The answer, if it arrives, is a [`Notice::Settled`]
    /// with the returned ticket.
    pub fn ask(&mut self, robot: &mut Robot<'_>, peer: RobotId) -> u32 {
        let inboxes = &mut self.inboxes[Stream::Multicast as usize];
        let mut inbox = inboxes.take(peer).unwrap_or_default();
        inbox.lives.renew_token();
        inbox.owed = Owed::Greeting;
        let token = inbox.lives.token(robot);
        inboxes.put(peer, inbox);
        self.answer(robot, (peer, Stream::Multicast));
        token
    }

    /// Answers a sender at once if it was not answered just now, else a little later: then one answer
    /// stands for everything that comes meanwhile.
    fn answer_soon(&mut self, robot: &mut Robot<'_>, sender: (RobotId, Stream)) {
        let now = robot.now();
        match self.options.answer_time(self.last_answer(sender), now) {
            at if at <= now => self.answer(robot, sender),
            at => self.wake_to_answer(robot, at),
        }
    }

    fn answer(&mut self, robot: &mut Robot<'_>, (from, stream): (RobotId, Stream)) {
        self.note_answer(robot.now(), (from, stream));
        let inboxes = &mut self.inboxes[stream as usize];
        let Some(mut inbox) = inboxes.take(from) else {
            return;
        };
        let owed = match core::mem::take(&mut inbox.owed) {
            Owed::Nothing if inbox.asking.due.is_some_and(|due| due <= robot.now()) => {
                Owed::Greeting
            }
            owed => owed,
        };
        let packet = match (owed, &inbox.lives.heard) {
            (Owed::Nothing, _) => None,
            (Owed::Taken, Some((incarnation, sequence))) => {
                let (before, ahead) = sequence.report(MOST_RUNS);
                Some(Packet::<Payload>::Taken {
                    incarnation: *incarnation,
                    stream,
                    before,
                    ahead,
                })
            }
            (Owed::Taken | Owed::Greeting, _) => {
                let token = inbox.lives.token(robot);
                inbox.ask_again(robot.now(), token, &self.options);
                Some(Packet::Greet { stream, token })
            }
        };
        let again = inbox.asking.due;
        inboxes.put(from, inbox);
        if let Some(at) = again {
            self.wake_to_answer(robot, at);
        }
        if let Some(packet) = packet {
            robot.transmit(Destination::Robot(from), self.port, &packet);
        }
    }

    fn last_answer(&self, sender: (RobotId, Stream)) -> Option<Time> {
        let found = self.answered.binary_search_by_key(&sender, |entry| entry.0);
        found.ok().map(|at| self.answered[at].1)
    }

    /// Notes that a sender is answered, and forgets answers that nothing has to wait for any more.
    fn note_answer(&mut self, now: Time, sender: (RobotId, Stream)) {
        let is_late = |(other, at): &(_, Time)| {
            *other != sender && self.options.answer_time(Some(*at), *at) > now
        };
        self.answered.retain(is_late);
        trim(&mut self.answered);
        let (Ok(at) | Err(at)) = self.answered.binary_search_by_key(&sender, |entry| entry.0);
        self.answered.insert(at, (sender, now));
    }

    /// Sends due acknowledgements and questions.
    pub(super) fn answer_due(&mut self, robot: &mut Robot<'_>) {
        let now = robot.now();
        self.answer_at = None;
        let mut owing = Vec::new();
        for stream in [Stream::Multicast, Stream::Direct] {
            let busy = self.inboxes[stream as usize].busy();
            owing.extend(busy.filter_map(|(from, inbox)| {
                let due = inbox.due(self.last_answer((from, stream)), now, &self.options)?;
                Some(((from, stream), due))
            }));
        }
        owing.sort_unstable();
        for (sender, due) in owing {
            match due <= now {
                true => self.answer(robot, sender),
                false => self.wake_to_answer(robot, due),
            }
        }
    }

    fn wake_to_answer(&mut self, robot: &mut Robot<'_>, at: Time) {
        if self.answer_at.is_none_or(|earlier| at < earlier) {
            self.answer_at = Some(at);
            let after = at.since(robot.now()).max(Duration::from_millis(1));
            robot.set_timer(TimerKey::new(self.port, Alarm::Answer), after);
        }
    }
}
