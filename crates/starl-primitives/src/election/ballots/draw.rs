//! An election by ballots under way: drawing, telling, asking again, deciding.

use super::Ballots;
use crate::election::options::no_later;
use crate::election::packet::{Outcome, Packet};
use crate::election::rules::Scene;
use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use starl_core::{Random, RobotId, Time};

/// An election under way.
#[derive(Clone, Debug)]
pub(super) struct Draw {
    pub own: u32,
    /// The others'.
    pub ballots: BTreeMap<RobotId, u32>,
    /// When those that are missing are no longer waited for.
    pub until: Time,
    pub repeat_at: Time,
    repetitions: u32,
}

impl Draw {
    fn is_missing(&self, scene: &Scene<'_, '_>, peer: RobotId) -> bool {
        !self.ballots.contains_key(&peer) && !scene.is_suspected(peer)
    }

    /// Repairs states that a corruption may have left.
    pub fn make_plausible(&mut self, scene: &Scene<'_, '_>) {
        let (now, options) = (scene.now(), scene.options);
        self.ballots.retain(|peer, _| scene.others.contains(peer));
        no_later(&mut self.until, now + options.patience);
        no_later(&mut self.repeat_at, now + options.timeout(u32::MAX));
    }

    pub fn corrupt(&mut self, random: &mut Random) {
        self.own = random.bits();
        self.ballots.retain(|_, _| random.chance(0.5));
        for ballot in self.ballots.values_mut() {
            *ballot = random.bits();
        }
        self.until = Time(random.magnitude());
        self.repeat_at = Time(random.magnitude());
        self.repetitions = random.bits();
    }
}

impl Ballots {
    /// Draws a ballot and sends it.
    pub(super) fn begin(&mut self, scene: &mut Scene<'_, '_>, round: u64) {
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

    /// Ends the election if no ballot is missing any more.
    pub(super) fn decide(&mut self, scene: &mut Scene<'_, '_>) {
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

    /// Continues the draw: asks silent robots again.
    pub(super) fn repeat(&mut self, scene: &mut Scene<'_, '_>) {
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
}
