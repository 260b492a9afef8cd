//! A fixed number of robots that step together; the unit of parallel work.
//!
//! Invariant: which robots share a shard depends on the fleet alone, never on the number of threads.

use super::act::{Turn, next_due};
use super::inbox::Delivery;
use super::mind::{Mind, Outgoing};
use super::outlet::Desk;
use super::radio::{self, Posted};
use super::record::Log;
use super::shared::{Shared, Window};
use super::things::Grip;
use starl_core::event::Hit;
use starl_core::{Command, Event, Point, Random, RobotId, Time, math, sensor};
use starl_host::Workspace;
use starl_host::journal::Journal;
use starl_motion::contact::{Contact, Motions};
use starl_motion::sensing::Readings;
use starl_motion::{Neighbour, State};

/// How many robots a shard holds.
pub const SIZE: usize = 256;

/// Robots with neighbouring numbers.
#[derive(Clone, Default)]
pub struct Shard {
    pub first: u32,
    pub minds: Vec<Mind>,
    pub states: Vec<State>,
    pub predicted: Vec<State>,
    pub outbox: Vec<Outgoing>,
    /// The requests of robots to their grippers in this step.
    pub grips: Vec<Grip>,
    pub posted: Vec<Posted>,
    /// When something happens to each robot next, arrivals of datagrams aside.
    due: Vec<Time>,
    /// The earliest of these.
    earliest: Time,
    /// How many of the outbox have been routed.
    routed: usize,
    pub log: Log,
    /// Records the inputs of the robots' software; none if not requested.
    pub journal: Option<Box<Journal>>,
    scratch: Scratch,
}

/// Room for work, used over and over.
#[derive(Clone, Default)]
pub struct Scratch {
    pub workspace: Workspace,
    pub readings: Readings,
    pub arrivals: Vec<Delivery>,
}

impl Shard {
    /// An empty shard whose first robot will have this number.
    pub fn starting_at(first: u32) -> Shard {
        Shard {
            first,
            ..Shard::default()
        }
    }

    /// Clears the messages sent in the previous step.
    pub fn begin_step(&mut self, step: Time) {
        self.outbox.clear();
        self.routed = 0;
        self.schedule(step, step);
    }

    /// Finds out when something happens to each robot from `now` on in the step that began at `step`.
    pub fn schedule(&mut self, step: Time, now: Time) {
        let is_begun = now > step;
        let due = |mind: &Mind| match mind {
            mind if mind.is_gone => Time::NEVER,
            mind if !is_begun && (step == Time::ZERO || !mind.account.plans.is_empty()) => step,
            mind => next_due(&mind.node, &mind.account, mind.next_estimate),
        };
        self.due.clear();
        self.due.extend(self.minds.iter().map(due));
        self.find_earliest();
    }

    /// The time of the next input of any robot, without arrivals of datagrams.
    pub fn next_due(&self) -> Time {
        self.earliest
    }

    fn find_earliest(&mut self) {
        self.earliest = self.due.iter().copied().min().unwrap_or(Time::NEVER);
    }

    /// A datagram arrives at one of the robots.
    pub fn arrives(&mut self, robot: RobotId, at: Time) {
        let due = &mut self.due[(robot.0 - self.first) as usize];
        *due = at.min(*due);
        self.earliest = at.min(self.earliest);
    }

    /// Lets each robot take its inputs of this slot of the step that began at `step`.
    pub fn act(&mut self, shared: &Shared, step: Time, slot: Window) {
        for (index, mind) in self.minds.iter_mut().enumerate() {
            if mind.is_gone {
                self.due[index] = Time::NEVER;
            }
            if self.due[index] >= slot.to {
                continue;
            }
            let scratch = &mut self.scratch;
            let desk = Desk {
                robot: mind.id(),
                shared,
                kind: &shared.kinds[mind.group as usize],
                state: &self.states[index],
                account: &mut mind.account,
                outbox: &mut self.outbox,
                grips: &mut self.grips,
                log: &mut self.log,
                journal: &mut self.journal,
                workspace: &mut scratch.workspace,
            };
            let mut turn = Turn {
                window: slot,
                step,
                node: &mut mind.node,
                next_estimate: &mut mind.next_estimate,
                senses: &mut mind.senses,
                readings: &mut scratch.readings,
                sensed: false,
                desk,
            };
            self.due[index] = turn.run(&mut scratch.arrivals);
        }
        self.find_earliest();
    }

