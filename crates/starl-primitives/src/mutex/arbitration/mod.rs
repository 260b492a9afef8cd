//! Arbiters: a request is granted once enough of the participants have granted it, each as an arbiter for
//! itself. This is the shared code of quorums and leases; they differ in how many grants are enough, and
//! for how long.
//!
//! Every robot has both roles: it makes requests ([`request`]) and is an arbiter of others' requests
//! ([`arbiter`]). Messages to itself are not sent. The requesting robot repeats its request, and arbiters
//! repeat lost answers then, so arbiters need no timers.

mod arbiter;
mod asking;
mod enough;
mod entry;
mod packet;
mod post;
mod recalling;
mod recovery;
mod request;
mod saving;
mod standing;

use super::Resources;
use super::common::{Alarm, Common};
use super::lease::belief;
use super::options::Algorithm;

use alloc::vec::Vec;
use arbiter::Arbiter;
use entry::Terms;
use packet::{Behind, Packet};
use post::Post;
use recovery::Recovery;
use request::Enough;
use request::Request;

use starl_core::{Destination, Duration, Message, Random, Robot, RobotId};

/// Messages that a robot may send itself for one input; more would mean that it talks in a circle.
const MOST_LOCAL: usize = 256;

/// The state of the algorithm.
#[derive(Clone, Debug, Default)]
pub(super) struct Arbitration {
    request: Option<Request>,
    arbiter: Arbiter,
    recovery: Recovery,
    /// All participants, this robot too, and their hash; empty before the first input.
    everyone: Vec<RobotId>,
    list: u32,
    /// Stands for what is on storage; none if nothing is.
    saved: Option<u64>,
}

impl Arbitration {
    pub fn acquire(&mut self, common: &mut Common, robot: &mut Robot<'_>, resources: Resources) {
        self.look(common, robot);
        let clock = common.tick(robot);
        self.make_request(common, robot, clock, resources);
    }

    /// The requested resources.
    pub fn wanted(&self) -> Option<&Resources> {
        let waiting = self.request.as_ref().filter(|request| !request.is_entered);
        waiting.map(|request| &request.resources)
    }

    /// The fencing number of the held resources.
    pub fn fencing(&self, common: &Common) -> Option<u64> {
        let request = self.request.as_ref();
        let held = request.filter(|request| request.is_entered && is_lease(common));
        held.map(|request| request.number)
    }

    /// Whether a robot that is waited for is suspected.
    pub fn failed(&self, common: &Common) -> bool {
        let waiting = self.request.as_ref().filter(|request| !request.is_entered);
        waiting.is_some_and(|request| request.is_stuck(self.enough(common), common))
    }

    /// Forgets the request that is under way.
    pub fn withdraw(&mut self, common: &mut Common, robot: &mut Robot<'_>) {
        self.give_back(common, robot);
    }

    /// Something is no longer held.
    pub fn released(&mut self, common: &mut Common, robot: &mut Robot<'_>) {
        if common.held.is_empty() {
            return self.give_back(common, robot);
        }
        let mut post = Post::default();
        if let Some(request) = &self.request {
            for arbiter in request.arbiters() {
                post.send(arbiter, request.release(common.held.clone()));
            }
        }
        self.deliver(common, robot, post);
    }

    pub fn receive(&mut self, common: &mut Common, robot: &mut Robot<'_>, message: &Message) {
        self.look(common, robot);
        if let Some(packet) = message.read::<Packet>()
            && self.everyone.contains(&message.from)
        {
            let mut post = Post::default();
            self.take(common, robot, message.from, packet, &mut post);
            self.deliver(common, robot, post);
        }
    }

    pub fn time_out(&mut self, common: &mut Common, robot: &mut Robot<'_>, alarm: Alarm) {
        self.look(common, robot);
        match alarm {
            Alarm::Repeat => self.repeat(common, robot),
            Alarm::Recall => self.recall(common, robot),
        }
    }

    /// A robot is trusted again: it is asked at once, or in place of suspected ones.
    pub fn trusted(&mut self, common: &mut Common, robot: &mut Robot<'_>, peer: RobotId) {
        self.avoid_suspects(common, robot);
        let mut post = Post::default();
        if let Some(request) = &self.request
            && !request.is_entered
            && request.has_asked(peer)
        {
            post.send(peer, Packet::Request(request.wish(peer, common)));
        }
        self.deliver(common, robot, post);
    }

    /// Adds the resources that this robot requests, has granted, or is asked for.
    pub fn add_resources(&self, known: &mut Resources) {
        if let Some(request) = &self.request {
            known.extend(request.resources.iter().cloned());
        }
        self.arbiter.add_resources(known);
    }

    /// Overwrites the state at random; `some` are the resources that it requests afterwards.
    pub fn corrupt(&mut self, random: &mut Random, some: Resources) {
        if let Some(request) = &mut self.request {
            request.corrupt(random, some);
        }
        self.arbiter.corrupt(random);
        self.recovery.corrupt(random);
    }

    /// Fixes impossible states.
    fn stabilise(&mut self, common: &mut Common, robot: &mut Robot<'_>) {
        let longest = common.options.timeout(u32::MAX) * 2;
        let asks = self
            .request
            .as_ref()
            .filter(|request| is_lease(common) || !request.is_entered);
        if asks.is_some_and(|request| request.is_overdue(robot.now(), longest)) {
            self.repeat(common, robot);
        }
        if common.held.is_empty() && self.request.as_ref().is_none_or(|r| !r.is_entered) {
            return;
        }
        let (nothing, request) = (Resources::new(), self.request.as_ref());
        let entered = request.filter(|request| request.is_entered);
        let granted = entered.map_or(&nothing, |request| &request.resources);
        let made_up: Resources = common.held.difference(granted).cloned().collect();
        if !made_up.is_empty() {
            common.held.retain(|name| !made_up.contains(name));
            common.report_expired(robot, &made_up);
        }
        if common.held.is_empty() && entered.is_some() {
            self.give_back(common, robot);
        }
    }

