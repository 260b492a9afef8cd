//! Failure detectors: a robot that has crashed is suspected, and one that is heard is trusted again.
//!
//! Records do not show which robots run a detector before it suspects a robot for the first time. A robot counts from its
//! first finding on, and again a while after each of its restarts and corruptions, when it has either heard each other
//! robot or suspected it for its silence.

use super::health::{Change, Health, Needs};
use super::report::Report;
use super::{Checker, Excuse, Excused, Kinds, Setting, Violation};
use starl_core::event::{Event, FailureDetectorEvent, Fault};
use starl_core::{Duration, Intervention, Port, Record, RobotId, Time};
use std::collections::{BTreeMap, BTreeSet};

const COMPLETENESS: &str = "failure_detector.completeness";
const ACCURACY: &str = "failure_detector.accuracy";

/// A robot is heard all the time if no silence is longer than this part of the bound.
const SILENCES: u64 = 7;

/// Watches all failure detectors.
#[derive(Clone, Debug)]
pub(super) struct FailureDetector {
    bound: Duration,
    health: Health,
    /// Since when each robot runs the detector of a port without a fault of its own.
    observers: BTreeMap<(Port, RobotId), Time>,
    /// The suspected robot, and the robot that suspects it.
    suspected: BTreeMap<(RobotId, Port, RobotId), Heard>,
    /// Crashes that are to be suspected: until when, the crashed robot, and the robot that owes it.
    owed: BTreeSet<(Time, RobotId, Port, RobotId)>,
    /// The robots that have left the fleet. Their crashes at that moment are owed by no robot.
    left: BTreeSet<RobotId>,
    excused: Excused,
}

/// How a robot that is suspected is heard by the one that suspects it.
#[derive(Clone, Copy, Debug, Default)]
struct Heard {
    /// Since when it has not been silent for long.
    since: Time,
    last: Time,
    /// Whether it was reported that it is not trusted.
    is_reported: bool,
}

impl FailureDetector {
    pub fn new(setting: &Setting) -> FailureDetector {
        let bound = setting.properties.failure_detector_bound;
        FailureDetector {
            bound,
            health: Health::new(setting.bodies.len(), Needs::Computing, bound),
            observers: BTreeMap::new(),
            suspected: BTreeMap::new(),
            owed: BTreeSet::new(),
            left: BTreeSet::new(),
            excused: Excused::default(),
        }
    }

    fn reported(&mut self, report: &Report<'_, FailureDetectorEvent>) {
        let Report {
            at, robot, port, ..
        } = *report;
        self.observers.entry((port, robot)).or_insert(at);
        match *report.event {
            FailureDetectorEvent::Suspect { peer, .. } => {
                self.suspected.insert((peer, port, robot), Heard::default());
                self.owed.retain(|&(_, crashed, by_port, by)| {
                    (crashed, by_port, by) != (peer, port, robot)
                });
            }
            FailureDetectorEvent::Trust { peer } => {
                self.suspected.remove(&(peer, port, robot));
            }
        }
    }

    /// A datagram of one robot has reached another.
    fn heard(&mut self, at: Time, from: RobotId, by: RobotId, violations: &mut Vec<Violation>) {
        let of_sender = (from, Port(0), RobotId(0))..=(from, Port(u32::MAX), RobotId(u32::MAX));
        for (&(_, _, observer), heard) in self.suspected.range_mut(of_sender) {
            if observer != by {
                continue;
            }
            if heard.last + self.bound / SILENCES < at {
                heard.since = at;
            }
            heard.last = at;
            if heard.since + self.bound < at && !heard.is_reported {
                heard.is_reported = true;
                violations.push(Violation::new(
                    ACCURACY,
                    at,
                    [by, from],
                    format!(
                        "robot {by} still suspects robot {from}, which it has heard for {}",
                        self.bound
                    ),
                ));
            }
        }
    }

