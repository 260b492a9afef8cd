//! A fixed number of robots that step together; the unit of parallel work.
//!
//! Invariant: which robots share a shard depends on the fleet alone, never on the number of threads.

use super::act::Turn;
use super::inbox::Delivery;
use super::outlet::SimulatorOutlet;
use super::radio::{self, Posted};
use super::record::Log;
use super::shared::{Shared, Window};
use super::simulated_robot::{Outgoing, SimulatedRobot};
use super::things::Grip;
use starl_core::event::Hit;
use starl_core::{Command, Event, Point, Random, RobotId, Time, math, sensor};
use starl_host::Workspace;
use starl_host::journal::Journal;
use starl_motion::contact::{self, Contacts};
use starl_motion::sensing::Readings;
use starl_motion::{Neighbour, State};

/// How many robots a shard holds.
pub const SIZE: usize = 256;

/// Robots with neighbouring numbers.
#[derive(Clone, Default)]
pub struct Shard {
    pub first: u32,
    pub members: Vec<SimulatedRobot>,
    pub states: Vec<State>,
    pub predicted: Vec<State>,
    /// The greatest [bend](contact::bend) of a predicted path, metres.
    pub bend: f64,
    pub outbox: Vec<Outgoing>,
    /// The requests of robots to their grippers in this step.
    pub grips: Vec<Grip>,
    pub posted: Vec<Posted>,
    /// The time of each robot's next event, except arrivals of datagrams.
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
    pub fn begin_step(&mut self, step: Window) {
        self.outbox.clear();
        self.routed = 0;
        if step.from == Time::ZERO {
            self.schedule(step, step.from);
        }
    }

    /// Finds out when something happens to each robot from `now` on, after a change from outside in this step.
    pub fn schedule(&mut self, step: Window, now: Time) {
        let plans = if now > step.from { step.to } else { step.from };
        let due = |member: &SimulatedRobot| match now {
            Time::ZERO => Time::ZERO,
            _ => member.next_due(plans),
        };
        self.due.clear();
        self.due.extend(self.members.iter().map(due));
        self.find_earliest();
    }

    /// The time of the next input of any robot, without arrivals of datagrams.
    pub fn next_due(&self) -> Time {
        self.earliest
    }

    fn find_earliest(&mut self) {
        self.earliest = self.due.iter().copied().min().unwrap_or(Time::NEVER);
    }

    /// Records an event of one of the robots.
    pub fn record(&mut self, robot: RobotId, at: Time, event: Event) {
        let member = &mut self.members[(robot.0 - self.first) as usize];
        let digest = &mut member.account.digest;
        self.log.record(digest, robot, at, event);
    }

    /// A datagram arrives at one of the robots.
    pub fn arrives(&mut self, robot: RobotId, at: Time) {
        let due = &mut self.due[(robot.0 - self.first) as usize];
        *due = at.min(*due);
        self.earliest = at.min(self.earliest);
    }

    /// Lets each robot take its inputs of this slot of a step.
    pub fn act(&mut self, shared: &Shared, step: Window, slot: Window) {
        for (due, (index, member)) in self.due.iter_mut().zip(self.members.iter_mut().enumerate()) {
            if *due >= slot.to {
                continue;
            }
            if member.is_gone {
                *due = Time::NEVER;
                continue;
            }
            let scratch = &mut self.scratch;
            let outlet = SimulatorOutlet {
                robot: member.id(),
                shared,
                kind: &shared.kinds[member.group as usize],
                state: &self.states[index],
                account: &mut member.account,
                outbox: &mut self.outbox,
                grips: &mut self.grips,
                log: &mut self.log,
                journal: &mut self.journal,
                workspace: &mut scratch.workspace,
            };
            let mut turn = Turn {
                window: slot,
                step: step.from,
                node: &mut member.node,
                next_estimate: &mut member.next_estimate,
                senses: &mut member.senses,
                readings: &mut scratch.readings,
                sensed: false,
                outlet,
            };
            turn.run(&mut scratch.arrivals);
            *due = member.next_due(step.to);
        }
        self.find_earliest();
    }

