//! Barrier: no robot passes before all have arrived, and all pass when all have arrived.
//!
//! A robot that has arrived reports this, and the generation once it knows it; one that restarts has to ask.
//! It has arrived at a generation if it has waited for that or a later one in any of its lives, or if it has
//! arrived and does not know the generation yet. When all participants have crashed, generations start
//! again.

use super::disturbance::Disturbance;
use super::health::{Change, Health, Needs};
use super::pending::Pending;
use super::report::Report;
use super::{Checker, Excuse, Excused, Kinds, Setting, Violation, robot_list};
use starl_core::event::BarrierEvent;
use starl_core::{Duration, Port, Record, RobotId, Time};
use std::collections::{BTreeMap, BTreeSet};

const SAFETY: &str = "barrier.safety";
const PROGRESS: &str = "barrier.progress";

/// Watches all barriers.
#[derive(Clone, Debug)]
pub(super) struct Barrier {
    bound: Duration,
    health: Health,
    instances: BTreeMap<Port, Instance>,
    /// When something is to be judged.
    due: BTreeSet<(Time, Port)>,
    disturbance: Disturbance,
    pending: Pending,
    excused: Excused,
}

#[derive(Clone, Debug, Default)]
struct Instance {
    robots: BTreeMap<RobotId, Place>,
    /// Those that have not crashed since they last came.
    rememberers: BTreeSet<RobotId>,
    participants: Vec<RobotId>,
    /// The latest generation that a robot has passed, and the participants by then. Robots that join later arrive at the
    /// next one, also where another robot passes this one after that.
    gate: Option<(u64, Vec<RobotId>)>,
}

/// Where a robot is.
#[derive(Clone, Copy, Debug, Default)]
struct Place {
    /// The generation that it waited for last, in any life.
    come_to: u64,
    /// It has come, and does not know to which generation.
    is_unsure: bool,
    /// Since when it waits.
    waits: Option<Time>,
    /// The latest generation that it has passed in its present life.
    passed: Option<u64>,
    passed_at: Time,
    /// Whether it was reported that it does not pass.
    is_reported: bool,
}

impl Barrier {
    pub fn new(setting: &Setting) -> Barrier {
        let bound = setting.properties.barrier_bound;
        Barrier {
            bound,
            health: Health::new(setting.bodies.len(), Needs::Computing, bound),
            instances: BTreeMap::new(),
            due: BTreeSet::new(),
            disturbance: Disturbance::new(bound),
            pending: Pending::new(setting),
            excused: Excused::default(),
        }
    }

    fn reported(&mut self, report: &Report<'_, BarrierEvent>) {
        let Report {
            at, robot, port, ..
        } = *report;
        let is_disturbed = self.disturbance.is_made_up(at);
        let instance = self.instances.entry(port).or_default();
        let place = instance.robots.entry(robot).or_default();
        match report.event {
            BarrierEvent::Arrive { participants } => {
                instance.participants.clone_from(participants);
                place.is_unsure = true;
                place.waits = Some(at);
                place.is_reported = false;
                instance.rememberers.insert(robot);
            }
            BarrierEvent::Wait { generation } => {
                place.is_unsure = false;
                place.come_to = *generation;
            }
            BarrierEvent::Pass {
                generation,
                participants,
            } => {
                instance.participants.clone_from(participants);
                let generation = *generation;
                let before = place.passed.replace(generation);
                place.waits = None;
                place.passed_at = at;
                let found = instance.check_passing(robot, generation, before, at);
                let is_first = instance
                    .gate
                    .as_ref()
                    .is_none_or(|gate| gate.0 < generation);
                if is_first && !is_disturbed {
                    instance.gate = Some((generation, participants.clone()));
                }
                for found in found {
                    match is_disturbed {
                        true => self.excused.forgive(&found, Excuse::Corruption),
                        false => self.pending.push(found),
                    }
                }
            }
        }
        self.due.insert((at + self.bound, port));
    }

    fn changed(&mut self, at: Time, robot: Option<RobotId>, change: Change<'_>) {
        self.disturbance
            .change(at, robot, change, &mut self.pending, &mut self.excused);
        if let Some(robot) = robot.filter(|_| change.is_end()) {
            for instance in self.instances.values_mut() {
                instance.crashes(robot);
            }
        }
        for &port in self.instances.keys() {
            self.due.insert((at + self.bound, port));
        }
    }

    /// Time has come to `now`.
    fn pass(&mut self, now: Time, found: &mut Vec<Violation>) {
        self.check_bounds(now, found);
        self.pending.settle(now, found);
    }

    /// Judges what is due before `now`.
    fn check_bounds(&mut self, now: Time, found: &mut Vec<Violation>) {
        while let Some(&(due, port)) = self.due.first().filter(|(due, _)| *due < now) {
            self.due.remove(&(due, port));
            let Some(instance) = self.instances.get_mut(&port) else {
                continue;
            };
            let bound = self.bound;
            let waiting = instance.waiting(due - bound);
            if self.disturbance.is_parted() || self.disturbance.last() + bound > due {
                for _ in waiting {
                    self.excused.note(PROGRESS, self.disturbance.excuse(due));
                }
                continue;
            }
            let late = instance.late(&self.health, due - bound);
            for robot in waiting.into_iter().filter(|robot| !late.contains(robot)) {
                self.excused
                    .note(PROGRESS, instance.excuse(robot, &self.health, due - bound));
            }
            if !late.is_empty() {
                let text = format!(
                    "{} did not pass within {bound} of the arrival of the last",
                    robot_list(&late)
                );
                found.push(Violation {
                    property: PROGRESS.into(),
                    at: due,
                    robots: late,
                    text,
                });
            }
        }
    }
}

