//! The state that all algorithms of a mutex share: this robot's identity, the resources that it holds, and
//! its reports.

use super::{Options, Resources};
use crate::incarnation::Incarnation;
use alloc::collections::BTreeSet;
use alloc::sync::Arc;
use alloc::vec::Vec;
use serde::{Deserialize, Serialize};
use starl_core::event::MutexEvent;
use starl_core::{Port, Random, Robot, RobotId, TimerKey, timers};

/// Requests cannot have driven a clock this far ahead.
const FURTHEST: u64 = 1 << 45;

timers! {
    pub(super) enum Alarm {
        /// A robot's request must be repeated, or its lease renewed.
        Repeat,
        /// Unanswered questions of an arbiter that is not ready must be repeated.
        Recall,
    }
}

/// Identifies a request among all requests of its robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct RequestId {
    /// Drawn when the robot starts.
    pub incarnation: u32,
    /// Counts its requests since then.
    pub number: u64,
}

/// The state that does not depend on the algorithm.
#[derive(Clone, Debug)]
pub(super) struct Common {
    pub port: Port,
    pub options: Options,
    /// The participants; none for the whole fleet.
    pub participants: Option<BTreeSet<RobotId>>,
    pub incarnation: Incarnation,
    /// Counts requests.
    last_number: u64,
    /// Lamport's clock (1978).
    clock: u64,
    pub held: Resources,
    pub suspects: BTreeSet<RobotId>,
}

impl Common {
    pub fn new(port: Port, participants: Option<BTreeSet<RobotId>>, options: Options) -> Common {
        Common {
            port,
            options,
            participants,
            incarnation: Incarnation::default(),
            last_number: 0,
            clock: 0,
            held: Resources::new(),
            suspects: BTreeSet::new(),
        }
    }

    /// The name of the next request.
    pub fn next_id(&mut self, robot: &mut Robot<'_>) -> RequestId {
        self.last_number = self.last_number.saturating_add(1);
        RequestId {
            incarnation: self.incarnation.of(robot),
            number: self.last_number,
        }
    }

    /// The time of the next request on Lamport's clock. It never falls behind the robot's own clock, in
    /// milliseconds. Otherwise a robot that has not heard from any other would be ahead of all waiting
    /// robots, and a stream of new robots would starve them.
    pub fn tick(&mut self, robot: &Robot<'_>) -> u64 {
        self.clock = self.clock.saturating_add(1).max(robot.now().0 >> 20);
        self.clock
    }

    /// The time on Lamport's clock.
    pub fn clock(&self) -> u64 {
        self.clock
    }

    /// Updates the Lamport clock by another's; false if it is invalid.
    pub fn hear(&mut self, clock: u64) -> bool {
        if clock > self.clock.saturating_add(FURTHEST) {
            return false;
        }
        self.clock = self.clock.max(clock);
        true
    }

    /// All that take part, in the order of their numbers.
    pub fn everyone(&self, robot: &Robot<'_>) -> Vec<RobotId> {
        match &self.participants {
            Some(participants) => participants.iter().copied().collect(),
            None => robot.fleet().to_vec(),
        }
    }

    /// All others that take part.
    pub fn others(&self, robot: &Robot<'_>) -> Vec<RobotId> {
        let me = robot.id();
        let mut others = self.everyone(robot);
        others.retain(|&peer| peer != me);
        others
    }

    pub fn timer(&self, alarm: Alarm) -> TimerKey {
        TimerKey::new(self.port, alarm)
    }

    /// Reports an event of each of these resources.
    pub fn report(
        &self,
        robot: &mut Robot<'_>,
        event: fn(Arc<str>) -> MutexEvent,
        resources: &Resources,
    ) {
        for resource in resources {
            robot.report(self.port, event(Arc::from(&**resource)));
        }
    }

    /// Reports that the resources are held from now on.
    pub fn report_entered(&self, robot: &mut Robot<'_>) {
        let enter = |resource| MutexEvent::Enter {
            resource,
            fencing: None,
            drift: None,
        };
        self.report(robot, enter, &self.held);
    }

    /// Reports that resources are held no longer.
    pub fn report_expired(&self, robot: &mut Robot<'_>, resources: &Resources) {
        self.report(robot, |resource| MutexEvent::Expire { resource }, resources);
    }

    /// Reports the number with which the resources were granted.
    pub fn report_numbered(&self, robot: &mut Robot<'_>, number: u64) {
        for resource in &self.held {
            let enter = MutexEvent::Enter {
                resource: Arc::from(&**resource),
                fencing: Some(number),
                drift: Some(self.options.drift),
            };
            robot.report(self.port, enter);
        }
    }

    /// Overwrites the state at random; `some` are the resources that it holds afterwards.
    pub fn corrupt(&mut self, random: &mut Random, some: Resources) {
        self.held = some;
        self.suspects.retain(|_| random.chance(0.5));
        self.clock = u64::from(random.bits());
        self.last_number = u64::from(random.bits());
    }
}