    /// Takes a message, perhaps of this robot to itself.
    fn take(
        &mut self,
        common: &mut Common,
        robot: &mut Robot<'_>,
        from: RobotId,
        packet: Packet,
        post: &mut Post,
    ) {
        let terms = self.terms(common, robot);
        let enough = self.enough(common);
        let mine = |id| {
            self.request
                .as_ref()
                .is_some_and(|request| request.id == id)
        };
        match packet {
            Packet::Repeat {
                mut wish,
                attempts,
                heard,
            } => {
                let me = robot.id();
                let mine = attempts.iter().find(|(arbiter, _)| *arbiter == me);
                wish.attempt = mine.map_or(0, |&(_, attempt)| attempt);
                wish.hears = heard.contains(&me);
                self.take(common, robot, from, Packet::Request(wish), post);
            }
            Packet::Request(wish) if wish.list != self.list => {
                let wait = Packet::Wait {
                    id: wish.id,
                    attempt: wish.attempt,
                    clock: terms.clock,
                    behind: Behind::OtherList,
                };
                post.send(from, wait);
            }
            Packet::Request(wish) => {
                if common.hear(wish.clock) {
                    let terms = self.terms(common, robot);
                    self.arbiter.request(from, wish, terms, post);
                }
            }
            Packet::Release { id, left, number } => {
                self.arbiter.release(from, id, (&left, number), terms, post);
            }
            Packet::Inquire { id, .. } if !mine(id) => {
                let (left, number) = (Resources::new(), 0);
                post.send(from, Packet::Release { id, left, number });
            }
            Packet::Recall {
                nonce,
                list,
                incarnation,
            } => {
                self.answer(common, robot, (from, incarnation), (nonce, list), post);
            }
            Packet::Recalled { list, .. } if list != self.list => {}
            Packet::Recalled {
                nonce,
                holds,
                number,
                remembers,
                incarnation,
                founders,
                ..
            } => {
                let forgot = (!remembers).then_some(incarnation);
                if self.recovery.hear(from, nonce, forgot, founders) {
                    self.arbiter.numbers.raise_floor(number);
                    if let Some(wish) = holds {
                        self.arbiter.reinstate(from, wish, terms);
                    }
                    self.hear_answer(common, robot, post);
                }
            }
            Packet::Grant { id, .. } | Packet::Wait { id, .. } | Packet::Outdated { id, .. }
                if !mine(id) => {}
            Packet::Outdated { .. } => self.number_anew(common, robot, post),
            packet => {
                if let Packet::Grant { clock, .. } | Packet::Wait { clock, .. } = packet {
                    common.hear(clock);
                }
                if let Some(request) = &mut self.request {
                    request.hear_of(from, terms.now);
                    hear(request, from, packet, enough, common, post);
                }
                self.go_on(common, robot, post);
            }
        }
    }

    /// Sends messages; those to this robot itself are taken at once.
    fn deliver(&mut self, common: &mut Common, robot: &mut Robot<'_>, mut post: Post) {
        let me = robot.id();
        let mut local = 0;
        if let Some(packet) = post.for_all(robot) {
            robot.transmit(Destination::All, common.port, &packet);
        }
        while let Some((to, packet)) = post.0.pop_front() {
            if to != me {
                robot.transmit(Destination::Robot(to), common.port, &packet);
            } else if local < MOST_LOCAL {
                local += 1;
                self.take(common, robot, me, packet, &mut post);
            }
        }
    }

    fn terms(&self, common: &Common, robot: &Robot<'_>) -> Terms {
        let silent = || {
            let others = common.others(robot);
            let silent = self.recovery.silent(&others);
            let suspected = silent.iter().find(|peer| common.suspects.contains(peer));
            let first = suspected.or(silent.first()).copied();
            first.unwrap_or(robot.id())
        };
        Terms {
            now: robot.now(),
            clock: common.clock(),
            lease: lease(common),
            patience: lease(common).map_or(common.options.timeout(0), |lease| lease / 5 * 2),
            patience_waiting: lease(common).unwrap_or(common.options.timeout(u32::MAX) * 2),
            unready: (!self.recovery.is_ready).then(silent),
            tells: lease(common).is_none_or(|lease| {
                !self.recovery.is_ready && self.recovery.has_asked_for(lease * 4, robot.now())
            }),
        }
    }

    fn enough(&self, common: &Common) -> Enough {
        match is_lease(common) {
            true => Enough::Majority(self.everyone.len() / 2 + 1, belief(&common.options)),
            false => Enough::All,
        }
    }
}

fn is_lease(common: &Common) -> bool {
    common.options.algorithm == Algorithm::Lease
}

fn lease(common: &Common) -> Option<Duration> {
    is_lease(common).then_some(common.options.lease)
}

/// A request hears from an arbiter.
fn hear(
    request: &mut Request,
    from: RobotId,
    packet: Packet,
    enough: Enough,
    common: &Common,
    post: &mut Post,
) {
    match packet {
        Packet::Grant {
            attempt,
            round,
            number,
            ..
        } => request.grant(from, attempt, round, number, enough),
        Packet::Wait {
            attempt, behind, ..
        } => request.wait(from, attempt, behind),
        Packet::Inquire {
            attempt,
            must_yield,
            ..
        } => request.inquire(from, attempt, must_yield, common, post),
        _ => {}
    }
}
