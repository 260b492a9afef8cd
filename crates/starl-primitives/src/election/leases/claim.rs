//! Being a candidate, and leading.
//!
//! Invariant: this robot leads until one term after it sent the latest claim that a majority, including
//! itself, has granted. A leadership that was given up is never resumed: each leadership has its own epoch.

use super::{Leases, Shown};
use crate::election::epoch::Epoch;
use crate::election::packet::{Claim, Packet};
use crate::election::rules::Scene;
use alloc::collections::{BTreeMap, VecDeque};
use alloc::vec::Vec;
use starl_core::{Duration, Random, RobotId, Time};

/// Claims that are remembered; those before are too old to lead by.
const MOST_CLAIMS: usize = 64;

/// A claim to an epoch, and the robots that have granted it.
#[derive(Clone, Debug)]
pub(super) struct Standing {
    pub epoch: Epoch,
    /// The numbers of the claims, and when they were sent.
    sent: VecDeque<(u32, Time)>,
    /// The number of the latest claim that each robot has granted.
    granted: BTreeMap<RobotId, u32>,
    pub repeat_at: Time,
    repetitions: u32,
}

impl Leases {
    /// Whether this robot would stand, in time. One that hears too few others to win may still be heard by them, and
    /// would take votes of which it never learns.
    pub(super) fn may_stand(&self, scene: &Scene<'_, '_>) -> bool {
        scene.stands && self.remembers() && self.shown.is_none() && scene.trusts_majority()
    }

    /// When it would.
    pub(super) fn may_stand_at(&self) -> Time {
        self.stand_at.max(self.promise.until)
    }

    /// Claims a new epoch.
    pub(super) fn stand(&mut self, scene: &mut Scene<'_, '_>) {
        let known = self.known.max(self.promise.epoch).max(self.latest);
        let epoch = Epoch::next(known, scene.now(), scene.me());
        self.notice_candidacy(scene, epoch);
        self.known = epoch;
        self.claim = Some(Standing {
            epoch,
            sent: VecDeque::new(),
            granted: BTreeMap::new(),
            repeat_at: Time::ZERO,
            repetitions: 0,
        });
        self.ask(scene);
    }

    /// Asks for votes, for the first time or again.
    pub(super) fn ask(&mut self, scene: &mut Scene<'_, '_>) {
        let now = scene.now();
        let Some(claim) = &mut self.claim else { return };
        let shown = self.shown.filter(|shown| shown.epoch == claim.epoch);
        let remaining = shown.map_or(Duration::ZERO, |shown| shown.until.since(now));
        let leads = !remaining.is_zero();
        self.number = self.number.wrapping_add(1);
        let oldest = now - scene.options.term();
        claim.sent.retain(|&(_, at)| at > oldest && at <= now);
        if claim.sent.len() == MOST_CLAIMS {
            claim.sent.pop_front();
        }
        claim.sent.push_back((self.number, now));
        claim.repeat_at = now
            + match leads {
                true => scene.options.period(),
                // Rarer claims would not find a majority within one term over a network that loses many.
                false => {
                    let timeout = scene.options.timeout(claim.repetitions);
                    timeout.min(scene.options.period())
                }
            };
        claim.repetitions = match leads {
            true => 0,
            false => claim.repetitions.saturating_add(1),
        };
        scene.tell_all(Packet::Claim(Claim {
            epoch: claim.epoch,
            number: self.number,
            remaining,
        }));
        self.count(scene);
    }

    /// A robot votes for this one.
    pub(super) fn granted(
        &mut self,
        scene: &mut Scene<'_, '_>,
        from: RobotId,
        epoch: Epoch,
        number: u32,
    ) {
        if let Some(claim) = &mut self.claim
            && claim.epoch == epoch
            && claim.sent.iter().any(|&(sent, _)| sent == number)
        {
            let latest = claim.granted.entry(from).or_insert(number);
            if number.wrapping_sub(*latest) as i32 > 0 {
                *latest = number;
            }
            self.count(scene);
        }
    }

    /// Leads as long as the votes allow.
    fn count(&mut self, scene: &mut Scene<'_, '_>) {
        let Some(claim) = &self.claim else { return };
        let (epoch, now) = (claim.epoch, scene.now());
        let Some(since) = claim.granted_since(scene.majority()) else {
            return;
        };
        let until = since + scene.options.term();
        if until <= now {
            return;
        }
        match &mut self.shown {
            Some(shown) if shown.epoch == epoch => shown.until = shown.until.max(until),
            _ => {
                self.shown = Some(Shown { epoch, until });
                self.candidacies = 0;
                self.latest = epoch;
                self.promise.epoch = self.promise.epoch.max(epoch);
                let remaining = until.since(now);
                if let Some(claim) = &mut self.claim {
                    claim.repeat_at = now + scene.options.period();
                }
                scene.tell_all(Packet::Lease { epoch, remaining });
            }
        }
    }

    /// A robot does not vote for this one, since it has promised this epoch.
    pub(super) fn refused(&mut self, scene: &mut Scene<'_, '_>, epoch: Epoch, promised: Epoch) {
        self.learn(promised);
        if promised <= epoch || self.claim.as_ref().is_none_or(|claim| claim.epoch != epoch) {
            // Either that robot is bound for a while, or this is about an earlier claim.
            return;
        }
        if self.leads(scene) {
            // It continues leading, in an epoch that the other can vote for.
            self.stand(scene);
        } else {
            self.give_up(scene);
        }
    }

    /// No longer asks for votes, and gives back those it has.
    pub(super) fn give_up(&mut self, scene: &mut Scene<'_, '_>) {
        if let Some(claim) = self.claim.take() {
            scene.tell_all(Packet::Void(claim.epoch));
            self.postpone(scene);
        }
    }
}

impl Standing {
    /// When the latest claim was sent that so many robots, this one included, have granted.
    fn granted_since(&self, majority: usize) -> Option<Time> {
        let times: Vec<Time> = self
            .granted
            .values()
            .filter_map(|&number| self.sent_at(number))
            .collect();
        let own = self.sent.back().map(|&(_, at)| at);
        let mut times: Vec<Time> = times.into_iter().chain(own).collect();
        times.sort_unstable_by(|one, other| other.cmp(one));
        times.get(majority - 1).copied()
    }

    fn sent_at(&self, number: u32) -> Option<Time> {
        let mut sent = self.sent.iter();
        sent.find(|&&(known, _)| known == number).map(|&(_, at)| at)
    }

    pub fn corrupt(&mut self, random: &mut Random) {
        self.epoch = Epoch::random(random);
        self.granted.retain(|_, _| random.chance(0.5));
        for (number, at) in &mut self.sent {
            *number = random.bits();
            *at = Time(Epoch::random(random).0);
        }
        for number in self.granted.values_mut() {
            *number = self.sent.front().map_or(0, |&(number, _)| number);
        }
        self.repeat_at = Time(Epoch::random(random).0);
        self.repetitions = random.bits();
    }
}