    /// Predicts the motion of each robot in a step; `next` receives the predicted positions.
    pub fn predict(&mut self, shared: &Shared, window: Window, next: &mut [Point]) {
        for (index, mind) in self.minds.iter().enumerate() {
            let (kind, state) = (&shared.kinds[mind.group as usize], &self.states[index]);
            let predicted = &mut self.predicted[index];
            if mind.is_gone {
                *predicted = *state;
            } else {
                let command = if mind.node.condition().down {
                    kind.at_a_loss
                } else if mind.motor_stuck {
                    Command::Stop
                } else {
                    mind.node.command()
                };
                let disturbance = shared.disturbance(mind.id(), window.from);
                let elapsed = window.to.since(window.from);
                *predicted = kind.model.predict(state, &command, &disturbance, elapsed);
            }
            next[index] = predicted.pose.position;
        }
    }

    /// Overwrites the state of a robot's program at random.
    pub fn corrupt(&mut self, shared: &Shared, robot: RobotId, at: Time, random: &mut Random) {
        let index = (robot.0 - self.first) as usize;
        let mind = &mut self.minds[index];
        let mut desk = Desk {
            robot,
            shared,
            kind: &shared.kinds[mind.group as usize],
            state: &self.states[index],
            account: &mut mind.account,
            outbox: &mut self.outbox,
            grips: &mut self.grips,
            log: &mut self.log,
            journal: &mut self.journal,
            workspace: &mut self.scratch.workspace,
        };
        mind.node.corrupt(at, random, &mut desk);
    }

    /// Finds what each robot's predicted motion meets first.
    pub fn look_ahead(&self, motions: &Motions<'_>, contacts: &mut [Option<Contact>]) {
        for (mind, contact) in self.minds.iter().zip(contacts) {
            *contact = match mind.is_gone {
                true => None,
                false => motions.first_contact(mind.id(), 0.0, |_| 1.0),
            };
        }
    }

    /// Moves each robot to where it was predicted, or lets it be stopped, and shows where it is.
    pub fn settle(
        &mut self,
        shared: &Shared,
        window: Window,
        contacts: &[Option<Contact>],
        bodies: &mut [Neighbour],
        perceived: &mut [Neighbour],
    ) {
        for (index, mind) in self.minds.iter_mut().enumerate() {
            let (state, body) = (&mut self.states[index], &mut bodies[index]);
            let kind = &shared.kinds[mind.group as usize];
            let contact = contacts.get(mind.id().index()).copied().flatten();
            let hit = contact.map(|contact| contact.with);
            let impact = contact.map(|contact| contact.impact);
            kind.model.update(state, &self.predicted[index], impact);
            let before = shared.bodies[mind.id().index()].position;
            mind.distance += state.pose.position.distance(before);
            body.position = state.pose.position;
            body.velocity = state.twist.linear;
            if let Some(seen) = perceived.get_mut(index) {
                *seen = mind.perceived(body);
            }
            mind.senses.contact = impact.map(|impact| sensor::Contact {
                bearing: math::wrap_angle(impact.direction.heading() - state.pose.yaw),
            });
            if hit != mind.senses.touching {
                mind.senses.touching = hit;
                if let Some(with) = hit {
                    let event = Event::Collided { with };
                    let digest = &mut mind.account.digest;
                    self.log.record(digest, mind.node.id(), window.to, event);
                    // Two robots that meet are one collision, not two.
                    let counted_there = matches!(with, Hit::Robot(other)
                        if other < mind.id() && contacts[other.index()]
                            .is_some_and(|contact| contact.with == Hit::Robot(mind.id())));
                    self.log.tally.collisions += u64::from(!counted_there);
                }
            }
            if mind.next_pose_record <= window.to && !mind.is_gone {
                mind.next_pose_record += shared.scenario.trace.pose_period;
                let event = Event::Moved(state.pose);
                let digest = &mut mind.account.digest;
                self.log.record(digest, mind.node.id(), window.to, event);
            }
        }
    }

    /// Decides the receivers of the datagrams that this shard's robots have sent in a slot.
    pub fn route(&mut self, shared: &Shared, slot: Window) {
        self.posted.clear();
        for (index, outgoing) in self.outbox.iter().enumerate().skip(self.routed) {
            let sender = (outgoing.datagram.message.from.0 - self.first) as usize;
            let digest = &mut self.minds[sender].account.digest;
            radio::route(
                shared,
                slot,
                (index as u32, outgoing),
                digest,
                &mut self.log,
                &mut self.posted,
            );
        }
        self.routed = self.outbox.len();
    }
}
