//! A way around links that are dead, in one direction or both.
//!
//! The leader reviews every few ticks how it and the other robots hear each other. A robot that asks for a leader all the
//! time, although the leader hears it, does not hear the leader: the messages of the leader to it also go to the
//! others, and some of them pass it on. Robots that the leader does not hear receive a message about it in the same way.
//! For a while their messages to the leader are passed on too.
//!
//! A datagram may arrive late and more than once in any case, so a receiver treats one that was passed on as if it came
//! directly. Only a leader and its members are connected like this: elections have a majority to choose from.

use super::packet::{Body, Said};
use super::{Role, Total};
use alloc::boxed::Box;
use alloc::vec::Vec;
use starl_core::{Destination, Robot, RobotId};

/// A leader reviews its links every so many ticks.
const PERIOD: u32 = 8;

/// After so many reviews it is tried again whether a robot hears the leader.
const LONG: u32 = 75;

/// A robot that the leader does not hear has what it says passed on for so many ticks.
const DETOUR: u32 = 3 * PERIOD;

/// About so many robots pass a datagram on.
const RELAYS: u32 = 3;

/// How a leader and another robot hear each other.
#[derive(Clone, Debug, Default)]
pub(super) struct Link {
    /// Since the last review the leader has heard the robot itself.
    is_heard: bool,
    /// Since then the robot has asked for a leader; or has answered what the leader said to it.
    asks: bool,
    answers: bool,
    /// The leader did not hear it before the last review.
    is_unheard: bool,
    /// For so many reviews the robot counts as one that does not hear the leader.
    deaf_for: u32,
}

impl Link {
    fn review(&mut self) {
        self.is_unheard = !self.is_heard;
        self.deaf_for = match self.asks && !self.answers {
            true => LONG,
            false => self.deaf_for.saturating_sub(1),
        };
        (self.is_heard, self.asks, self.answers) = (false, false, false);
    }
}

/// The leader to which what this robot says is passed on, and for how many ticks.
#[derive(Clone, Debug)]
pub(super) struct Detour {
    to: RobotId,
    left: u32,
}

impl Total {
    fn link(&mut self, to: RobotId) -> Option<&mut Link> {
        match &mut self.member.as_mut()?.role {
            Role::Leading(leading) => Some(leading.links.entry(to).or_default()),
            _ => None,
        }
    }

    /// A datagram has come from a robot itself.
    pub(super) fn note_heard(&mut self, from: RobotId) {
        if let Some(link) = self.link(from) {
            link.is_heard = true;
        }
    }

    /// A robot says something that shows whether it hears its leader.
    pub(super) fn note_signs(&mut self, from: RobotId, body: &Body) {
        if let Some(link) = self.link(from) {
            match body {
                Body::Ask { .. } | Body::Hello { answer: None, .. } => link.asks = true,
                Body::Taken { .. } => link.answers = true,
                _ => {}
            }
        }
    }

    /// A leader's tick: it is time to review the links.
    pub(super) fn review_links(&mut self, robot: &mut Robot<'_>) {
        let Some(member) = &mut self.member else {
            return;
        };
        let Role::Leading(leading) = &mut member.role else {
            return;
        };
        if leading.age % PERIOD != 0 {
            return;
        }
        let me = robot.id();
        let mut unheard = Vec::new();
        for &other in robot.fleet().iter().filter(|other| **other != me) {
            let link = leading.links.entry(other).or_default();
            link.review();
            if link.is_unheard {
                unheard.push(other);
            }
        }
        if !unheard.is_empty() {
            let said = self.said(robot, Body::Unheard);
            self.ask_to_pass_on(robot, unheard, said);
        }
    }

    /// The leader does not hear this robot.
    pub(super) fn take_detour(&mut self, leader: RobotId) {
        self.detour = Some(Detour {
            to: leader,
            left: DETOUR,
        });
    }

    /// A tick has passed.
    pub(super) fn end_detour(&mut self) {
        if let Some(detour) = &mut self.detour {
            detour.left = detour.left.saturating_sub(1);
            if detour.left == 0 {
                self.detour = None;
            }
        }
    }

    /// Has a message passed on to its receivers that may not have heard it.
    pub(super) fn relay(&mut self, robot: &mut Robot<'_>, to: Destination, said: Said) {
        let mut missed = Vec::new();
        if let Some(detour) = &self.detour {
            missed.push(detour.to);
        }
        if let Some(member) = &self.member
            && let Role::Leading(leading) = &member.role
        {
            let links = leading.links.iter();
            let may_miss =
                |link: &Link| link.deaf_for > 0 || link.is_unheard && to != Destination::All;
            missed.extend(links.filter(|(_, link)| may_miss(link)).map(|(id, _)| *id));
        }
        if let Destination::Robot(to) = to {
            missed.retain(|missed| *missed == to);
        }
        if !missed.is_empty() {
            self.ask_to_pass_on(robot, missed, said);
        }
    }

    fn ask_to_pass_on(&mut self, robot: &mut Robot<'_>, to: Vec<RobotId>, said: Said) {
        let relay = Said {
            life: said.life,
            generation: said.generation,
            body: Body::Relay {
                from: robot.id(),
                to,
                said: Box::new(said),
            },
        };
        robot.transmit(Destination::All, self.port, &relay);
    }

    /// Passes on what one robot says to others, or takes it if it is for this one.
    pub(super) fn pass_on(
        &mut self,
        robot: &mut Robot<'_>,
        sender: RobotId,
        from: RobotId,
        to: &[RobotId],
        said: Said,
    ) {
        let me = robot.id();
        let fleet = robot.fleet().len() as u32;
        if sender == from && robot.random().below(fleet.max(1)) < RELAYS {
            let is_other = |to: &&RobotId| **to != from && robot.is_peer(**to);
            let others: Vec<RobotId> = to.iter().filter(is_other).copied().collect();
            for other in others {
                let relay = Said {
                    life: self.life(robot).name,
                    generation: None,
                    body: Body::Relay {
                        from,
                        to: Vec::from([other]),
                        said: Box::new(said.clone()),
                    },
                };
                robot.transmit(Destination::Robot(other), self.port, &relay);
            }
        }
        if to.contains(&me) && !matches!(said.body, Body::Relay { .. }) {
            self.hear(robot, from, said);
        }
    }
}
