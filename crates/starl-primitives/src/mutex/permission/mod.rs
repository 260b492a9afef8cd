//! Every other robot permits a request (Ricart and Agrawala 1981), with sets of resources as in the thesis.
//!
//! A request goes to all participants. Each permits it, or, if it holds or has earlier requested one of the same
//! resources, permits it after releasing them. A request that all have permitted is granted.
//!
//! Where it differs: requests are repeated until they are permitted, so it tolerates loss, duplication and
//! reordering without another protocol below. If a waiting robot permits a request of a restarted or
//! unknown robot, it asks that robot for permission again (an attempt of the same request): earlier
//! permissions are forgotten there, or were never asked for.
//!
//! Invariant: of two robots that wait for the same resource at most one has the other's permission.

mod packet;

use super::Resources;
use super::common::{Alarm, Common};
use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;
use packet::{Packet, Wish};
use starl_core::{Destination, Message, Random, Robot, RobotId};

/// The state of the algorithm.
#[derive(Clone, Debug, Default)]
pub(super) struct Permission {
    waiting: Option<Waiting>,
    /// The latest requests that are to be permitted later.
    deferred: BTreeMap<RobotId, Wish>,
    /// The incarnation of each robot that was permitted something.
    known: BTreeMap<RobotId, u32>,
}

/// A request that is not granted yet.
#[derive(Clone, Debug)]
struct Waiting {
    wish: Wish,
    /// Those whose permission is missing, and the first attempt that their answer may be to.
    missing: BTreeMap<RobotId, u32>,
    /// All that were asked.
    asked: BTreeSet<RobotId>,
    /// How often it was repeated.
    repetitions: u32,
}

impl Permission {
    pub fn acquire(&mut self, common: &mut Common, robot: &mut Robot<'_>, resources: Resources) {
        let (clock, id) = (common.tick(robot), common.next_id(robot));
        self.waiting = Some(Waiting {
            missing: common.others(robot).into_iter().map(|p| (p, 0)).collect(),
            asked: common.others(robot).into_iter().collect(),
            wish: Wish {
                id,
                attempt: 0,
                clock,
                resources,
            },
            repetitions: 0,
        });
        self.ask(common, robot);
        self.enter_if_permitted(common, robot);
    }

    /// The participants have changed: new ones are asked, and the request no longer waits for removed ones.
    pub fn ask_others(&mut self, common: &mut Common, robot: &mut Robot<'_>) {
        let others: BTreeSet<RobotId> = common.others(robot).into_iter().collect();
        let Some(waiting) = &mut self.waiting else {
            return;
        };
        if waiting.asked == others {
            return;
        }
        // A robot that was not asked may be missing because it has requested the same.
        let asked = &waiting.asked;
        let is_left = |peer: &RobotId| others.contains(peer) || !asked.contains(peer);
        waiting.missing.retain(|peer, _| is_left(peer));
        let new = others.difference(&waiting.asked).copied();
        let attempt = waiting.wish.attempt.wrapping_add(1);
        let missed = waiting.missing.len();
        waiting.missing.extend(new.map(|peer| (peer, attempt)));
        waiting.asked = others;
        if waiting.missing.len() > missed {
            waiting.wish.attempt = attempt;
            waiting.repetitions = 0;
            self.ask(common, robot);
        }
        self.enter_if_permitted(common, robot);
    }

    /// The requested resources.
    pub fn wanted(&self) -> Option<&Resources> {
        self.waiting.as_ref().map(|waiting| &waiting.wish.resources)
    }

    /// Whether a robot whose permission is missing is suspected.
    pub fn failed(&self, common: &Common) -> bool {
        let is_suspected = |peer: &RobotId| common.suspects.contains(peer);
        self.waiting
            .as_ref()
            .is_some_and(|waiting| waiting.missing.keys().any(is_suspected))
    }

    /// Forgets the request that is under way.
    pub fn withdraw(&mut self, common: &mut Common, robot: &mut Robot<'_>) {
        if self.waiting.take().is_some() {
            robot.cancel_timer(common.timer(Alarm::Repeat));
            self.permit_deferred(common, robot);
        }
    }

    /// Something is no longer held.
    pub fn released(&mut self, common: &mut Common, robot: &mut Robot<'_>) {
        self.permit_deferred(common, robot);
    }

    pub fn receive(&mut self, common: &mut Common, robot: &mut Robot<'_>, message: &Message) {
        match message.read::<Packet>() {
            Some(Packet::Request(wish)) => self.consider(common, robot, message.from, wish),
            Some(Packet::Permit { id, attempt }) => {
                if let Some(waiting) = &mut self.waiting
                    && waiting.wish.id == id
                    && waiting
                        .missing
                        .get(&message.from)
                        .is_some_and(|&first| first <= attempt)
                {
                    waiting.missing.remove(&message.from);
                    self.enter_if_permitted(common, robot);
                }
            }
            None => {}
        }
    }

    /// A robot is trusted again: it is asked at once.
    pub fn trusted(&mut self, common: &mut Common, robot: &mut Robot<'_>, peer: RobotId) {
        if let Some(waiting) = &self.waiting
            && waiting.missing.contains_key(&peer)
        {
            let request = Packet::Request(waiting.wish.clone());
            robot.transmit(Destination::Robot(peer), common.port, &request);
        }
    }

