//! Election by the votes of a majority, for an epoch, for the time of a lease.
//!
//! A candidate claims a new epoch. A vote for it is a promise for the time of a lease: to vote for no other robot, and
//! never again for an earlier epoch. With the votes of a majority the robot leads, until one lease after it asked for
//! them; it asks for the same votes repeatedly, and leads as long as it gets them. Leases are those of Gray and
//! Cheriton (1989), votes those of Raft's terms (Ongaro and Ousterhout 2014) and of Paxos (Lamport 1998). Raft's
//! pre-vote is not needed: a candidate is refused while the leader's lease runs, and its epoch binds only robots that
//! voted for it.
//!
//! A robot without storage that restarts has forgotten its promises. `recovery.rs` describes how it gets its vote back,
//! and `saving.rs` the state of robots with storage.
//!
//! Guarantees and their assumptions:
//! - one leader in each epoch: no assumption, because the number names the leader (`epoch.rs`);
//! - at most one leader at the same true time: clocks keep to the options' drift;
//! - epochs grow from leader to leader: the same, and no majority loses its memory at once. If one does, clocks must
//!   differ by less than a lease.
//! - Suspicions of failure detectors do not matter for these. A robot that suspects a majority does not stand.

mod claim;
mod recovery;
mod saving;
mod vote;

use super::epoch::Epoch;
use super::options::no_later;
use super::packet::{Claim, Packet};
use super::rules::{Leadership, Rules, Scene};
use crate::copies::is_copy;
use claim::Standing;
use recovery::Stage;
use starl_core::{Duration, Port, Random, Robot, RobotId, Time};

/// See the [module](self).
#[derive(Clone, Debug, Default)]
pub(super) struct Leases {
    stage: Stage,
    /// When it started.
    up_since: Time,
    /// The last vote.
    promise: Promise,
    /// The latest epoch heard of.
    known: Epoch,
    /// The latest that was shown.
    latest: Epoch,
    /// The latest that its robot gave up.
    voided: Epoch,
    /// The latest that was shown and that its leader gave up.
    over: Epoch,
    /// The number of the last claim to the latest epoch that was shown.
    heard: u32,
    /// The latest claim that it did not vote for, since it was bound by a promise.
    put_off: Option<(RobotId, Claim)>,
    /// While this robot stands or leads.
    claim: Option<Standing>,
    /// Counts this robot's claims.
    number: u32,
    /// How many candidacies it has noticed since there was a leader; a majority of the participants at most.
    candidacies: u32,
    shown: Option<Shown>,
    /// It does not stand earlier.
    stand_at: Time,
    /// Whether the robot stood for election when it last looked.
    stood: bool,
    /// The stored values: the promised epoch, and the latest known one.
    saved: (Epoch, Epoch),
}

/// The promise of this robot.
#[derive(Clone, Copy, Debug, Default)]
struct Promise {
    /// It votes for no earlier epoch.
    epoch: Epoch,
    /// Until then for no other robot than the one of this epoch.
    until: Time,
    /// The number of the last claim for which it voted.
    number: u32,
}

/// The leader, as far as this robot knows; itself or another.
#[derive(Clone, Copy, Debug)]
struct Shown {
    epoch: Epoch,
    until: Time,
}

impl Leases {
    /// Whether this robot leads.
    fn leads(&self, scene: &Scene<'_, '_>) -> bool {
        let is_own = |shown: Shown| shown.epoch.leader() == scene.me() && scene.now() < shown.until;
        self.shown.is_some_and(is_own)
    }

    fn learn(&mut self, epoch: Epoch) {
        self.known = self.known.max(epoch);
    }

    /// A robot, possibly this one, stands in this epoch.
    fn notice_candidacy(&mut self, scene: &Scene<'_, '_>, epoch: Epoch) {
        if epoch > self.known && self.shown.is_none() {
            let most = scene.majority() as u32;
            self.candidacies = self.candidacies.saturating_add(1).min(most);
        }
    }

