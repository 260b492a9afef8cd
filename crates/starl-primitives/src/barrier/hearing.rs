//! How a robot learns the next generation, and that all robots have arrived at it.
//!
//! Invariant: of robots that know their generation, none is more than one ahead of another that keeps its memory; and
//! only messages count that a robot has sent after it had heard of this robot's present life.
//!
//! A robot's announcement of its generation, once it knows it, stays true as long as a robot remembers it. So it
//! counts until another life is heard of. From then on the announcements of that life count, once it has proved to be
//! the later one (see [`Handshake`]). Of a life that does not know its generation yet only its questions count,
//! because it may have restarted and passed generations meanwhile. So a robot that learns its generation learns it
//! from all robots that could know more: a robot that has answered its life ignores its earlier lives.

use super::packet::Packet;
use super::{Barrier, GREATEST, Peer, Words};
use crate::handshake::Handshake;
use alloc::vec::Vec;
use starl_core::event::BarrierEvent;
use starl_core::{Message, Robot, RobotId};

impl Barrier {
    pub(super) fn receive(&mut self, robot: &mut Robot<'_>, message: &Message) {
        let from = message.from;
        let is_peer = robot.is_peer(from);
        let Some(said) = message.read::<Packet>().filter(|_| is_peer) else {
            return;
        };
        if said.generation == 0 || said.generation > GREATEST {
            return;
        }
        self.hear(robot, from, &said);
        self.learn_generation(robot);
        self.pass_if_all_have_come(robot);
        self.answer(robot);
    }

    /// Takes down what another robot says; never back within one life of it.
    fn hear(&mut self, robot: &mut Robot<'_>, from: RobotId, said: &Packet) {
        let me = robot.id();
        let mine = self.incarnation.of(robot);
        let peer = self.peers.entry(from).or_insert_with(|| Peer {
            lives: Handshake::asking(mine),
            echo: 0,
            asks_anew: false,
            is_told: false,
        });
        let asked = said.asks.get(&me).copied();
        (peer.echo, peer.asks_anew) = (asked.unwrap_or(said.incarnation), asked.is_some());
        if let Some(&token) = said.heard.get(&me) {
            peer.lives.begin(said.incarnation, token, Words::default);
        }
        if let Some(known) = peer.lives.of(said.incarnation) {
            let new = Words {
                generation: said.generation,
                waits: said.waits,
                knows: said.knows,
            };
            // Never back within a life, but a number that is far too great does not stay, e.g. after a corruption. A
            // robot that does not know its generation cannot tell that a number is too great.
            let is_absurd = self.knows && known.generation > self.generation + 1;
            if new.place() > known.place() || is_absurd {
                *known = new;
            }
        }
        let is_new = peer.lives.of(said.incarnation).is_none() && peer.lives.asked().is_none();
        if is_new {
            peer.lives.token(robot);
        }
        if is_new || said.missing.contains(&me) && (said.again || !peer.is_told) {
            self.owed.insert(from);
        } else if !said.missing.contains(&me) {
            self.owed.remove(&from);
        }
        // A robot that sends has not failed, unless the message was in transit for long.
        self.suspects.remove(&from);
    }

    /// The generation is certain when all have answered.
    pub(super) fn learn_generation(&mut self, robot: &mut Robot<'_>) {
        if self.knows {
            // No robot is two generations ahead of this one, because it would have waited.
            let next = self.generation + 1;
            let mut heard = self.peers.values().filter_map(Peer::certain);
            if heard.any(|said| said.generation > next) {
                self.ask_all(robot);
            }
            return;
        }
        if !self.waits {
            return;
        }
        let mut greatest = self.generation;
        for peer in self.others(robot) {
            match self.said(peer) {
                Some(said) => greatest = greatest.max(said.generation),
                None => return,
            }
        }
        self.knows = true;
        self.generation = greatest.min(GREATEST);
        self.move_on(robot);
        self.report_waiting(robot);
        // No robot counts this one's arrival before.
        self.say(robot, None);
    }

    /// Forgets the answers, and asks again.
    pub(super) fn ask_all(&mut self, robot: &mut Robot<'_>) {
        self.knows = false;
        self.peers.clear();
        self.owed.clear();
        self.incarnation.renew();
        self.repetitions = 0;
        if self.waits {
            self.say(robot, None);
        }
    }