    /// Sends the request again.
    pub fn time_out(&mut self, common: &mut Common, robot: &mut Robot<'_>, alarm: Alarm) {
        if alarm != Alarm::Repeat {
            return;
        }
        if self.waiting.is_some() && !common.held.is_empty() {
            // A robot that holds something requests nothing, so a fault has invented what it holds.
            let made_up = core::mem::take(&mut common.held);
            common.report_expired(robot, &made_up);
            self.permit_deferred(common, robot);
        }
        let others = common.others(robot);
        if let Some(waiting) = &mut self.waiting
            && waiting.missing.is_empty()
        {
            // Only a corruption can have left a request that all have permitted.
            waiting.wish.attempt = waiting.wish.attempt.wrapping_add(1);
            let attempt = waiting.wish.attempt;
            waiting.missing = others.into_iter().map(|peer| (peer, attempt)).collect();
        }
        self.ask(common, robot);
    }

    /// Adds what this robot and others ask for.
    pub fn add_resources(&self, known: &mut Resources) {
        let waiting = self.waiting.iter().map(|waiting| &waiting.wish);
        for wish in waiting.chain(self.deferred.values()) {
            known.extend(wish.resources.iter().cloned());
        }
    }

    /// Overwrites the state at random; `some` are the resources that it requests afterwards.
    pub fn corrupt(&mut self, random: &mut Random, some: Resources) {
        self.deferred.retain(|_, _| random.chance(0.5));
        if let Some(waiting) = &mut self.waiting {
            waiting.wish.resources = some;
            waiting.missing.retain(|_, _| random.chance(0.5));
            waiting.wish.clock = u64::from(random.bits());
            waiting.repetitions = random.bits();
        }
    }

    /// Permits a request, or remembers to do so later.
    fn consider(&mut self, common: &mut Common, robot: &mut Robot<'_>, from: RobotId, wish: Wish) {
        if !common.hear(wish.clock) {
            return;
        }
        if self.comes_first(common, robot.id(), from, &wish) {
            self.deferred.insert(from, wish);
            return;
        }
        self.permit(common, robot, from, &wish);
    }

    /// Whether this robot is to have one of the resources before the other robot.
    fn comes_first(&self, common: &Common, me: RobotId, other: RobotId, wish: &Wish) -> bool {
        let waits_before = |waiting: &Waiting| {
            !waiting.wish.resources.is_disjoint(&wish.resources)
                && (waiting.wish.clock, me) < (wish.clock, other)
        };
        !common.held.is_disjoint(&wish.resources) || self.waiting.as_ref().is_some_and(waits_before)
    }

    fn permit(&mut self, common: &Common, robot: &mut Robot<'_>, to: RobotId, wish: &Wish) {
        self.deferred.remove(&to);
        let incarnation = Some(wish.id.incarnation);
        let is_new = self.known.insert(to, wish.id.incarnation) != incarnation;
        let permit = Packet::Permit {
            id: wish.id,
            attempt: wish.attempt,
        };
        robot.transmit(Destination::Robot(to), common.port, &permit);
        let Some(waiting) = &mut self.waiting else {
            return;
        };
        // Of two that wait for the same one has the other's permission, never both. As long as both
        // remember what they permitted, their clocks see to that. One that is new may have forgotten, and
        // what it permitted before may still be on its way.
        let overlaps = !waiting.wish.resources.is_disjoint(&wish.resources);
        if is_new || overlaps && !waiting.missing.contains_key(&to) {
            waiting.wish.attempt = waiting.wish.attempt.wrapping_add(1);
            waiting.missing.insert(to, waiting.wish.attempt);
            let request = Packet::Request(waiting.wish.clone());
            robot.transmit(Destination::Robot(to), common.port, &request);
        }
    }

    fn permit_deferred(&mut self, common: &Common, robot: &mut Robot<'_>) {
        let me = robot.id();
        let free: Vec<(RobotId, Wish)> = self
            .deferred
            .iter()
            .filter(|&(&peer, wish)| !self.comes_first(common, me, peer, wish))
            .map(|(&peer, wish)| (peer, wish.clone()))
            .collect();
        for (peer, wish) in free {
            self.permit(common, robot, peer, &wish);
        }
    }

    fn enter_if_permitted(&mut self, common: &mut Common, robot: &mut Robot<'_>) {
        let is_permitted = |waiting: &mut Waiting| waiting.missing.is_empty();
        if let Some(waiting) = self.waiting.take_if(is_permitted) {
            common.held = waiting.wish.resources;
            robot.cancel_timer(common.timer(Alarm::Repeat));
            common.report_entered(robot);
        }
    }

    /// Sends the request to those whose permission is missing.
    fn ask(&mut self, common: &Common, robot: &mut Robot<'_>) {
        let Some(waiting) = &mut self.waiting else {
            return;
        };
        let request = Packet::Request(waiting.wish.clone());
        // Every receiver answers, so it goes to all only if most are asked.
        if 2 * waiting.missing.len() > robot.peers().count() {
            robot.transmit(Destination::All, common.port, &request);
        } else {
            for &peer in waiting.missing.keys() {
                robot.transmit(Destination::Robot(peer), common.port, &request);
            }
        }
        let timeout = common.options.timeout(waiting.repetitions);
        robot.set_timer(common.timer(Alarm::Repeat), timeout);
        waiting.repetitions = waiting.repetitions.saturating_add(1);
    }
}
