//! The messages that are held back, with their deadlines.
//!
//! Each sender's messages are held in the order in which they came, so only the first of each can be ready.

use super::super::Gap;
use super::vector::{After, Process, Rank, Standing};
use super::{Causal, LEAST_LOOKS, LONGEST_SILENCE, Look};
use crate::reliable::Arrival;
use alloc::collections::VecDeque;
use alloc::vec::Vec;
use starl_core::event::messaging::MessageNumber;
use starl_core::event::{BroadcastEvent, TransferEvent};
use starl_core::{Robot, RobotId};

/// A message that has arrived and is not delivered yet.
#[derive(Clone, Debug)]
pub(super) struct Held {
    pub arrival: Arrival,
    /// The messages on which it depends, including the one before it from the same sender.
    pub after: Vec<Need>,
    /// Its place in the order in which messages arrived.
    pub place: u64,
    /// The count of looks when it came.
    pub looks: Look,
}

/// A dependency of a message on another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Need {
    pub after: After,
    /// Whether the other was sent in a life that is over, so that it will not arrive.
    pub is_over: bool,
}

impl Held {
    /// The message as one to wait for.
    fn itself(&self) -> Need {
        Need {
            after: After {
                process: self.process(),
                number: self.arrival.number,
            },
            is_over: true,
        }
    }

    fn process(&self) -> Process {
        Process {
            robot: self.arrival.from,
            incarnation: self.arrival.incarnation,
        }
    }
}

impl Causal {
    /// For how many looks it has been held.
    pub(super) fn age(&self, held: &Held) -> u32 {
        self.looks.wrapping_sub(held.looks)
    }

    /// A dependency for which the message must wait. A message also waits while its sender has not said that the message
    /// is not from a life before one that was passed over.
    pub(super) fn missing(&self, held: &Held) -> Option<After> {
        if let Some(unheard) = self.vector.unheard(held.arrival.from) {
            return Some(unheard);
        }
        let mut all = held.after.iter();
        let need = all.find(|need| !self.is_settled(held, need))?;
        Some(need.after)
    }

    /// Whether everything that comes before has been delivered or will not come.
    fn is_settled(&self, held: &Held, need: &Need) -> bool {
        if self.is_held(&need.after) {
            return false;
        }
        let Process { robot: sender, .. } = need.after.process;
        let is_known = match self.vector.standing(need.after.process) {
            Standing::Present(life) => life.taken.max(life.settled) >= need.after.number,
            Standing::Over(_) => true,
            Standing::Unknown(passed) => passed.is_some_and(|passed| passed >= need.after.number),
        };
        // A suspicion alone may be wrong: the sender is asked as well, which settles it if it is up.
        let heard = self.heard.get(&sender);
        let silence = heard.map_or(u32::MAX, |&heard| self.looks.wrapping_sub(heard));
        let waited = self.age(held).min(silence);
        let is_lost =
            waited >= LEAST_LOOKS && self.suspects.contains(&sender) || waited >= LONGEST_SILENCE;
        is_known || need.is_over || is_lost
    }

    /// Whether one that has arrived is held.
    fn is_held(&self, after: &After) -> bool {
        let mut held = self.held.get(&after.process.robot).into_iter().flatten();
        let first = held.find(|held| held.process() == after.process);
        first.is_some_and(|first| first.arrival.number <= after.number)
    }

    /// Whether the message may be from a life before one that was passed over, and its sender does not say.
    fn is_in_doubt(&self, held: &Held) -> bool {
        let is_doubtful = self.vector.unheard(held.arrival.from).is_some();
        is_doubtful && self.age(held) >= LONGEST_SILENCE
    }

    /// Delivers all messages without open dependencies.
    pub(super) fn hand_out_ready(&mut self, robot: &mut Robot<'_>) {
        loop {
            let mut firsts = self
                .held
                .iter()
                .filter_map(|(&from, held)| Some((from, held.front()?)));
            let ready =
                firsts.find(|(_, held)| self.missing(held).is_none() || self.is_in_doubt(held));
            let Some((from, _)) = ready else {
                return;
            };
            self.hand_out(robot, from);
        }
    }

