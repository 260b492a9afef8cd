//! The announcements of a robot, with their times and receivers.

use super::packet::Packet;
use super::{Barrier, GREATEST, Peer};
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use starl_core::event::BarrierEvent;
use starl_core::{Destination, Robot, RobotId};

impl Barrier {
    /// Announces this robot's generation to those that need it. While it waits it does so once it has
    /// heard all, because no robot can pass before. Before it has arrived, its later announcement is
    /// answer enough.
    pub(super) fn answer(&mut self, robot: &mut Robot<'_>) {
        let place = (self.generation, self.waits);
        if !self.has_come {
            return self.owed.clear();
        }
        if !self.waits {
            let peers = &self.peers;
            self.owed.retain(|peer| {
                let said = peers.get(peer).map(Peer::certain);
                said.is_some_and(|said| {
                    said.is_none_or(|said| (said.generation, said.waits) < place)
                })
            });
        } else if !self
            .others(robot)
            .all(|peer| self.peers.contains_key(&peer))
        {
            return;
        }
        match self.owed.first().copied() {
            None => {}
            Some(only) if self.owed.len() == 1 => self.say(robot, Some(only)),
            Some(_) => self.say(robot, None),
        }
    }

    /// Says how far this robot is, to one or to all.
    pub(super) fn say(&mut self, robot: &mut Robot<'_>, to: Option<RobotId>) {
        let addressed = |peer: RobotId| to.is_none_or(|only| only == peer);
        let needs_answer = |peer: RobotId, known: &Peer| {
            !self.knows || known.asks_anew || known.certain().is_none() || self.owed.contains(&peer)
        };
        let incarnation = self.incarnation.of(robot);
        let (mut heard, mut asks) = (BTreeMap::new(), BTreeMap::new());
        for (&peer, known) in self.peers.iter().filter(|(peer, _)| addressed(**peer)) {
            if needs_answer(peer, known) {
                heard.insert(peer, known.echo);
            }
            if let Some(token) = known.lives.asked().filter(|token| *token != incarnation) {
                asks.insert(peer, token);
            }
        }
        let packet = Packet {
            incarnation,
            generation: self.generation,
            waits: self.waits,
            knows: self.knows,
            heard,
            asks,
            missing: match self.waits {
                true => self.missing(robot),
                false => Vec::new(),
            },
            again: self.repetitions > 0,
        };
        let told = self.peers.iter_mut().filter(|(peer, _)| addressed(**peer));
        told.for_each(|(_, known)| known.is_told = true);
        match to {
            Some(peer) => {
                self.owed.remove(&peer);
                robot.transmit(Destination::Robot(peer), self.port, &packet);
            }
            None => {
                self.owed.clear();
                self.send_to_all(robot, &packet);
            }
        }
        if self.waits && self.due.is_none() {
            let timeout = self.options.timeout(self.repetitions);
            self.due = Some(robot.now() + timeout);
            robot.set_timer(self.timer(), timeout);
        }
    }

    /// To all participants: one by one where they are few of the fleet.
    fn send_to_all(&self, robot: &mut Robot<'_>, packet: &Packet) {
        if 2 * self.others(robot).count() > robot.peers().count() {
            return robot.transmit(Destination::All, self.port, packet);
        }
        for peer in self.others(robot) {
            robot.transmit(Destination::Robot(peer), self.port, packet);
        }
    }

    /// Says again that this robot waits, to those that it waits for.
    pub(super) fn say_again(&mut self, robot: &mut Robot<'_>) {
        self.due = None;
        if !self.waits {
            return;
        }
        self.repetitions = self.repetitions.saturating_add(1);
        match self.missing(robot)[..] {
            [only] => self.say(robot, Some(only)),
            _ => self.say(robot, None),
        }
        self.learn_generation(robot);
        self.pass_if_all_have_come(robot);
    }

    pub(super) fn report_waiting(&self, robot: &mut Robot<'_>) {
        let generation = self.generation;
        robot.report(self.port, BarrierEvent::Wait { generation });
    }

    /// Undoes what only a corruption of the state can have brought about.
    pub(super) fn set_right(&mut self, robot: &mut Robot<'_>) {
        let now = robot.now();
        let longest = self.options.longest_timeout.max(self.options.first_timeout) * 2;
        if self.generation == 0 || self.generation > GREATEST {
            self.generation = 1;
            self.ask_all(robot);
        }
        let is_off = |due| due + longest < now || now + longest < due;
        if self.waits && self.due.is_none_or(is_off) {
            self.say_again(robot);
        }
    }
}
