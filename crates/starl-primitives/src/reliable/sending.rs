//! The sender's half of the protocol: every message is repeated until it is settled.

use super::outbox::{Outgoing, Stage};
use super::packet::{Key, Packet, Stream};
use super::{MessageId, Notice, Notices, Reliable};
use alloc::vec::Vec;
use starl_core::{Destination, Duration, Payload, Robot, RobotId};

impl Reliable {
    /// Sends a new message and keeps it until all of `pending` have acknowledged it.
    pub(super) fn dispatch(
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
            sent_behind: false,
            stage: Stage::Trying,
        });
        self.transmit(robot, ticket);
        (message, notices)
    }

    /// Sends a message of the outbox, to all the first time and then to each that is pending.
    fn transmit(&mut self, robot: &mut Robot<'_>, ticket: u32) {
        let sent_behind = self.options.first_in_first_out && self.outbox.is_behind(ticket);
        if let Some(outgoing) = self.outbox.get_mut(ticket) {
            outgoing.sent_behind = sent_behind;
        }
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
        self.arm(robot, ticket, outgoing.attempt);
    }

    /// Arms the timer of a message for its present time-out.
    fn arm(&self, robot: &mut Robot<'_>, ticket: u32, attempt: u32) {
        let timeout = self.options.timeout(attempt).seconds();
        let stretched = timeout * (1.0 + self.options.safe_jitter() * robot.random().uniform());
        robot.set_timer(self.timer(ticket), Duration::from_seconds_f64(stretched));
    }

    /// Takes an acknowledgement.
    pub(super) fn acknowledged(
        &mut self,
        robot: &mut Robot<'_>,
        from: RobotId,
        key: Key,
    ) -> Notices {
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

    /// Sends a message again, or gives it up.
    ///
    /// In FIFO order the last copies may have reached a receiver that holds the message back for an
    /// earlier one. Then it is sent once more when that one has been given up, which releases it.
    pub(super) fn timed_out(&mut self, robot: &mut Robot<'_>, ticket: u32) -> Notices {
        let is_behind = self.outbox.is_behind(ticket);
        let mut notices = Notices::new();
        let Some(outgoing) = self.outbox.get_mut(ticket) else {
            return notices;
        };
        let attempt = outgoing.attempt;
        match outgoing.stage {
            Stage::Trying if attempt < self.options.retries => {
                outgoing.attempt += 1;
                notices.push(outgoing.repeated());
                self.transmit(robot, ticket);
            }
            Stage::Trying | Stage::Waiting if outgoing.sent_behind && is_behind => {
                outgoing.stage = Stage::Waiting;
                self.arm(robot, ticket, attempt);
            }
            Stage::Trying | Stage::Waiting if outgoing.sent_behind => {
                outgoing.stage = Stage::LastTry;
                outgoing.attempt += 1;
                notices.push(outgoing.repeated());
                self.transmit(robot, ticket);
            }
            _ => {
                let pending = core::mem::take(&mut outgoing.pending);
                let message = outgoing.message;
                self.outbox.remove(ticket);
                notices.push(Notice::Failed {
                    message,
                    unreached: pending,
                });
            }
        }
        notices
    }
}
