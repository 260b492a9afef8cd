//! Election by random ballots (thesis, section 3.4.2, which gives no details).
//!
//! Each participant draws a number and sends it to all. A robot that has the ballots of all participants in
//! the round knows the winner, the one with the greatest. Ties are drawn again, in the next round. The
//! election does not wait for suspected robots, nor for those that are silent for the options' patience.
//!
//! Invariant: of two outcomes a robot accepts the greater one (later round, then greater ballot, then
//! greater robot). The winner announces itself repeatedly, so robots that did not wait for the same ballots
//! agree as soon as they hear of each other's winner.

mod draw;

use super::options::no_later;
use super::packet::{Outcome, Packet};
use super::rules::{Leadership, Rules, Scene};
use draw::Draw;
use starl_core::{Random, RobotId, Time};

/// Rounds beyond this come from a corruption.
const LAST_ROUND: u64 = 1 << 48;

/// See the [module](self).
#[derive(Clone, Debug, Default)]
pub(super) struct Ballots {
    /// The latest round that this robot knows of.
    round: u64,
    draw: Option<Draw>,
    outcome: Option<Outcome>,
    /// As leader: when to say so again. Else: when the leader has been silent for too long.
    due: Time,
}

impl Ballots {
    /// The leader is gone, or no longer acceptable to this robot.
    fn lose(&mut self, scene: &mut Scene<'_, '_>) {
        self.outcome = None;
        if scene.stands {
            self.begin(scene, self.round + 1);
        }
    }

    fn believe(&mut self, scene: &Scene<'_, '_>, outcome: Outcome) {
        self.round = outcome.round;
        self.outcome = Some(outcome);
        self.draw = None;
        self.due = scene.now() + scene.options.patience;
    }

    fn announce(&mut self, scene: &mut Scene<'_, '_>) {
        if let Some(outcome) = self.outcome {
            self.due = scene.now() + scene.options.period();
            scene.tell_all(Packet::Outcome(outcome));
        }
    }

    /// A ballot came.
    fn count(&mut self, scene: &mut Scene<'_, '_>, from: RobotId, round: u64, ballot: u32) {
        if round > self.round {
            self.outcome = None;
            if !scene.stands {
                self.round = round;
                return;
            }
            self.begin(scene, round);
        }
        match (self.outcome, &mut self.draw) {
            (Some(outcome), _) => scene.send(from, Packet::Outcome(outcome)),
            (None, Some(draw)) if round == self.round => {
                draw.ballots.insert(from, ballot);
                self.decide(scene);
            }
            (None, Some(draw)) => {
                let (round, ballot) = (self.round, draw.own);
                scene.send(from, Packet::Ballot { round, ballot });
            }
            (None, None) => {}
        }
    }

    /// A robot announces the winner.
    fn hear(&mut self, scene: &mut Scene<'_, '_>, from: RobotId, outcome: Outcome) {
        let (me, leader) = (scene.me(), outcome.leader);
        if leader == me && !scene.stands {
            scene.send(from, Packet::Resign);
            return;
        }
        if leader != me && leader != from && scene.is_suspected(leader)
            || leader != me && !scene.others.contains(&leader)
        {
            return;
        }
        if outcome.round < self.round
            && let Some(draw) = &self.draw
        {
            let (round, ballot) = (self.round, draw.own);
            scene.send(from, Packet::Ballot { round, ballot });
            return;
        }
        match self.outcome {
            Some(better) if better > outcome => {
                if from == leader {
                    scene.send(from, Packet::Outcome(better));
                }
            }
            Some(known) if known == outcome && from != leader => {}
            _ => self.believe(scene, outcome),
        }
        if leader == me {
            self.announce(scene);
        }
    }

    /// Makes sense of what a corruption may have left.
    fn make_plausible(&mut self, scene: &Scene<'_, '_>) {
        let (now, options) = (scene.now(), scene.options);
        if self.round > LAST_ROUND {
            (self.round, self.draw, self.outcome) = (0, None, None);
        }
        let me = scene.me();
        self.outcome.take_if(|outcome| {
            let leader = outcome.leader;
            outcome.round != self.round
                || if leader == me {
                    !scene.stands
                } else {
                    !scene.others.contains(&leader)
                }
        });
        if !scene.stands || self.outcome.is_some() {
            self.draw = None;
        }
        if let Some(draw) = &mut self.draw {
            draw.make_plausible(scene);
        }
        no_later(&mut self.due, now + options.patience.max(options.period()));
    }
}

impl Rules for Ballots {
    fn elect(&mut self, scene: &mut Scene<'_, '_>) {
        if self.draw.is_none() {
            let next = u64::from(self.outcome.is_some());
            self.begin(scene, (self.round + next).max(1));
        }
    }

    fn resign(&mut self, scene: &mut Scene<'_, '_>) {
        self.draw = None;
        let me = scene.me();
        if self.outcome.is_some_and(|outcome| outcome.leader == me) {
            self.outcome = None;
            scene.tell_all(Packet::Resign);
        }
    }

    fn receive(&mut self, scene: &mut Scene<'_, '_>, from: RobotId, packet: Packet) {
        match packet {
            Packet::Ballot { round, ballot } if round <= LAST_ROUND => {
                self.count(scene, from, round, ballot);
            }
            Packet::Outcome(outcome) if outcome.round <= LAST_ROUND => {
                self.hear(scene, from, outcome);
            }
            Packet::Resign if self.outcome.is_some_and(|outcome| outcome.leader == from) => {
                self.lose(scene);
            }
            _ => {}
        }
    }

    fn suspect(&mut self, scene: &mut Scene<'_, '_>, peer: RobotId) {
        if self.outcome.is_some_and(|outcome| outcome.leader == peer) {
            self.lose(scene);
        } else {
            self.decide(scene);
        }
    }

    fn settle(&mut self, scene: &mut Scene<'_, '_>) {
        self.make_plausible(scene);
        let me = scene.me();
        match self.outcome {
            Some(_) if scene.now() < self.due => {}
            Some(outcome) if outcome.leader == me => self.announce(scene),
            Some(_) => self.lose(scene),
            None if self.draw.is_some() => self.repeat(scene),
            None if scene.stands => self.begin(scene, self.round.max(1)),
            None => {}
        }
    }

    fn due(&self, _: &Scene<'_, '_>) -> Time {
        match (&self.draw, self.outcome) {
            (Some(draw), _) => draw.repeat_at.min(draw.until),
            (None, Some(_)) => self.due,
            (None, None) => Time::NEVER,
        }
    }

    fn ballot(&self) -> Option<(u64, u32)> {
        self.outcome.map(|outcome| (outcome.round, outcome.ballot))
    }

    fn leadership(&self, _: RobotId) -> Option<Leadership> {
        let leader = self.outcome?.leader;
        Some(Leadership {
            leader,
            epoch: None,
        })
    }

    fn corrupt(&mut self, random: &mut Random) {
        self.round = random.magnitude();
        self.due = Time(random.magnitude());
        if let Some(draw) = &mut self.draw {
            draw.corrupt(random);
        }
        self.outcome = random.chance(0.5).then(|| Outcome {
            round: self.round,
            ballot: random.bits(),
            leader: RobotId(random.below(8)),
        });
    }
}