    /// Robots do not stand all at once, but within this time: on average the first of them does after a quarter of the
    /// time that an answer takes at most. Each candidacy after the first lengthens it by a lease, for which votes are
    /// bound. Otherwise candidates that miss each other's claims would outbid each other, possibly for ever.
    fn spread(&self, scene: &Scene<'_, '_>) -> Duration {
        let participants = scene.others.len() as u64 + 1;
        let further = u64::from(self.candidacies).saturating_sub(1);
        scene.options.timeout(0) * participants / 4 + scene.options.lease * further
    }

    fn postpone(&mut self, scene: &mut Scene<'_, '_>) {
        let pause = self.spread(scene).seconds() * scene.robot.random().uniform();
        self.stand_at = scene.now() + Duration::from_seconds_f64(pause);
    }

    /// A robot says that it leads, by a claim of this number, or first of all. A late copy does not count: it would
    /// show a leader that is gone, and put off the next election.
    fn follow(
        &mut self,
        scene: &mut Scene<'_, '_>,
        epoch: Epoch,
        remaining: Duration,
        number: Option<u32>,
    ) {
        let is_late = epoch == self.latest && number.is_none_or(|number| self.has_heard(number));
        let is_over = epoch == self.voided || epoch == self.over;
        if is_late || is_over || epoch < self.latest && scene.takes_part {
            return;
        }
        let until = scene.now() + remaining.min(scene.options.term());
        match &mut self.shown {
            Some(shown) if shown.epoch > epoch => return,
            Some(shown) if shown.epoch == epoch => shown.until = shown.until.max(until),
            _ => self.shown = Some(Shown { epoch, until }),
        }
        self.candidacies = 0;
        self.latest = epoch;
        self.heard = number.unwrap_or(0);
        self.give_up(scene);
    }

    /// Whether a claim to the latest epoch that was shown is no later than one that was heard.
    fn has_heard(&self, number: u32) -> bool {
        is_copy(number, self.heard)
    }

    /// There is no leader any more, as far as this robot knows.
    fn lose(&mut self, scene: &mut Scene<'_, '_>) {
        self.shown = None;
        self.postpone(scene);
    }

    /// Makes sense of what a corruption may have left.
    fn make_plausible(&mut self, scene: &Scene<'_, '_>) {
        let (now, options) = (scene.now(), scene.options);
        for epoch in [
            &mut self.promise.epoch,
            &mut self.known,
            &mut self.latest,
            &mut self.voided,
            &mut self.over,
        ] {
            if !epoch.is_plausible(now) {
                *epoch = Epoch::default();
            }
        }
        self.put_off.take_if(|(from, claim)| {
            !claim.epoch.is_plausible(now) || claim.epoch.leader() != *from
        });
        self.candidacies = self.candidacies.min(scene.majority() as u32);
        no_later(&mut self.up_since, now);
        no_later(&mut self.promise.until, now + options.lease);
        let spread = self.spread(scene);
        no_later(&mut self.stand_at, now.max(self.promise.until) + spread);
        let me = scene.me();
        self.shown.take_if(|shown| {
            let leader = shown.epoch.leader();
            !shown.epoch.is_plausible(now) || leader != me && !scene.others.contains(&leader)
        });
        if let Some(shown) = &mut self.shown {
            no_later(&mut shown.until, now + options.term());
        }
        self.claim.take_if(|claim| {
            no_later(&mut claim.repeat_at, now + options.timeout(u32::MAX));
            !claim.epoch.is_plausible(now) || claim.epoch.leader() != me || !scene.stands
        });
        // A leader asks for votes.
        let leads_without = |shown: &mut Shown| shown.epoch.leader() == me && self.claim.is_none();
        self.shown.take_if(leads_without);
    }
}

impl Rules for Leases {
    fn elect(&mut self, _: &mut Scene<'_, '_>) {}

    fn resign(&mut self, scene: &mut Scene<'_, '_>) {
        if self.leads(scene) {
            self.shown = None;
        }
        self.give_up(scene);
    }

