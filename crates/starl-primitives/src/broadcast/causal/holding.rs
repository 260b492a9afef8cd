//! What is held back, and until when.

use super::super::Gap;
use super::vector::After;
use super::{Causal, LEAST_LOOKS, LONGEST_SILENCE};
use crate::reliable::Arrival;
use alloc::vec::Vec;
use starl_core::Robot;
use starl_core::event::messaging::MessageNumber;
use starl_core::event::{BroadcastEvent, TransferEvent};

/// A message that has arrived and is not handed out yet.
#[derive(Clone, Debug)]
pub(super) struct Held {
    pub arrival: Arrival,
    /// What it comes after, the message before it from the same sender included.
    pub after: Vec<After>,
    /// What it comes after of this robot's own, in this life or an earlier one. Nobody waits for that, but
    /// what this robot sends next comes after it too.
    pub own: Vec<After>,
    /// How often it was looked at.
    pub looks: u32,
}

impl Held {
    fn is_among(&self, after: &After) -> bool {
        self.arrival.from == after.process.robot
            && self.arrival.incarnation == after.process.incarnation
            && self.arrival.number <= after.number
    }
}

impl Causal {
    /// Something that a message comes after and has to wait for.
    pub(super) fn missing(&self, held: &Held) -> Option<After> {
        let mut all = held.after.iter();
        all.find(|after| !self.is_settled(held, after)).copied()
    }

    /// Whether all that comes before has been handed out or will not come.
    fn is_settled(&self, held: &Held, after: &After) -> bool {
        if self.held.iter().any(|other| other.is_among(after)) {
            return false;
        }
        let known = self.vector.get(after.process);
        let is_known = known.is_some_and(|known| known.taken.max(known.settled) >= after.number);
        // A suspicion alone may be wrong: the sender is asked as well, which settles it if it is up.
        let sender = after.process.robot;
        let heard = self.heard.get(&sender);
        let is_silent =
            heard.is_none_or(|&heard| self.looks.wrapping_sub(heard) >= LONGEST_SILENCE);
        let is_lost = held.looks >= LEAST_LOOKS && self.suspects.contains(&sender)
            || held.looks >= LONGEST_SILENCE && is_silent;
        let is_forgotten = self.vector.is_forgotten(after.process);
        after.number == 0 || is_known || is_forgotten || is_lost
    }

    /// Hands out all that waits for nothing.
    pub(super) fn hand_out_ready(&mut self, robot: &mut Robot<'_>) {
        loop {
            let mut held = self.held.iter();
            let Some(place) = held.position(|held| self.missing(held).is_none()) else {
                return;
            };
            self.hand_out(robot, place);
        }
    }

    /// A message waits no longer, or another one that is held and that it waits for does not.
    pub(super) fn force(&mut self, robot: &mut Robot<'_>, place: usize) {
        let mut next = place;
        // Each step leads to a message before the last; more steps than messages are a circle, which no
        // true messages make.
        for _ in 0..self.held.len() {
            let Some(held) = self.held.get(next) else {
                return;
            };
            let mut all = held.after.iter();
            let before = all.find_map(|after| self.held.iter().position(|h| h.is_among(after)));
            match before {
                Some(before) => next = before,
                None => break,
            }
        }
        if next < self.held.len() {
            self.hand_out(robot, next);
        }
        self.hand_out_ready(robot);
    }

    /// Hands out a message; what it comes after and has not come is passed over.
    fn hand_out(&mut self, robot: &mut Robot<'_>, place: usize) {
        let Held {
            arrival,
            after,
            own,
            ..
        } = self.held.remove(place);
        let port = self.channel.port;
        for After { process, number } in own {
            if let Some(known) = self.vector.note(process) {
                known.taken = known.taken.max(number);
            }
        }
        for After { process, number } in after {
            if self.vector.is_taken(process, number) {
                continue;
            }
            let message = MessageNumber {
                number,
                incarnation: process.incarnation,
            };
            let from = process.robot;
            robot.report(port, BroadcastEvent::PassOver { from, message });
            let Some(known) = self.vector.note(process) else {
                continue;
            };
            known.taken = number;
            // To a robot that joins late what was sent before is no loss.
            if known.is_joined {
                self.gaps.push(Gap {
                    from: Some(process.robot),
                });
            }
        }
        let process = super::Process {
            robot: arrival.from,
            incarnation: arrival.incarnation,
        };
        let (from, message) = arrival.numbered();
        let known = self.vector.hear(process);
        if arrival.number <= known.taken {
            return robot.report(port, BroadcastEvent::Late { from, message });
        }
        known.taken = arrival.number;
        known.is_joined = true;
        robot.report(
            port,
            BroadcastEvent::from(TransferEvent::Deliver { from, message }),
        );
        robot.deliver(arrival.from, port, arrival.content);
    }
}
