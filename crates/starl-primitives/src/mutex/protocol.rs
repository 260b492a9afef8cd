//! How robots come to agree on who has what: asking, permitting, entering.
//!
//! Invariant: of two robots that wait for the same resource at most one has the other's permission.

use super::packet::{Packet, Wish};
use super::{FURTHEST, Mutex, Waiting};
use alloc::vec::Vec;
use starl_core::{Destination, Message, Robot, RobotId};

impl Mutex {
    pub(super) fn receive(&mut self, robot: &mut Robot<'_>, message: &Message) {
        match message.read::<Packet>() {
            Some(Packet::Request(wish)) => self.consider(robot, message.from, wish),
            Some(Packet::Permit { id, attempt }) => {
                if let Some(waiting) = &mut self.waiting
                    && waiting.wish.id == id
                    && waiting
                        .missing
                        .get(&message.from)
                        .is_some_and(|&first| first <= attempt)
                {
                    waiting.missing.remove(&message.from);
                    self.enter_if_permitted(robot);
                }
            }
            None => {}
        }
    }

    /// Permits a request, or remembers to do so later.
    fn consider(&mut self, robot: &mut Robot<'_>, from: RobotId, wish: Wish) {
        if wish.clock > self.clock.saturating_add(FURTHEST) {
            return;
        }
        self.clock = self.clock.max(wish.clock);
        if self.comes_first(robot.id(), from, &wish) {
            self.deferred.insert(from, wish);
            return;
        }
        self.permit(robot, from, &wish);
    }

    /// Whether this robot is to have one of the resources before the other robot.
    fn comes_first(&self, me: RobotId, other: RobotId, wish: &Wish) -> bool {
        let waits_before = |waiting: &Waiting| {
            !waiting.wish.resources.is_disjoint(&wish.resources)
                && (waiting.wish.clock, me) < (wish.clock, other)
        };
        !self.held.is_disjoint(&wish.resources) || self.waiting.as_ref().is_some_and(waits_before)
    }

    fn permit(&mut self, robot: &mut Robot<'_>, to: RobotId, wish: &Wish) {
        self.deferred.remove(&to);
        let incarnation = Some(wish.id.incarnation);
        let is_new = self.known.insert(to, wish.id.incarnation) != incarnation;
        let permit = Packet::Permit {
            id: wish.id,
            attempt: wish.attempt,
        };
        robot.transmit(Destination::Robot(to), self.port, &permit);
        let Some(waiting) = &mut self.waiting else {
            return;
        };
        // Of two that wait for the same one has the other's permission, never both. As long as both
        // remember what they permitted, their clocks see to that. One that is new may have forgotten, and
        // what it permitted before may still be on its way.
        let overlaps = !waiting.wish.resources.is_disjoint(&wish.resources);
        if is_new || overlaps && !waiting.missing.contains_key(&to) {
            waiting.wish.attempt = waiting.wish.attempt.wrapping_add(1);
            waiting.missing.insert(to, waiting.wish.attempt);
            let request = Packet::Request(waiting.wish.clone());
            robot.transmit(Destination::Robot(to), self.port, &request);
        }
    }

    pub(super) fn permit_deferred(&mut self, robot: &mut Robot<'_>) {
        let me = robot.id();
        let free: Vec<(RobotId, Wish)> = self
            .deferred
            .iter()
            .filter(|&(&peer, wish)| !self.comes_first(me, peer, wish))
            .map(|(&peer, wish)| (peer, wish.clone()))
            .collect();
        for (peer, wish) in free {
            self.permit(robot, peer, &wish);
        }
    }

    pub(super) fn enter_if_permitted(&mut self, robot: &mut Robot<'_>) {
        let is_permitted = |waiting: &mut Waiting| waiting.missing.is_empty();
        if let Some(waiting) = self.waiting.take_if(is_permitted) {
            self.held = waiting.wish.resources;
            robot.cancel_timer(self.timer());
            self.report(robot, "enter", &self.held);
        }
    }

    /// All that are asked.
    pub(super) fn others(&self, robot: &Robot<'_>) -> impl Iterator<Item = RobotId> + use<> {
        let me = robot.id();
        let asked: Vec<RobotId> = match &self.participants {
            Some(participants) => participants.iter().copied().collect(),
            None => robot.fleet().to_vec(),
        };
        asked.into_iter().filter(move |&peer| peer != me)
    }

    /// Sends the request once more.
    pub(super) fn ask_again(&mut self, robot: &mut Robot<'_>) {
        let others = self.others(robot);
        if let Some(waiting) = &mut self.waiting
            && waiting.missing.is_empty()
        {
            // Only a corruption can have left a request that all have permitted.
            waiting.wish.attempt = waiting.wish.attempt.wrapping_add(1);
            waiting.missing = others.map(|peer| (peer, waiting.wish.attempt)).collect();
        }
        self.ask(robot);
    }

    /// Sends the request to those whose permission is missing.
    pub(super) fn ask(&mut self, robot: &mut Robot<'_>) {
        let timer = self.timer();
        let Some(waiting) = &mut self.waiting else {
            return;
        };
        let request = Packet::Request(waiting.wish.clone());
        // Whoever hears it answers, so it goes to all only if most are asked.
        if 2 * waiting.missing.len() > robot.peers().count() {
            robot.transmit(Destination::All, self.port, &request);
        } else {
            for &peer in waiting.missing.keys() {
                robot.transmit(Destination::Robot(peer), self.port, &request);
            }
        }
        robot.set_timer(timer, self.options.timeout(waiting.repetitions));
        waiting.repetitions = waiting.repetitions.saturating_add(1);
    }

    pub(super) fn withdraw(&mut self, robot: &mut Robot<'_>) {
        if let Some(waiting) = self.waiting.take() {
            robot.cancel_timer(self.timer());
            self.report(robot, "withdraw", &waiting.wish.resources);
            self.permit_deferred(robot);
        }
    }
}
