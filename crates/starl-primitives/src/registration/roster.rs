//! The known participants, and the one that computes the list.
//!
//! A robot's own announcement overrides reports of others, and a ticket that is over never returns. The
//! coordinator of the shown list makes the next one, so that a newcomer does not take over. Of several, and
//! if there is none, it is the robot with the least number.

use super::packet::{Packet, Roll, ViewId};
use super::ticket::Ticket;
use super::{Registration, Stage};
use alloc::vec::Vec;
use starl_core::{Destination, Duration, Robot, RobotId, Time};

/// Another participant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Peer {
    pub ticket: Ticket,
    /// The coordinator of the last list that it was known to show.
    pub led_by: Option<RobotId>,
    /// Whether it has shown that it hears this robot, since this one last gained or lost a list.
    pub hears: bool,
}

/// A robot that did not answer: it is not asked again for a while, so that one that is heard but cannot
/// hear does not keep the others from agreeing.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shunned {
    pub until: Time,
    pub times: u32,
}

/// The time for which a robot is left out doubles so often.
const MOST_DOUBLINGS: u32 = 4;

impl Registration {
    /// The robots for the list, as known to this robot: itself, those in the present list, and as many others as fit.
    pub(super) fn wanted(&self, robot: &Robot<'_>) -> Roll {
        let most = self.options.most_members.max(1) as usize;
        let mut wanted = Roll::new();
        if let Some(own) = &self.own {
            wanted.insert(robot.id(), own.ticket);
        }
        let old = |peer: &RobotId| match &self.stage {
            Stage::Agreed { members, .. } => members.contains(peer),
            _ => false,
        };
        for is_old in [true, false] {
            let peers = self.peers.iter().filter(|(peer, _)| self.counts(**peer));
            for (&peer, known) in peers.filter(|(peer, _)| old(peer) == is_old) {
                if wanted.len() < most {
                    wanted.insert(peer, known.ticket);
                }
            }
        }
        wanted
    }

    /// Whether a robot is known to take part and not believed to have failed.
    pub(super) fn counts(&self, peer: RobotId) -> bool {
        self.peers.contains_key(&peer) && !self.suspects.contains(&peer)
    }

    /// The robot that computes the list.
    pub(super) fn leader(&self, me: RobotId) -> RobotId {
        let takes_part = |robot: &RobotId| *robot == me || self.counts(*robot);
        let counted = || self.peers.iter().filter(|(peer, _)| self.counts(**peer));
        let mine = self.view_id().map(|id| id.coordinator);
        let theirs = counted().filter_map(|(_, peer)| peer.led_by);
        let established = theirs.chain(mine).filter(takes_part).min();
        established.unwrap_or_else(|| counted().map(|(&peer, _)| peer).min().unwrap_or(me).min(me))
    }

    /// A robot announces that it participates. Returns whether that is new.
    pub(super) fn meet(
        &mut self,
        robot: &Robot<'_>,
        peer: RobotId,
        ticket: Ticket,
        led_by: Option<RobotId>,
    ) -> bool {
        let (now, longest) = (robot.now(), self.longest_shunned());
        let shunned = self.shunned.get(&peer);
        let is_shunned =
            shunned.is_some_and(|shunned| now < shunned.until && shunned.until <= now + longest);
        if is_shunned || self.past.is_over(peer, ticket) {
            return false;
        }
        self.past.begins(peer, ticket);
        let before = self.peers.get(&peer);
        let before = before.filter(|before| before.ticket == ticket);
        let (is_news, hears) = (before.is_none(), before.is_some_and(|before| before.hears));
        let known = Peer {
            ticket,
            led_by,
            hears,
        };
        self.peers.insert(peer, known);
        is_news
    }

    /// Others report participants. Returns whether this is new.
    pub(super) fn hear_of(&mut self, robot: &Robot<'_>, roll: &Roll) -> bool {
        let mut is_news = false;
        for (&peer, &ticket) in roll {
            let is_known = peer == robot.id() || self.peers.contains_key(&peer);
            if !is_known && robot.fleet().binary_search(&peer).is_ok() {
                is_news |= self.meet(robot, peer, ticket, None);
            }
        }
        is_news
    }

    /// Those that take part and are not in this list; not more than a list may hold.
    pub(super) fn others_than(&self, roll: &Roll) -> Roll {
        let others = self.peers.iter().filter(|(peer, known)| {
            self.counts(**peer) && roll.get(peer).is_none_or(|ticket| *ticket != known.ticket)
        });
        let others = others.map(|(&peer, known)| (peer, known.ticket));
        others.take(self.options.most_members as usize).collect()
    }

