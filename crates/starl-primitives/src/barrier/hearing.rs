//! How a robot learns which generation comes next, and that all have come to it.
//!
//! Invariant: of robots that know their generation, none is more than one ahead of another that keeps its
//! memory; and what counts of a robot's words was said after it had heard of this robot's present life.
//!
//! Lives have no order, so a late message may be of any life. That does no harm: what a robot says it has come
//! to once it knows stays true for ever. Of one that does not know yet nothing counts but its questions, since
//! it may have restarted and passed generations meanwhile.

use super::packet::Packet;
use super::{Barrier, GREATEST, Peer};
use alloc::vec::Vec;
use starl_core::event::BarrierEvent;
use starl_core::{Message, Robot, RobotId};

impl Barrier {
    pub(super) fn receive(&mut self, robot: &mut Robot<'_>, message: &Message) {
        let from = message.from;
        let is_peer = from != robot.id() && robot.fleet().binary_search(&from).is_ok();
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
        let is_same = |known: &&mut Peer| known.incarnation == said.incarnation;
        let known = match self.peers.get_mut(&from).filter(is_same) {
            Some(known) => known,
            None => {
                let new = Peer {
                    incarnation: said.incarnation,
                    generation: 0,
                    waits: false,
                    knows: false,
                    has_heard: false,
                    is_told: false,
                };
                self.peers.insert(from, new);
                match self.peers.get_mut(&from) {
                    Some(known) => known,
                    None => return,
                }
            }
        };
        known.has_heard |= said.heard.get(&me) == Some(&mine);
        let is_later = (said.generation, said.waits, said.knows)
            > (known.generation, known.waits, known.knows);
        // A number that is far too great does not stay, e.g. after a corruption.
        if is_later || known.generation > self.generation + 1 {
            known.generation = said.generation;
            known.waits = said.waits;
            known.knows = said.knows;
        }
        if !said.missing.contains(&me) {
            self.owed.remove(&from);
        } else if said.again || !known.is_told {
            self.owed.insert(from);
        }
        // Who speaks has not failed, unless the message was long under way.
        self.suspects.remove(&from);
    }

    /// The generation is certain when all have answered.
    pub(super) fn learn_generation(&mut self, robot: &mut Robot<'_>) {
        if self.knows {
            // Nobody is two ahead of this robot, which they would have waited for.
            let next = self.generation + 1;
            let mut counted = self.peers.values().filter(|peer| peer.has_heard);
            if counted.any(|peer| peer.knows && peer.generation > next) {
                self.ask_all(robot);
            }
            return;
        }
        if !self.waits {
            return;
        }
        let mut greatest = self.generation;
        for peer in self.others(robot) {
            match self.peers.get(&peer).filter(|known| known.has_heard) {
                Some(known) => greatest = greatest.max(known.generation),
                None => return,
            }
        }
        self.knows = true;
        self.generation = greatest.min(GREATEST);
        self.move_on(robot);
        self.report_waiting(robot);
        // Nobody counts this robot's arrival before.
        self.say(robot, None);
    }

    /// Forgets what was heard, and asks anew.
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

    /// Whether a robot is known to have come to this robot's generation.
    pub(super) fn has_arrived(&self, peer: RobotId) -> bool {
        self.peers.get(&peer).is_some_and(|known| {
            let place = (known.generation, known.waits);
            known.has_heard && known.knows && place >= (self.generation, true)
        })
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
            false => !self.has_heard(peer),
        }
    }

    /// Those from whom this robot needs to hear: before it can pass, or first before it knows. Two that do not
    /// know and have answered each other have no more to say, or they would answer for ever.
    pub(super) fn missing(&self, robot: &Robot<'_>) -> Vec<RobotId> {
        let others = self.others(robot);
        others.filter(|peer| self.is_missing(*peer)).collect()
    }

    /// Whether a robot is known to have heard of this robot's present life.
    fn has_heard(&self, peer: RobotId) -> bool {
        let known = self.peers.get(&peer);
        known.is_some_and(|known| known.has_heard)
    }

    pub(super) fn pass_if_all_have_come(&mut self, robot: &mut Robot<'_>) {
        if !self.waits || !self.knows {
            return;
        }
        let next = self.generation + 1;
        // Who has passed has seen that all have come.
        let has_passed = |peer: RobotId| {
            let known = self.peers.get(&peer);
            known.is_some_and(|known| known.has_heard && known.knows && known.generation == next)
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