    fn receive(&mut self, scene: &mut Scene<'_, '_>, from: RobotId, packet: Packet) {
        let now = scene.now();
        let is_senders = |epoch: Epoch| epoch.leader() == from && epoch.is_plausible(now);
        match packet {
            Packet::Claim(claim) if is_senders(claim.epoch) => self.consider(scene, from, claim),
            Packet::Grant { epoch, number } => self.granted(scene, from, epoch, number),
            Packet::Refuse { epoch, promised } if promised.is_plausible(now) => {
                self.refused(scene, epoch, promised);
            }
            Packet::Void(epoch) if is_senders(epoch) => self.released(scene, epoch),
            Packet::Lease { epoch, remaining } if is_senders(epoch) => {
                self.learn(epoch);
                self.follow(scene, epoch, remaining, None);
            }
            Packet::Ask { attempt, up_for } => self.remember(scene, from, attempt, up_for),
            Packet::Tell(memory) if memory.promised.is_plausible(now) => {
                self.told(scene, from, memory);
            }
            _ => {}
        }
    }

    fn suspect(&mut self, _: &mut Scene<'_, '_>, _: RobotId) {}

    fn settle(&mut self, scene: &mut Scene<'_, '_>) {
        self.make_plausible(scene);
        self.recover(scene);
        if scene.stands && !self.stood {
            self.candidacies = 0;
            self.postpone(scene);
        }
        self.stood = scene.stands;
        let now = scene.now();
        if self.shown.is_some_and(|shown| now >= shown.until) {
            let was_own = self
                .shown
                .is_some_and(|shown| shown.epoch.leader() == scene.me());
            self.lose(scene);
            if was_own {
                self.give_up(scene);
            }
        }
        if self.claim.is_some() && !self.leads(scene) && !scene.trusts_majority() {
            self.give_up(scene);
        }
        match &self.claim {
            Some(claim) if now >= claim.repeat_at => self.ask(scene),
            None if self.may_stand(scene) && now >= self.may_stand_at() => self.stand(scene),
            _ => {}
        }
    }

    fn due(&self, scene: &Scene<'_, '_>) -> Time {
        let shown = self.shown.map_or(Time::NEVER, |shown| shown.until);
        let own = match &self.claim {
            Some(claim) => claim.repeat_at,
            None if self.may_stand(scene) => self.may_stand_at(),
            None => Time::NEVER,
        };
        shown.min(own).min(self.recovery_due(scene))
    }

    fn recall(&mut self, scene: &mut Scene<'_, '_>) {
        self.take_up(scene);
    }

    fn save(&mut self, robot: &mut Robot<'_>, port: Port) {
        self.save_epochs(robot, port);
    }

    fn leadership(&self, _: RobotId) -> Option<Leadership> {
        let epoch = self.shown?.epoch;
        Some(Leadership {
            leader: epoch.leader(),
            epoch: Some(epoch.0),
        })
    }

    fn corrupt(&mut self, random: &mut Random) {
        let time = |random: &mut Random| Time(Epoch::random(random).0);
        self.stage.corrupt(random);
        self.promise = Promise {
            epoch: Epoch::random(random),
            until: time(random),
            number: random.bits(),
        };
        self.known = Epoch::random(random);
        self.latest = Epoch::random(random);
        self.voided = Epoch::random(random);
        self.over = Epoch::random(random);
        self.heard = random.bits();
        if let Some((_, claim)) = &mut self.put_off {
            (claim.epoch, claim.number) = (Epoch::random(random), random.bits());
        }
        self.number = random.bits();
        self.candidacies = random.bits();
        self.up_since = time(random);
        self.stand_at = time(random);
        if let Some(claim) = &mut self.claim {
            claim.corrupt(random);
        }
        self.shown = random.chance(0.5).then(|| Shown {
            epoch: Epoch::random(random),
            until: time(random),
        });
    }
}