    /// A robot no longer participates, as far as known.
    pub(super) fn drop_peer(&mut self, robot: &mut Robot<'_>, peer: RobotId) {
        self.peers.remove(&peer);
        for known in self.peers.values_mut() {
            // Its role as coordinator is over, even if it returns.
            known.led_by = known.led_by.filter(|leader| *leader != peer);
        }
        if self.own.is_none() {
            return;
        }
        match &self.stage {
            Stage::Open => self.look_within(robot, self.options.settle),
            Stage::Agreed { view, .. } if view.roll.contains_key(&peer) => {
                self.look_within(robot, self.options.settle);
            }
            Stage::Proposed { view, .. } if view.roll.contains_key(&peer) => {
                self.open(robot, Duration::ZERO);
            }
            Stage::Accepted { view, .. } if view.id.coordinator == peer => {
                self.open(robot, self.options.settle);
            }
            _ => {}
        }
    }

    /// A robot did not answer.
    pub(super) fn shun(&mut self, robot: &Robot<'_>, peer: RobotId) {
        self.peers.remove(&peer);
        let times = self.shunned.get(&peer).map_or(0, |shunned| shunned.times);
        let span = self.longest_shunned() / (1 << MOST_DOUBLINGS.saturating_sub(times));
        let shunned = Shunned {
            until: robot.now() + span,
            times: times.saturating_add(1),
        };
        self.shunned.insert(peer, shunned);
    }

    /// Leaves out all robots together that do not show that they hear this one. To wait for each of them in turn takes
    /// longer than a robot is left out, and those that register meanwhile would be waited for as well.
    pub(super) fn shun_deaf(&mut self, robot: &mut Robot<'_>) {
        let deaf = self.peers.iter().filter(|(_, known)| !known.hears);
        let deaf: Vec<RobotId> = deaf.map(|(&peer, _)| peer).collect();
        for peer in deaf {
            self.shun(robot, peer);
        }
        self.open(robot, Duration::ZERO);
    }

    /// How long a robot is left out at most.
    fn longest_shunned(&self) -> Duration {
        self.options.longest_interval * (2 << MOST_DOUBLINGS)
    }

    /// A registration of another robot is over.
    pub(super) fn end(&mut self, robot: &mut Robot<'_>, peer: RobotId, ticket: Ticket) {
        self.past.ends(peer, ticket);
        if self
            .peers
            .get(&peer)
            .is_some_and(|known| known.ticket == ticket)
        {
            self.drop_peer(robot, peer);
        }
    }

    /// Informs one robot, or all, that a registration of this one is over.
    pub(super) fn deny(&self, robot: &mut Robot<'_>, to: Destination, ticket: Ticket) {
        robot.transmit(to, self.port, &Packet::Leave { ticket });
    }

    /// Announces that this robot has left, until the others know it or it was announced often enough.
    pub(super) fn say_farewell(&mut self, robot: &mut Robot<'_>) {
        let Some(leaving) = &mut self.leaving else {
            return;
        };
        let (ticket, repetitions) = (leaving.ticket, leaving.repetitions);
        leaving.repetitions = repetitions.saturating_add(1);
        self.deny(robot, Destination::All, ticket);
        if repetitions < self.options.repetitions {
            self.look_within(robot, self.options.timeout(repetitions));
        } else {
            self.leaving = None;
        }
    }

    /// Another robot takes this one's registration for over, which it is not.
    pub(super) fn register_anew(&mut self, robot: &mut Robot<'_>, ticket: Ticket) {
        if self.own.as_ref().is_none_or(|own| own.ticket != ticket) {
            return;
        }
        // Only numbers of another life are later than each number that a corruption may have set.
        self.renewals = self.renewals.wrapping_add(1);
        let ticket = self.draw_ticket(robot);
        if let Some(own) = &mut self.own {
            own.ticket = ticket;
        }
        self.open(robot, self.options.settle);
        self.begin_announcing(robot, true);
    }

    /// The others make a list without this robot, which has left.
    pub(super) fn is_gone(&mut self, robot: &mut Robot<'_>, id: ViewId, roll: &Roll) {
        if self.own.is_none() && id > self.promised && !roll.contains_key(&robot.id()) {
            self.leaving = None;
            self.rest(robot);
        }
    }
}
