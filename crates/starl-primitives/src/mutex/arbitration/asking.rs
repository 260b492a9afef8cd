//! The requesting side: request, repeat, enter, renew and release.

use super::super::Resources;
use super::super::common::{Alarm, Common};
use super::super::quorum::quorum;
use super::request::Enough;
use super::request::Request;
use super::{Arbitration, Post, is_lease};
use crate::incarnation::Incarnation;
use alloc::collections::BTreeSet;
use starl_core::{Duration, Robot, RobotId};

/// A robot renews what it holds when less than one part in so many of a lease is left.
const RENEWED: u64 = 2;
/// Until the renewal has come it asks again after one part in so many of a lease.
const RENEWALS: u64 = 8;
/// How many repetitions of a request at least, so that what was granted late is known to be recent.
const REPETITIONS: u64 = 3;
/// A robot stops trusting a lease this long before its end: timers are no more precise.
const MARGIN: Duration = Duration::from_millis(1);

/// The time to the next renewal where so much of a lease is left.
fn renewal(left: Duration, belief: Duration) -> Duration {
    let early = left - belief / RENEWED;
    let after = match early {
        Duration::ZERO => (belief / RENEWALS).min(left - MARGIN),
        early => early,
    };
    after.max(MARGIN)
}

impl Arbitration {
    /// A request that waits for robots that are suspected tries a quorum without them.
    pub fn avoid_suspects(&mut self, common: &mut Common, robot: &mut Robot<'_>) {
        if is_lease(common) {
            return;
        }
        let waiting = self.request.as_ref().filter(|request| !request.is_entered);
        if let Some(request) = waiting
            && request
                .arbiters()
                .any(|peer| common.suspects.contains(&peer))
            && quorum(&self.everyone, robot.id(), &common.suspects).is_some()
        {
            let (clock, resources) = (request.clock, request.resources.clone());
            self.give_back(common, robot);
            self.make_request(common, robot, clock, resources);
        }
    }

    /// Whether this robot may hear from enough robots for a lease. One that does not would keep the grants of those that
    /// it hears.
    fn trusts_majority(&self, common: &Common) -> bool {
        let is_suspected = |peer: &&RobotId| common.suspects.contains(peer);
        let suspected = self.everyone.iter().filter(is_suspected).count();
        suspected < self.everyone.len().div_ceil(2)
    }

    /// The participants have changed: grants of the old ones do not count among the new ones.
    pub(super) fn change_list(&mut self, common: &mut Common, robot: &mut Robot<'_>) {
        let Some(request) = self.request.take() else {
            return;
        };
        let (clock, resources) = (request.clock, request.resources.clone());
        if !request.is_entered {
            return self.make_request(common, robot, clock, resources);
        }
        // All arbiters receive the set that is held, and a message when it is released.
        self.request = Some(request.of_others(&self.everyone, self.list));
    }

    pub(super) fn make_request(
        &mut self,
        common: &mut Common,
        robot: &mut Robot<'_>,
        clock: u64,
        resources: Resources,
    ) {
        let arbiters = match is_lease(common) {
            true => self.everyone.clone(),
            false => quorum(&self.everyone, robot.id(), &common.suspects)
                .or_else(|| quorum(&self.everyone, robot.id(), &BTreeSet::new()))
                .unwrap_or_default(),
        };
        let id = common.next_id(robot);
        self.request = Some(Request::new(id, clock, resources, self.list, arbiters));
        self.repeat(common, robot);
    }

    /// Sends the request, repeats it, or renews the lease.
    pub(super) fn repeat(&mut self, common: &mut Common, robot: &mut Robot<'_>) {
        let (now, enough) = (robot.now(), self.enough(common));
        let is_hopeless = !self.trusts_majority(common);
        let mut post = Post::default();
        let Some(request) = &mut self.request else {
            return;
        };
        let mut after = common.options.timeout(request.repetitions);
        if let Enough::Majority(majority, belief) = enough {
            after = after.min(belief / REPETITIONS);
            if is_hopeless && !request.is_entered {
                return robot.set_timer(common.timer(Alarm::Repeat), after);
            }
            if request.is_entered {
                let until = request.held_until(now, majority, belief);
                if until <= now + MARGIN {
                    common.report_expired(robot, &common.held);
                    common.held.clear();
                    return self.give_back(common, robot);
                }
                let left = until.since(now);
                after = renewal(left, belief);
                if left > belief / RENEWED {
                    return robot.set_timer(common.timer(Alarm::Repeat), after);
                }
            }
        } else if request.is_entered {
            return;
        }
        if !request.is_entered && request.may_enter(now, enough, common, &mut post).is_some() {
            // It would have entered long ago: a fault invented these grants.
            request.try_all_anew(common, &mut post);
        }
        request.ask(now, enough, common, &mut post);
        request.is_hopeful = false;
        request.repetitions = request.repetitions.saturating_add(1);
        robot.set_timer(common.timer(Alarm::Repeat), after);
        self.deliver(common, robot, post);
    }

    /// Releases everything granted.
    pub(super) fn give_back(&mut self, common: &mut Common, robot: &mut Robot<'_>) {
        let mut post = Post::default();
        if let Some(request) = self.request.take() {
            robot.cancel_timer(common.timer(Alarm::Repeat));
            for arbiter in request.arbiters() {
                post.send(arbiter, request.release(Resources::new()));
            }
        }
        self.deliver(common, robot, post);
    }

    /// Enters if it may.
    pub(super) fn go_on(&mut self, common: &mut Common, robot: &mut Robot<'_>, post: &mut Post) {
        let (now, enough) = (robot.now(), self.enough(common));
        let Some(request) = &mut self.request else {
            return;
        };
        if request.is_entered {
            return;
        }
        let Some((number, until)) = request.may_enter(now, enough, common, post) else {
            if request.is_hopeful && request.repetitions > 1 {
                // Its turn has come, and what is missing may have been lost.
                request.repetitions = 1;
                robot.set_timer(common.timer(Alarm::Repeat), common.options.timeout(0));
            }
            return;
        };
        request.is_entered = true;
        request.number = number;
        common.held = request.resources.clone();
        match enough {
            Enough::All => {
                robot.cancel_timer(common.timer(Alarm::Repeat));
                common.report_entered(robot);
            }
            Enough::Majority(_, belief) => {
                let after = renewal(until.since(now), belief);
                robot.set_timer(common.timer(Alarm::Repeat), after);
                common.report_numbered(robot, number);
            }
        }
    }

    /// An arbiter knows a later request of this robot than it has made, which only a fault can cause: the
    /// robot restarts its numbers, as after a restart.
    pub(super) fn number_anew(
        &mut self,
        common: &mut Common,
        robot: &mut Robot<'_>,
        post: &mut Post,
    ) {
        let enough = self.enough(common);
        let Some(request) = &mut self.request else {
            return;
        };
        if request.is_entered {
            return;
        }
        common.incarnation = Incarnation::default();
        let id = common.next_id(robot);
        let renumbered = Request::new(
            id,
            request.clock,
            request.resources.clone(),
            request.list,
            request.arbiters().collect(),
        );
        *request = renumbered;
        request.ask(robot.now(), enough, common, post);
    }
}
