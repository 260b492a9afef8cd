//! Voting for others.
//!
//! Invariant: as long as a promise binds, this robot votes for no other robot, nor for itself.

use super::{Leases, Promise};
use crate::copies::is_copy;
use crate::election::epoch::Epoch;
use crate::election::packet::{Claim, Packet};
use crate::election::rules::Scene;
use starl_core::{Duration, RobotId, Time};

impl Leases {
    /// A robot asks for a vote.
    pub(super) fn consider(&mut self, scene: &mut Scene<'_, '_>, from: RobotId, claim: Claim) {
        let epoch = claim.epoch;
        if epoch == self.voided {
            return;
        }
        self.notice_candidacy(scene, epoch);
        self.learn(epoch);
        if !claim.remaining.is_zero() {
            self.follow(scene, epoch, claim.remaining, Some(claim.number));
        }
        if !scene.takes_part {
            return;
        }
        if let Some(promised) = self.objection(scene, epoch) {
            if promised < epoch {
                let remaining = Duration::ZERO;
                self.put_off = Some((from, Claim { remaining, ..claim }));
            }
            scene.send(from, Packet::Refuse { epoch, promised });
            return;
        }
        if !self.remembers() {
            return;
        }
        // Of two that stand at once the later epoch goes first.
        self.give_up(scene);
        self.bind(scene, &claim);
        self.put_off.take_if(|(_, other)| other.epoch <= epoch);
        let number = claim.number;
        scene.send(from, Packet::Grant { epoch, number });
    }

    /// Promises the vote. The rest of the pause before this robot's own candidacy begins when the promise ends:
    /// otherwise it would outbid a candidate that had to wait for the same promise.
    fn bind(&mut self, scene: &Scene<'_, '_>, claim: &Claim) {
        let &Claim { epoch, number, .. } = claim;
        if epoch == self.promise.epoch && is_copy(number, self.promise.number) {
            // A late copy: it would bind the voter to a leader that is gone.
            return;
        }
        let (now, before) = (scene.now(), self.promise.until);
        let until = now + scene.options.lease;
        self.stand_at = until + self.stand_at.since(before.max(now));
        self.promise = Promise {
            epoch,
            until,
            number,
        };
    }

    /// The epoch because of which this robot does not vote for another.
    fn objection(&self, scene: &Scene<'_, '_>, epoch: Epoch) -> Option<Epoch> {
        let promised = self.promise.epoch;
        let is_bound = scene.now() < self.promise.until && promised.leader() != epoch.leader();
        if epoch < promised || is_bound {
            return Some(promised);
        }
        if epoch < self.latest {
            return Some(self.latest);
        }
        let own = self.claim.as_ref().map(|claim| claim.epoch);
        own.filter(|&own| own > epoch || self.leads(scene))
    }

    /// The promise binds no longer: votes for the claim that it stood in the way of. If this were left to the
    /// next time that the claim is made, robots might stand against each other until then, one after the other
    /// and for ever, where every vote is needed.
    fn vote_at_last(&mut self, scene: &mut Scene<'_, '_>) {
        if let Some((from, claim)) = self.put_off.take() {
            self.consider(scene, from, claim);
        }
    }

    /// A robot no longer leads in this epoch, nor asks for votes for it.
    pub(super) fn released(&mut self, scene: &mut Scene<'_, '_>, epoch: Epoch) {
        self.learn(epoch);
        self.voided = epoch;
        if epoch == self.latest {
            self.over = epoch;
        }
        self.put_off.take_if(|(_, claim)| claim.epoch == epoch);
        if self.promise.epoch == epoch {
            self.promise.until = Time::ZERO;
            self.postpone(scene);
            self.vote_at_last(scene);
        }
        if self.shown.is_some_and(|shown| shown.epoch == epoch) {
            self.lose(scene);
        }
    }
}