    /// A robot's condition has changed.
    fn changed(&mut self, at: Time, robot: RobotId, change: Change<'_>) {
        if change.is_end() && !self.left.contains(&robot) {
            let due = at + self.bound;
            let observers = self.observers.iter();
            for (&(port, by), &since) in observers.filter(|((_, by), _)| *by != robot) {
                let is_up = self.health.well_from(by) <= at;
                let is_known = self.suspected.contains_key(&(robot, port, by));
                if is_up && since + self.bound <= at && !is_known {
                    self.owed.insert((due, robot, port, by));
                }
            }
        }
        if change.is_end() || change.is_corruption() {
            // It has lost its suspicions, and owes none for the crashes so far.
            self.observe_from(at, robot);
            self.suspected.retain(|&(_, _, by), _| by != robot);
            let owed = self.owed.len();
            self.owed.retain(|&(.., by)| by != robot);
            if let Some(excuse) = change.excuse() {
                let forgiven = owed - self.owed.len();
                (0..forgiven).for_each(|_| self.excused.note(COMPLETENESS, excuse));
            }
            for heard in self.suspected.iter_mut().filter(|(key, _)| key.0 == robot) {
                *heard.1 = Heard::default();
            }
        }
        if let Change::Fault(Fault::Restart) = change {
            // It may have been up: then it keeps its suspicions.
            self.observe_from(at, robot);
        }
    }

    /// A robot owes suspicions of crashes from a bound after this moment on.
    fn observe_from(&mut self, at: Time, robot: RobotId) {
        for since in self.observers.iter_mut().filter(|(key, _)| key.1 == robot) {
            *since.1 = at;
        }
    }

    /// A robot has left the fleet.
    fn left(&mut self, robot: RobotId) {
        self.left.insert(robot);
        self.observers.retain(|&(_, by), _| by != robot);
        self.suspected
            .retain(|&(peer, _, by), _| peer != robot && by != robot);
        self.owed
            .retain(|&(_, crashed, _, by)| crashed != robot && by != robot);
    }

    /// Time has come to `now`: crashes that were due before are violations.
    fn pass(&mut self, now: Time, violations: &mut Vec<Violation>) {
        while let Some(&owed) = self.owed.first().filter(|(due, ..)| *due < now) {
            self.owed.remove(&owed);
            let (due, crashed, _, by) = owed;
            violations.push(Violation::new(
                COMPLETENESS,
                due,
                [by, crashed],
                format!(
                    "robot {by} has not suspected robot {crashed} within {} of its crash",
                    self.bound
                ),
            ));
        }
    }
}

impl Checker for FailureDetector {
    fn properties(&self) -> &'static [&'static str] {
        &[COMPLETENESS, ACCURACY]
    }

    fn heeds(&self) -> Kinds {
        match self.suspected.is_empty() {
            true => Kinds::REPORTS | Kinds::INTERVENTION,
            false => Kinds::REPORTS | Kinds::INTERVENTION | Kinds::DELIVERED,
        }
    }

    fn needs(&self, property: &str) -> Kinds {
        match property {
            ACCURACY => Kinds::DELIVERED,
            _ => Kinds::NONE,
        }
    }

    fn is_owed(&self, property: &str) -> bool {
        property == COMPLETENESS && !self.owed.is_empty()
    }

    fn excused(&self, property: &str) -> Vec<(Excuse, u64)> {
        self.excused.of(property)
    }

    fn observe(&mut self, record: &Record, violations: &mut Vec<Violation>) {
        if let Some(change) = Change::of(record) {
            self.pass(record.at, violations);
            self.health.observe(record);
            if let Some(robot) = record.robot {
                self.changed(record.at, robot, change);
            }
        }
        match &record.event {
            Event::Primitive { .. } => {
                if let Some(report) = Report::of(record) {
                    self.pass(record.at, violations);
                    self.reported(&report);
                }
            }
            &Event::Delivered { from, .. } => {
                if let Some(by) = record.robot {
                    self.heard(record.at, from, by, violations);
                }
            }
            Event::Intervention(what) => {
                if let Intervention::Leave(robots) = &**what {
                    self.pass(record.at, violations);
                    for &robot in robots {
                        self.left(robot);
                    }
                }
            }
            _ => {}
        }
    }

    fn advance(&mut self, now: Time, violations: &mut Vec<Violation>) {
        self.pass(now, violations);
    }
}
