//! Leader election (thesis, section 3.4.2): agreement, soundness and progress, and the guarantees of epochs.
//!
//! An epoch must always have one leader. Guarantees that rest on memory and clocks are not judged where memory
//! was lost: epochs need not grow past a moment at which a majority of the participants did not vote, because
//! it had crashed or not started. For one bound after a corruption only the uniqueness of epochs is judged.
//! Agreement and progress are judged with a bound in which the robots concerned worked and were connected.

mod instance;
mod owed;

use super::health::{Health, Needs};
use super::parts::Parts;
use super::pending::Pending;
use super::report::Report;
use super::{Checker, Excuse, Excused, Kinds, Setting, Violation};
use instance::{Instance, Member, Outcome, Shown};
use starl_core::event::agreement::Algorithm;
use starl_core::event::{ElectionEvent, Event, Fault};
use starl_core::{Duration, Port, Record, RobotId, Time};
use std::collections::{BTreeMap, BTreeSet};

const UNIQUENESS: &str = "election.uniqueness";
const ORDER: &str = "election.order";
const EXCLUSION: &str = "election.exclusion";
const SOUNDNESS: &str = "election.soundness";
const AGREEMENT: &str = "election.agreement";
const PROGRESS: &str = "election.progress";

/// Watches all elections.
#[derive(Clone, Debug)]
pub(super) struct Election {
    bound: Duration,
    health: Health,
    parts: Parts,
    instances: BTreeMap<Port, Instance>,
    /// Robots whose agreement or progress is to be judged, by the time at which it is.
    due: BTreeSet<(Time, Port, RobotId)>,
    /// When some state was corrupted last.
    corrupted: Option<Time>,
    /// Whether a crash leaves voters what they have promised.
    keeps_storage: bool,
    pending: Pending,
    excused: Excused,
}

impl Election {
    pub fn new(setting: &Setting) -> Election {
        let bound = setting.properties.election_bound;
        let robots = setting.bodies.len();
        Election {
            bound,
            health: Health::new(robots, Needs::Computing, bound),
            parts: Parts::new(robots, bound),
            instances: BTreeMap::new(),
            due: BTreeSet::new(),
            corrupted: None,
            keeps_storage: setting.keeps_storage,
            pending: Pending::new(setting),
            excused: Excused::default(),
        }
    }

    /// Whether what a corruption made up may still be about.
    fn is_disturbed(&self, now: Time) -> bool {
        self.corrupted.is_some_and(|at| now < at + self.bound)
    }

    fn reported(&mut self, report: &Report<'_, ElectionEvent>) {
        let mut found = Vec::new();
        let Report {
            at, robot, port, ..
        } = *report;
        let is_disturbed = self.is_disturbed(at);
        let instance = self.instances.entry(port).or_default();
        let member = instance
            .members
            .entry(robot)
            .or_insert_with(|| Member::new(at));
        match *report.event {
            ElectionEvent::Start {
                algorithm,
                ref participants,
            } => {
                *member = Member::new(at);
                instance.participants.clone_from(participants);
                instance.algorithm = Some(algorithm);
            }
            ElectionEvent::Elect => {
                member.called.get_or_insert(at);
            }
            ElectionEvent::Resign => member.called = None,
            ElectionEvent::Vote { anew } => {
                member.votes_since.get_or_insert(at);
                member.is_anew = anew;
            }
            ElectionEvent::Leader {
                leader,
                epoch,
                round,
                ballot,
            } => {
                if let (Some(round), Some(ballot)) = (round, ballot) {
                    let outcome = Outcome {
                        round,
                        ballot,
                        leader,
                    };
                    found.extend(member.believe(robot, outcome, at));
                }
                instance.shows(robot, leader, epoch, at, is_disturbed, &mut found);
            }
            ElectionEvent::Lost => instance.shows_none(robot, at),
            ElectionEvent::Fail => return,
        }
        self.due.insert((at + self.bound, port, robot));
        for found in found {
            if is_disturbed && !is_shared_epoch(&found) {
                self.excused.forgive(&found, Excuse::Corruption);
            } else {
                self.pending.push(found);
            }
        }
    }

    /// Time has come to `now`.
    fn pass(&mut self, now: Time, found: &mut Vec<Violation>) {
        self.check_bounds(now, found);
        self.pending.settle(now, found);
    }

    /// A robot is down, and has lost all it knew unless its storage holds it.
    fn crash(&mut self, robot: RobotId, keeps: bool) {
        for instance in self.instances.values_mut() {
            instance.leading.remove(&robot);
            instance.members.remove(&robot);
            if !keeps && instance.note_forgotten() {
                self.excused.note(ORDER, Excuse::NoMajority);
            }
        }
    }

    fn corrupt(&mut self, at: Time) {
        self.corrupted = Some(at);
        self.pending
            .retain(Excuse::Corruption, &mut self.excused, is_shared_epoch);
        for instance in self.instances.values_mut() {
            if instance.highest.take().is_some() {
                self.excused.note(ORDER, Excuse::Corruption);
            }
        }
    }
}

impl Checker for Election {
    fn properties(&self) -> &'static [&'static str] {
        &[UNIQUENESS, ORDER, EXCLUSION, SOUNDNESS, AGREEMENT, PROGRESS]
    }

    fn has_subject(&self, property: &str) -> bool {
        let mut instances = self.instances.values();
        instances.any(|instance| match property {
            UNIQUENESS | EXCLUSION => instance.has_leases(),
            ORDER => instance.algorithm != Some(Algorithm::Bully),
            _ => true,
        })
    }

    fn heeds(&self) -> Kinds {
        Kinds::REPORTS | Kinds::SENT | Kinds::DELIVERED
    }

    fn is_owed(&self, property: &str) -> bool {
        matches!(property, AGREEMENT | PROGRESS) && !self.due.is_empty()
    }

    fn excused(&self, property: &str) -> Vec<(Excuse, u64)> {
        self.excused.of(property)
    }

    fn observe(&mut self, record: &Record, violations: &mut Vec<Violation>) {
        match &record.event {
            // Datagrams that were sent before the first election may arrive during a later partition.
            Event::Sent { .. } => self.parts.observe(record),
            // Before the first election there is nothing to agree on.
            Event::Delivered { .. } if !self.instances.is_empty() => self.parts.observe(record),
            Event::Primitive { .. } => {
                if let Some(report) = Report::of(record) {
                    self.pass(record.at, violations);
                    self.reported(&report);
                }
            }
            Event::Fault(fault) => {
                self.pass(record.at, violations);
                self.health.observe(record);
                self.parts.observe(record);
                match (record.robot, fault) {
                    (Some(robot), Fault::Crash) => self.crash(robot, self.keeps_storage),
                    (Some(robot), Fault::StorageLost) => self.crash(robot, false),
                    (Some(_), Fault::CorruptState) => self.corrupt(record.at),
                    _ => {}
                }
            }
            Event::Failed(_) => {
                self.pass(record.at, violations);
                self.health.observe(record);
            }
            _ => {}
        }
    }

    fn advance(&mut self, now: Time, violations: &mut Vec<Violation>) {
        self.pass(now, violations);
    }
}

/// Two robots that share an epoch have no excuse.
fn is_shared_epoch(found: &Violation) -> bool {
    found.property == UNIQUENESS && found.robots.len() > 1
}
