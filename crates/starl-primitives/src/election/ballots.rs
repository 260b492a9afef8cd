//! Election by random ballots (thesis, section 3.4.2, which says no more than that).
//!
//! Each participant draws a number and tells it to all. Whoever has the ballots of all that take part in the
//! round knows the winner, the one with the greatest. Ties are drawn again, in the next round. Robots
//! that are suspected are not waited for, nor are those that stay silent for the options' patience.
//!
//! Invariant: whoever hears of two outcomes believes the greater one (later round, then greater ballot, then
//! greater robot), so robots that did not wait for the same ballots agree as soon as they hear of each
//! other's winner, who goes on saying that it leads.

use super::options::no_later;
use super::packet::{Outcome, Packet};
use super::rules::{Leadership, Rules, Scene};
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
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

/// An election under way.
#[derive(Clone, Debug)]
struct Draw {
    own: u32,
    /// The others'.
    ballots: BTreeMap<RobotId, u32>,
    /// When those that are missing are no longer waited for.
    until: Time,
    repeat_at: Time,
    repetitions: u32,
}

impl Ballots {
    fn begin(&mut self, scene: &mut Scene<'_, '_>, round: u64) {
        self.round = round;
        self.outcome = None;
        let now = scene.now();
        let own = scene.robot.random().below(scene.options.ballots.max(2));
        self.draw = Some(Draw {
            own,
            ballots: BTreeMap::new(),
            until: now + scene.options.patience,
            repeat_at: now + scene.options.timeout(0),
            repetitions: 0,
        });
        scene.tell_all(Packet::Ballot { round, ballot: own });
        self.decide(scene);
    }

    /// There is no leader any more, or none that this robot can believe in.
    fn lose(&mut self, scene: &mut Scene<'_, '_>) {
        self.outcome = None;
        if scene.stands {
            self.begin(scene, self.round + 1);
        }
    }

    /// Ends the election if nobody is waited for any more.
    fn decide(&mut self, scene: &mut Scene<'_, '_>) {
        let Some(draw) = &self.draw else { return };
        let is_missing = |peer: &&RobotId| draw.is_missing(scene, **peer);
        if scene.others.iter().any(|peer| is_missing(&peer)) && scene.now() < draw.until {
            return;
        }
        let (me, round) = (scene.me(), self.round);
        let drawn = draw.ballots.iter().map(|(&peer, &ballot)| (ballot, peer));
        let drawn = drawn.filter(|&(_, peer)| !scene.is_suspected(peer));
        let drawn = drawn.chain([(draw.own, me)]);
        let (ballot, leader) = drawn.clone().max().unwrap_or((draw.own, me));
        if drawn.filter(|&(other, _)| other == ballot).count() > 1 {
            self.begin(scene, round + 1);
            return;
        }
        self.believe(
            scene,
            Outcome {
                round,
                ballot,
                leader,
            },
        );
        if leader == me {
            self.announce(scene);
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

    /// A robot says who was elected.
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

    /// The draw goes on: those that have not been heard are asked again.
    fn repeat(&mut self, scene: &mut Scene<'_, '_>) {
        let (now, round) = (scene.now(), self.round);
        let Some(draw) = &mut self.draw else { return };
        if now >= draw.repeat_at {
            draw.repetitions = draw.repetitions.saturating_add(1);
            draw.repeat_at = now + scene.options.timeout(draw.repetitions);
            let others = scene.others.iter().copied();
            let missing: Vec<RobotId> = others
                .filter(|&peer| draw.is_missing(scene, peer))
                .collect();
            let ballot = draw.own;
            scene.tell(&missing, Packet::Ballot { round, ballot });
        }
        self.decide(scene);
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
            let others = scene.others;
            draw.ballots.retain(|peer, _| others.contains(peer));
            no_later(&mut draw.until, now + options.patience);
            no_later(&mut draw.repeat_at, now + options.timeout(u32::MAX));
        }
        no_later(&mut self.due, now + options.patience.max(options.period()));
    }
}

impl Draw {
    fn is_missing(&self, scene: &Scene<'_, '_>, peer: RobotId) -> bool {
        !self.ballots.contains_key(&peer) && !scene.is_suspected(peer)
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

    fn leadership(&self, _: RobotId) -> Option<Leadership> {
        let leader = self.outcome?.leader;
        Some(Leadership {
            leader,
            epoch: None,
        })
    }

    fn corrupt(&mut self, random: &mut Random) {
        self.round = random_bits(random);
        self.due = Time(random_bits(random));
        if let Some(draw) = &mut self.draw {
            draw.own = random.bits();
            draw.ballots.retain(|_, _| random.chance(0.5));
            for ballot in draw.ballots.values_mut() {
                *ballot = random.bits();
            }
            draw.until = Time(random_bits(random));
            draw.repeat_at = Time(random_bits(random));
            draw.repetitions = random.bits();
        }
        self.outcome = random.chance(0.5).then(|| Outcome {
            round: self.round,
            ballot: random.bits(),
            leader: RobotId(random.below(8)),
        });
    }
}

/// A number of any size.
pub(super) fn random_bits(random: &mut Random) -> u64 {
    let bits = u64::from(random.bits()) << 32 | u64::from(random.bits());
    bits >> random.below(64)
}