    /// This robot is farther than it has told anyone.
    pub(super) fn move_on(&mut self, robot: &Robot<'_>) {
        let fleet = robot.fleet();
        self.peers
            .retain(|peer, _| fleet.binary_search(peer).is_ok());
        self.suspects
            .retain(|peer| fleet.binary_search(peer).is_ok());
        for peer in self.peers.values_mut() {
            peer.is_told = false;
        }
    }

    /// Whether a robot is known to have arrived at this robot's generation.
    pub(super) fn has_arrived(&self, peer: RobotId) -> bool {
        self.said(peer).is_some_and(|said| {
            said.knows && (said.generation, said.waits) >= (self.generation, true)
        })
    }

    /// The announcements of a robot's present life since it heard of this one's.
    fn said(&self, peer: RobotId) -> Option<&Words> {
        self.peers.get(&peer)?.said()
    }

    /// The other participants.
    pub(super) fn others<'a>(
        &'a self,
        robot: &Robot<'a>,
    ) -> impl Iterator<Item = RobotId> + use<'a> {
        robot.peers().filter(|peer| self.takes_part(*peer))
    }

    /// Whether this robot needs to hear from another: see [`Barrier::missing`].
    fn is_missing(&self, peer: RobotId) -> bool {
        match self.knows {
            true => !self.has_arrived(peer),
            false => self.said(peer).is_none(),
        }
    }

    /// The robots from which this robot needs a message: before it can pass, or before it knows its generation. Two
    /// robots that do not know their generation stop after they have answered each other, or they would answer for
    /// ever.
    pub(super) fn missing(&self, robot: &Robot<'_>) -> Vec<RobotId> {
        let others = self.others(robot);
        others.filter(|peer| self.is_missing(*peer)).collect()
    }

    pub(super) fn pass_if_all_have_come(&mut self, robot: &mut Robot<'_>) {
        if !self.waits || !self.knows {
            return;
        }
        let next = self.generation + 1;
        // A robot that has passed has seen that all have arrived.
        let has_passed = |peer: RobotId| {
            let said = self.said(peer);
            said.is_some_and(|said| said.knows && said.generation == next)
        };
        let is_missing = |peer: RobotId| self.is_missing(peer);
        if self.others(robot).any(is_missing) && !self.others(robot).any(has_passed) {
            return;
        }
        let pass = BarrierEvent::Pass {
            generation: self.generation,
            participants: self.all(robot).into_iter().collect(),
        };
        robot.report(self.port, pass);
        self.waits = false;
        self.generation = next;
        self.due = None;
        robot.cancel_timer(self.timer());
    }
}

impl Words {
    /// How far the robot is.
    fn place(&self) -> (u64, bool, bool) {
        (self.generation, self.waits, self.knows)
    }
}

impl Peer {
    /// The announcements of its present life since it heard of this robot's; none while another life of it is
    /// queried.
    pub(super) fn said(&self) -> Option<&Words> {
        self.lives.known().filter(|_| self.lives.asked().is_none())
    }

    /// The same, if it knows its generation.
    pub(super) fn certain(&self) -> Option<&Words> {
        self.said().filter(|said| said.knows)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Options;
    use super::*;
    use crate::alone::alone;
    use alloc::collections::BTreeMap;

    #[test]
    fn a_late_word_replaces_no_later_one_before_a_robot_knows_its_generation() {
        alone(|robot| {
            let mut barrier = Barrier::new("gate", None, Options::default());
            barrier.arrive(robot);
            let life = barrier.incarnation.of(robot);
            let said = |generation| Packet {
                incarnation: 7,
                generation,
                waits: true,
                knows: true,
                heard: BTreeMap::from([(robot.id(), life)]),
                asks: BTreeMap::new(),
                missing: Vec::new(),
                again: false,
            };
            let (late, latest) = (said(1), said(37));
            barrier.hear(robot, RobotId(1), &latest);
            barrier.hear(robot, RobotId(1), &late);
            let heard = barrier.said(RobotId(1)).map(|said| said.generation);
            assert_eq!(heard, Some(37));
        });
    }
}