    /// A sender's first message waits no longer, or another one that is held and that it waits for does not.
    pub(super) fn force(&mut self, robot: &mut Robot<'_>, from: RobotId) {
        let mut next = from;
        // Each step leads to a message before the last; more steps than senders are a circle, which no
        // true messages make.
        for _ in 0..self.held.len() {
            let Some(held) = self.held.get(&next).and_then(|held| held.front()) else {
                return;
            };
            let mut all = held.after.iter().map(|need| &need.after);
            let Some(before) = all.find(|after| self.is_held(after)) else {
                break;
            };
            next = before.process.robot;
        }
        self.hand_out(robot, next);
        self.hand_out_ready(robot);
    }

    /// Delivers a sender's first message; messages before it that have not arrived are skipped. If it may be from a life
    /// before one that was passed over, it is passed over too.
    fn hand_out(&mut self, robot: &mut Robot<'_>, from: RobotId) {
        let is_doubtful = self.vector.unheard(from).is_some();
        let Some(held) = self.held.get_mut(&from).and_then(|held| held.pop_front()) else {
            return;
        };
        if self.held.get(&from).is_some_and(|held| held.is_empty()) {
            self.held.remove(&from);
        }
        self.count -= 1;
        if is_doubtful {
            return self.pass_over(robot, &held.itself());
        }
        for need in &held.after {
            self.pass_over(robot, need);
        }
        let port = self.channel.port;
        let process = held.process();
        let Held { arrival, .. } = held;
        let (from, message) = arrival.numbered();
        let taken = match self.vector.standing(process) {
            Standing::Present(life) => life.taken,
            Standing::Over(taken) => taken,
            Standing::Unknown(passed) => passed.unwrap_or(0),
        };
        if arrival.number <= taken {
            return robot.report(port, BroadcastEvent::Late { from, message });
        }
        let present = self.vector.present(from);
        match present.filter(|life| life.incarnation == process.incarnation) {
            Some(life) => (life.taken, life.is_joined) = (arrival.number, true),
            // It was held back when a later life was heard.
            None => self.vector.end(process, arrival.number),
        }
        robot.report(
            port,
            BroadcastEvent::from(TransferEvent::Deliver { from, message }),
        );
        robot.deliver(arrival.from, port, arrival.content);
    }

    /// Passes over the messages of a sender that are held and may be from a life before the one of this rank, since
    /// something of that life was passed over: they are too late.
    pub(super) fn give_up_earlier(&mut self, robot: &mut Robot<'_>, from: RobotId, rank: Rank) {
        let Some(held) = self.held.remove(&from) else {
            return;
        };
        // A held life that is not known any more is older than those that are.
        let is_earlier = |held: &Held| self.vector.rank(held.process()) < Some(rank);
        let (earlier, rest): (VecDeque<Held>, VecDeque<Held>) =
            held.into_iter().partition(is_earlier);
        self.count -= earlier.len();
        if !rest.is_empty() {
            self.held.insert(from, rest);
        }
        for held in earlier {
            self.pass_over(robot, &held.itself());
        }
    }

    /// Stops waiting for a message; that is on record if it was missed.
    fn pass_over(&mut self, robot: &mut Robot<'_>, need: &Need) {
        let After { process, number } = need.after;
        let from = process.robot;
        let is_missed = match self.vector.standing(process) {
            Standing::Present(life) => life.taken < number,
            Standing::Over(taken) => taken < number,
            Standing::Unknown(passed) => passed.is_none_or(|passed| passed < number),
        };
        if !is_missed {
            return;
        }
        // If it is unknown which life is later, those that are held wait for the sender's answer instead.
        let rank = self.vector.rank(process);
        let rank = rank.or(need.is_over.then_some(Rank::Unheard));
        if number > 0
            && let Some(rank) = rank
        {
            self.give_up_earlier(robot, from, rank);
        }
        // A robot that joins late has not lost the messages that were sent before.
        let mut is_joined = self.vector.is_joined(from);
        match self.vector.standing(process) {
            Standing::Present(_) => {
                if let Some(life) = self.vector.present(from) {
                    life.taken = number;
                    is_joined = life.is_joined;
                }
            }
            Standing::Unknown(_) if !need.is_over => {
                self.vector.pass_over(process, number, self.arrivals);
            }
            Standing::Over(_) | Standing::Unknown(_) => self.vector.end(process, number),
        }
        if number == 0 {
            return;
        }
        let message = MessageNumber {
            number,
            incarnation: process.incarnation,
        };
        robot.report(
            self.channel.port,
            BroadcastEvent::PassOver { from, message },
        );
        if is_joined {
            self.gaps.push(Gap { from: Some(from) });
        }
    }
}
