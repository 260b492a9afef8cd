//! Faults that disturb all robots of a primitive alike: the time of the last one, whether the network is
//! partitioned, and whether invented state of a corruption may still exist.

use super::health::Change;
use super::pending::Pending;
use super::{Excuse, Excused, Violation};
use starl_core::event::Fault;
use starl_core::{Duration, RobotId, Time};

/// The record of disturbances for a checker of an agreement among all robots of an instance.
#[derive(Clone, Debug)]
pub(super) struct Disturbance {
    /// For so long a fault excuses what is late, and what was made up may last.
    bound: Duration,
    last: Time,
    /// When some state was corrupted last, or what that made up was kept alive by another fault.
    corrupted: Option<Time>,
    is_parted: bool,
}

impl Disturbance {
    /// Nothing yet.
    pub fn new(bound: Duration) -> Disturbance {
        Disturbance {
            bound,
            last: Time::ZERO,
            corrupted: None,
            is_parted: false,
        }
    }

    /// Records a fault of a robot or the network, and drops the violations that it excuses.
    pub fn change(
        &mut self,
        at: Time,
        robot: Option<RobotId>,
        change: Change<'_>,
        found: &mut Pending,
        excused: &mut Excused,
    ) {
        self.last = at;
        let is_corruption = robot.is_some() && change.is_corruption();
        // Invented state may survive a partition.
        if is_corruption || self.is_made_up(at) {
            self.corrupted = Some(at);
        }
        match (robot, change) {
            (None, Change::Fault(fault)) if fault.parts() => self.is_parted = true,
            (None, Change::Fault(Fault::Heal)) => self.is_parted = false,
            _ => {}
        }
        let is_excused = |violation: &Violation| match robot {
            Some(robot) => is_corruption || violation.robots.contains(&robot),
            None => false,
        };
        let excuse = change.excuse().unwrap_or(Excuse::Recovery);
        found.retain(excuse, excused, |violation| !is_excused(violation));
    }

    /// When the last fault was on record.
    pub fn last(&self) -> Time {
        self.last
    }

    /// Whether the network is partitioned.
    pub fn is_parted(&self) -> bool {
        self.is_parted
    }

    /// Why something of the last bound is not judged.
    pub fn excuse(&self, now: Time) -> Excuse {
        if self.is_parted {
            Excuse::Partition
        } else if self.is_made_up(now) {
            Excuse::Corruption
        } else {
            Excuse::Recovery
        }
    }

    /// Whether robots may still go by what a corruption made up.
    pub fn is_made_up(&self, now: Time) -> bool {
        self.corrupted.is_some_and(|since| now < since + self.bound)
    }
}