    /// Predicts the motion of each robot in a part of a step; `next` receives the predicted positions.
    pub fn predict(&mut self, shared: &Shared, window: Window, next: &mut [Point]) {
        self.bend = 0.0;
        for (index, member) in self.members.iter().enumerate() {
            let (kind, state) = (&shared.kinds[member.group as usize], &self.states[index]);
            let predicted = &mut self.predicted[index];
            if member.is_gone {
                *predicted = *state;
            } else {
                let command = if member.node.condition().down {
                    kind.at_a_loss
                } else if member.motor_stuck {
                    Command::Stop
                } else {
                    member.node.command()
                };
                let disturbance = shared.disturbance(member.id(), window.from);
                let elapsed = window.to.since(window.from);
                *predicted = kind.model.predict(state, &command, &disturbance, elapsed);
                let bend = contact::bend(state.pose.position, predicted, elapsed.seconds());
                self.bend = self.bend.max(bend);
            }
            next[index] = predicted.pose.position;
        }
    }

    /// Overwrites the state of a robot's program at random.
    pub fn corrupt(&mut self, shared: &Shared, robot: RobotId, at: Time, random: &mut Random) {
        let index = (robot.0 - self.first) as usize;
        let member = &mut self.members[index];
        let mut outlet = SimulatorOutlet {
            robot,
            shared,
            kind: &shared.kinds[member.group as usize],
            state: &self.states[index],
            account: &mut member.account,
            outbox: &mut self.outbox,
            grips: &mut self.grips,
            log: &mut self.log,
            journal: &mut self.journal,
            workspace: &mut self.scratch.workspace,
        };
        member.node.corrupt(at, random, &mut outlet);
    }

    /// Moves each robot to where it was predicted in a part of the step, or lets it be stopped, and shows where it is.
    pub fn settle(
        &mut self,
        shared: &Shared,
        (step, part): (Window, Window),
        contacts: &Contacts,
        bodies: &mut [Neighbour],
        perceived: &mut [Neighbour],
    ) {
        std::mem::swap(&mut self.states, &mut self.predicted);
        for (index, member) in self.members.iter_mut().enumerate() {
            let (state, body) = (&mut self.states[index], &mut bodies[index]);
            let kind = &shared.kinds[member.group as usize];
            let contact = contacts.of(member.id());
            let hit = contact.map(|contact| contact.with);
            let impact = contact.map(|contact| contact.impact);
            if let Some(impact) = impact {
                kind.model.stop_at(state, impact.place);
            }
            let before = shared.bodies[member.id().index()].position;
            member.distance += state.pose.position.distance(before);
            body.position = state.pose.position;
            body.velocity = state.twist.linear;
            if let Some(seen) = perceived.get_mut(index) {
                *seen = member.perceived(body);
            }
            let contact = impact.map(|impact| sensor::Contact {
                bearing: math::wrap_angle(impact.direction.heading() - state.pose.yaw),
            });
            // The bumper shows the last contact of the step.
            if contact.is_some() || part.from == step.from {
                member.senses.contact = contact;
            }
            if hit != member.senses.touching {
                member.senses.touching = hit;
                if let Some(with) = hit {
                    let event = Event::Collided { with };
                    let digest = &mut member.account.digest;
                    self.log.record(digest, member.node.id(), part.to, event);
                    // Two robots that meet are one collision, not two.
                    let counted_there = matches!(with, Hit::Robot(other)
                        if other < member.id() && contacts.of(other)
                            .is_some_and(|contact| contact.with == Hit::Robot(member.id())));
                    self.log.tally.collisions += u64::from(!counted_there);
                }
            }
            let is_due = part.to == step.to && member.next_pose_record <= step.to;
            if is_due && !member.is_gone {
                member.next_pose_record += shared.scenario.trace.pose_period;
                let event = Event::Moved(state.pose);
                let digest = &mut member.account.digest;
                self.log.record(digest, member.node.id(), step.to, event);
            }
        }
    }

    /// Decides the receivers of the datagrams that this shard's robots have sent in a slot.
    pub fn route(&mut self, shared: &Shared, slot: Window) {
        self.posted.clear();
        for (index, outgoing) in self.outbox.iter().enumerate().skip(self.routed) {
            let sender = (outgoing.datagram.message.from.0 - self.first) as usize;
            let digest = &mut self.members[sender].account.digest;
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
