//! Registration (thesis, section 3.4.1): agreement, soundness and progress, and what lists exclude.
//!
//! Agreement, exclusion and soundness are judged at each moment, by the reports of robots about themselves:
//! they register and leave, accept a list, show it, show none. Progress and convergence are judged with a
//! bound that starts at the last registration, departure or fault, because each of these causes another
//! agreement.

mod instance;

use super::disturbance::Disturbance;
use super::health::{Change, Health, Needs};
use super::pending::Pending;
use super::report::Report;
use super::{Checker, Excuse, Excused, Kinds, Setting, Violation, robot_list};
use instance::Instance;
use starl_core::event::{Event, RegistrationEvent};
use starl_core::{Duration, Port, Record, RobotId, Time};
use std::collections::{BTreeMap, BTreeSet};

const AGREEMENT: &str = "registration.agreement";
const EXCLUSION: &str = "registration.exclusion";
const SOUNDNESS: &str = "registration.soundness";
const PROGRESS: &str = "registration.progress";
const CONVERGENCE: &str = "registration.convergence";

/// Watches all registrations.
#[derive(Clone, Debug)]
pub(super) struct Registration {
    bound: Duration,
    health: Health,
    instances: BTreeMap<Port, Instance>,
    /// When something is to be judged.
    due: BTreeSet<(Time, Port)>,
    disturbance: Disturbance,
    pending: Pending,
    excused: Excused,
}

impl Registration {
    pub fn new(setting: &Setting) -> Registration {
        let bound = setting.properties.registration_bound;
        Registration {
            bound,
            health: Health::new(setting.bodies.len(), Needs::Computing, bound),
            instances: BTreeMap::new(),
            due: BTreeSet::new(),
            disturbance: Disturbance::new(bound),
            pending: Pending::new(setting),
            excused: Excused::default(),
        }
    }

    fn reported(&mut self, report: &Report<'_, RegistrationEvent>) {
        let Report {
            at, robot, port, ..
        } = *report;
        // State that a corruption invented is replaced by then.
        let is_disturbed = self.disturbance.is_made_up(at);
        let instance = self.instances.entry(port).or_default();
        let mut is_excused = is_disturbed;
        let mut found = Vec::new();
        match report.event {
            RegistrationEvent::Register { apart, area } => {
                instance.registers(robot, at, area.is_none(), *apart);
            }
            RegistrationEvent::Unregister => instance.leaves(robot, at),
            RegistrationEvent::Lose => instance.shows_none(robot, at),
            RegistrationEvent::Propose { list, .. } | RegistrationEvent::Accept { list } => {
                instance.accepts(robot, *list, at, is_disturbed, &mut found);
            }
            RegistrationEvent::Agree { list, members } => {
                is_excused |= instance.shows(robot, *list, members, at, is_disturbed, &mut found);
            }
            RegistrationEvent::Fail => return,
        }
        for found in found {
            match is_excused {
                true => self.excused.forgive(&found, Excuse::Corruption),
                false => self.pending.push(found),
            }
        }
        instance.note_agreement(at);
        self.due.insert((at + self.bound, port));
    }

    fn changed(&mut self, at: Time, robot: Option<RobotId>, change: Change<'_>) {
        self.disturbance
            .change(at, robot, change, &mut self.pending, &mut self.excused);
        if let Some(robot) = robot.filter(|_| change.is_end()) {
            for instance in self.instances.values_mut() {
                instance.crashes(robot, at);
                instance.note_agreement(at);
            }
        }
        if robot.is_some() && change.is_corruption() {
            self.instances.values_mut().for_each(Instance::doubts);
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
            let (bound, disturbed) = (self.bound, self.disturbance.last());
            let mut late = Vec::new();
            for (&robot, life) in &mut instance.robots {
                if life.registered.is_none() || life.shown.is_some() || life.is_reported {
                    continue;
                }
                let since = life
                    .without
                    .max(disturbed)
                    .max(self.health.well_from(robot));
                if since + bound <= due {
                    life.is_reported = true;
                    late.push(robot);
                } else if life.without + bound <= due {
                    let unwell = self.health.well_from(robot) > disturbed;
                    let excuse = match unwell {
                        true => self.health.excuse(robot),
                        false => self.disturbance.excuse(due),
                    };
                    self.excused.note(PROGRESS, excuse);
                }
            }
            if !late.is_empty() {
                let text = format!("{} did not show a list within {bound}", robot_list(&late));
                found.push(Violation::new(PROGRESS, due, late, text));
            }
            let Some(apart_since) = instance.apart_since else {
                continue;
            };
            let since = apart_since.max(instance.changed).max(disturbed);
            if instance.is_reported {
                continue;
            }
            if self.disturbance.is_parted() || since + bound > due {
                if apart_since.max(instance.changed) + bound <= due {
                    self.excused.note(CONVERGENCE, self.disturbance.excuse(due));
                }
                continue;
            }
            let apart = instance.apart();
            if !apart.is_empty() {
                instance.is_reported = true;
                let text = format!(
                    "{} did not show the list of the others within {bound}",
                    robot_list(&apart)
                );
                found.push(Violation::new(CONVERGENCE, due, apart, text));
            }
        }
    }
}

impl Checker for Registration {
    fn properties(&self) -> &'static [&'static str] {
        &[AGREEMENT, EXCLUSION, SOUNDNESS, PROGRESS, CONVERGENCE]
    }

    fn heeds(&self) -> Kinds {
        Kinds::REPORTS
    }

    fn is_owed(&self, property: &str) -> bool {
        matches!(property, PROGRESS | CONVERGENCE) && !self.due.is_empty()
    }

    fn excused(&self, property: &str) -> Vec<(Excuse, u64)> {
        self.excused.of(property)
    }

    fn observe(&mut self, record: &Record, violations: &mut Vec<Violation>) {
        match &record.event {
            Event::Primitive { .. } => {
                if let Some(report) = Report::of(record) {
                    self.pass(record.at, violations);
                    self.reported(&report);
                }
            }
            Event::Fault(fault) => {
                self.pass(record.at, violations);
                self.health.observe(record);
                self.changed(record.at, record.robot, Change::Fault(fault));
            }
            Event::Failed(_) => {
                self.pass(record.at, violations);
                self.health.observe(record);
                self.changed(record.at, record.robot, Change::Failed);
            }
            _ => {}
        }
    }

    fn advance(&mut self, now: Time, violations: &mut Vec<Violation>) {
        self.pass(now, violations);
    }
}
