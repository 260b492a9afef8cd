//! Mutex (thesis, section 3.4.3): safety, non-interference and progress, and that the numbers of leases grow.
//!
//! The reports of robots show the holders. A hold ends when it is released, when its lease ends, and when its
//! robot crashes. With leases two robots may hold a resource if clocks break the bound that the leases rely
//! on. This is not judged then, but the numbers must still distinguish the two.
//!
//! If a majority of the arbiters of leases has forgotten at once, possibly no robot knows the last number. If they
//! report this, numbers need only be greater than those since then.
//!
//! After a corruption of state anywhere, robots may believe that they hold resources of others until they release them:
//! resources entered within the bound after it are not judged against others.

mod arbiters;
mod locks;
mod waiting;

use super::health::{Health, Needs};
use super::parts::Parts;
use super::pending::Pending;
use super::report::Report;
use super::{Checker, Excuse, Excused, Kinds, Setting, Violation};
use arbiters::Fleet;
use locks::{Entry, Locks};
use starl_core::event::{Event, Fault, MutexEvent};
use starl_core::{Duration, Port, Record, RobotId, Time};
use std::collections::BTreeMap;

const SAFETY: &str = "mutex.safety";
const FENCING: &str = "mutex.fencing";
const NON_INTERFERENCE: &str = "mutex.non_interference";
const PROGRESS: &str = "mutex.progress";

/// How long a free resource may be asked for.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    /// By one robot.
    alone: Duration,
    /// By several, whose requests overlap.
    among: Duration,
}

/// Watches all mutexes.
#[derive(Clone, Debug)]
pub(super) struct Mutex {
    bounds: Bounds,
    robots: u32,
    /// How much faster or slower than true time a clock may run, as a share.
    drift: f64,
    health: Health,
    parts: Parts,
    locks: BTreeMap<Port, Locks>,
    /// Until then others may hold the same, because of a corruption of some state.
    doubtful_until: Time,
    /// When a state was overwritten last; zero if none was.
    corrupted_at: Time,
    /// Whether a robot has held something with a number.
    has_numbers: bool,
    /// Whether a crash leaves robots what they have stored.
    keeps_storage: bool,
    pending: Pending,
    /// When requests are looked at next.
    next_look: Time,
    excused: Excused,
}

impl Mutex {
    pub fn new(setting: &Setting) -> Mutex {
        let bounds = Bounds {
            alone: setting.properties.mutex_alone_bound,
            among: setting.properties.mutex_bound,
        };
        let robots = setting.bodies.len();
        Mutex {
            bounds,
            robots: robots as u32,
            drift: setting.clock_drift,
            health: Health::new(robots, Needs::Computing, bounds.among),
            parts: Parts::new(robots, bounds.among),
            locks: BTreeMap::new(),
            doubtful_until: Time::ZERO,
            corrupted_at: Time::ZERO,
            has_numbers: false,
            keeps_storage: setting.keeps_storage,
            pending: Pending::new(setting),
            next_look: Time::ZERO,
            excused: Excused::default(),
        }
    }

    fn reported(&mut self, report: &Report<'_, MutexEvent>) {
        let (at, robot) = (report.at, report.robot);
        let locks = self.locks.entry(report.port).or_default();
        match report.event {
            MutexEvent::Acquire { resource } => locks.acquire(robot, resource, at),
            MutexEvent::Withdraw { resource } => locks.withdraw(robot, resource, at),
            MutexEvent::Release { resource } | MutexEvent::Expire { resource } => {
                locks.release(robot, resource, at);
            }
            &MutexEvent::Ready {
                participants,
                needed,
                anew,
            } => {
                let arbiters = &mut locks.arbiters;
                if arbiters.ready(robot, at, participants, needed, anew) {
                    locks.forget_numbers();
                }
            }
            MutexEvent::Enter {
                resource,
                fencing,
                drift,
            } => {
                self.has_numbers |= fencing.is_some();
                let entry = Entry {
                    number: *fencing,
                    is_exclusive: drift.is_none_or(|drift| self.drift <= drift),
                    is_doubtful: at < self.doubtful_until,
                };
                let found = locks.enter(robot, resource, at, entry, &mut self.excused);
                self.pending.extend(found);
            }
        }
        self.look_after(at);
    }

    /// A robot has forgotten what it held and asked for, and what it had granted unless that `is_kept`.
    fn forget(&mut self, robot: RobotId, at: Time, is_kept: bool) {
        for locks in self.locks.values_mut() {
            locks.forget(robot, at);
            if !is_kept {
                locks.arbiters.forgot(robot);
            }
        }
        self.look_after(at);
    }

    /// A robot's state was overwritten, perhaps before its last reports.
    fn corrupted(&mut self, robot: RobotId, at: Time) {
        self.pending
            .retain(Excuse::Corruption, &mut self.excused, |_| false);
        self.doubtful_until = at + self.bounds.among;
        self.corrupted_at = at;
        for locks in self.locks.values_mut() {
            locks.doubt(robot, at);
        }
        self.look_after(at);
    }

    /// Something has changed at this time; what was overdue then has been reported.
    fn look_after(&mut self, at: Time) {
        self.next_look = at;
    }

    /// Time has come to `now`.
    fn pass(&mut self, now: Time, found: &mut Vec<Violation>) {
        self.pending.settle(now, found);
        if now <= self.next_look {
            return;
        }
        let fleet = Fleet {
            robots: self.robots,
            health: &self.health,
            parts: &self.parts,
            corrupted: self.corrupted_at,
        };
        let mut next = Time::NEVER;
        for locks in self.locks.values_mut() {
            next = next.min(locks.look(now, self.bounds, &fleet, (found, &mut self.excused)));
        }
        self.next_look = next;
    }
}

impl Checker for Mutex {
    fn properties(&self) -> &'static [&'static str] {
        &[SAFETY, FENCING, NON_INTERFERENCE, PROGRESS]
    }

    fn has_subject(&self, property: &str) -> bool {
        property != FENCING || self.has_numbers
    }

    fn heeds(&self) -> Kinds {
        Kinds::REPORTS | Kinds::SENT | Kinds::DELIVERED
    }

    fn is_owed(&self, property: &str) -> bool {
        matches!(property, NON_INTERFERENCE | PROGRESS)
            && self.locks.values().any(|locks| !locks.waiting.is_empty())
    }

    fn excused(&self, property: &str) -> Vec<(Excuse, u64)> {
        self.excused.of(property)
    }

    fn observe(&mut self, record: &Record, violations: &mut Vec<Violation>) {
        match &record.event {
            // Datagrams that were sent before a mutex was used may arrive during a later partition.
            Event::Sent { .. } => self.parts.observe(record),
            Event::Delivered { .. } if !self.locks.is_empty() => self.parts.observe(record),
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
                    (Some(robot), Fault::Crash) => {
                        self.forget(robot, record.at, self.keeps_storage);
                    }
                    (Some(robot), Fault::StorageLost) => self.forget(robot, record.at, false),
                    (Some(robot), Fault::CorruptState) => self.corrupted(robot, record.at),
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