impl Instance {
    fn check_passing(
        &self,
        robot: RobotId,
        generation: u64,
        before: Option<u64>,
        at: Time,
    ) -> Vec<Violation> {
        let mut found = Vec::new();
        let mut report = |robots: Vec<RobotId>, text: String| {
            found.push(Violation {
                property: SAFETY.into(),
                at,
                robots,
                text,
            });
        };
        if before.is_some_and(|before| before >= generation) {
            let text = format!("robot {robot} passes generation {generation} again");
            report(vec![robot], text);
        }
        let has_come = |peer: &RobotId| {
            let place = self.robots.get(peer);
            place.is_some_and(|place| place.is_unsure || place.come_to >= generation)
        };
        let gate = self.gate.as_ref().filter(|gate| gate.0 >= generation);
        let must_come = |peer: &RobotId| gate.is_none_or(|(_, by_then)| by_then.contains(peer));
        let all = self.participants.iter().copied().filter(must_come);
        let absent: Vec<RobotId> = all.filter(|peer| !has_come(peer)).collect();
        if !absent.is_empty() {
            let text = format!(
                "robot {robot} passes generation {generation} before {} has arrived at it",
                robot_list(&absent)
            );
            report([robot].into_iter().chain(absent).collect(), text);
        }
        found
    }

    /// A robot has lost its state. Others may still know its earlier messages.
    fn crashes(&mut self, robot: RobotId) {
        self.rememberers.remove(&robot);
        if let Some(place) = self.robots.get_mut(&robot) {
            place.waits = None;
            place.passed = None;
        }
        if self.rememberers.is_empty() {
            self.robots.clear();
            self.gate = None;
        }
    }

    /// Those that wait although all had come by then, well or not, and were not reported before.
    fn waiting(&self, by: Time) -> Vec<RobotId> {
        let robots = self.robots.iter();
        let waiting = robots.filter(|(robot, place)| {
            let mut others = self.participants.iter().filter(|other| other != robot);
            !place.is_reported
                && place.waits.is_some_and(|arrived| arrived <= by)
                && others.all(|other| self.had_come(*other, place, by))
        });
        waiting.map(|(robot, _)| *robot).collect()
    }

    /// Why a robot need not have passed.
    fn excuse(&self, robot: RobotId, health: &Health, by: Time) -> Excuse {
        let concerned = [robot].into_iter().chain(self.participants.iter().copied());
        let mut unwell = concerned.filter(|robot| health.well_from(*robot) > by);
        unwell
            .next()
            .map_or(Excuse::Recovery, |robot| health.excuse(robot))
    }

    /// Those that wait although all had come by then, and were not reported before.
    fn late(&mut self, health: &Health, by: Time) -> Vec<RobotId> {
        let robots = self.robots.iter();
        let waiting = robots.filter(|(_, place)| place.waits.is_some() && !place.is_reported);
        let late: Vec<RobotId> = waiting
            .filter(|(robot, place)| {
                let mut others = self.participants.iter().filter(|other| other != robot);
                health.well_from(**robot) <= by
                    && place.waits.is_some_and(|arrived| arrived <= by)
                    && others.all(|other| {
                        health.well_from(*other) <= by && self.had_come(*other, place, by)
                    })
            })
            .map(|(robot, _)| *robot)
            .collect();
        for robot in &late {
            if let Some(place) = self.robots.get_mut(robot) {
                place.is_reported = true;
            }
        }
        late
    }

    /// Whether a robot had come to where another waits, or passed it, by then.
    fn had_come(&self, other: RobotId, waiting: &Place, by: Time) -> bool {
        let Some(place) = self.robots.get(&other) else {
            return false;
        };
        let is_ahead = match waiting.is_unsure {
            true => waiting.waits.is_some_and(|since| place.passed_at >= since),
            false => place.passed >= Some(waiting.come_to),
        };
        place.waits.is_some_and(|arrived| arrived <= by)
            || is_ahead && place.passed_at <= by && place.passed.is_some()
    }
}

impl Checker for Barrier {
    fn properties(&self) -> &'static [&'static str] {
        &[SAFETY, PROGRESS]
    }

    fn heeds(&self) -> Kinds {
        Kinds::REPORTS
    }

    fn is_owed(&self, property: &str) -> bool {
        property == PROGRESS && !self.due.is_empty()
    }

    fn excused(&self, property: &str) -> Vec<(Excuse, u64)> {
        self.excused.of(property)
    }

    fn observe(&mut self, record: &Record, violations: &mut Vec<Violation>) {
        if let Some(report) = Report::of(record) {
            self.pass(record.at, violations);
            self.reported(&report);
        }
        if let Some(change) = Change::of(record) {
            self.pass(record.at, violations);
            self.health.observe(record);
            self.changed(record.at, record.robot, change);
        }
    }

    fn advance(&mut self, now: Time, violations: &mut Vec<Violation>) {
        self.pass(now, violations);
    }
}
