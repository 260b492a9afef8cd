//! The effects of the test host's network on datagrams.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::vec::Vec;
use starl_core::event::DropReason;
use starl_core::{Destination, Duration, Random, RobotId, Time};

use crate::Datagram;

/// The network's faults. Tests may change them at any time; datagrams in transit still arrive.
#[derive(Clone, Debug)]
pub struct Wire {
    /// How likely a copy is lost.
    pub loss: f64,
    /// How likely a datagram arrives twice.
    pub duplication: f64,
    /// Uniform between these, milliseconds; unequal ones reorder.
    pub delay_ms: (u64, u64),
    /// How likely a copy is held back, and for how long in all, milliseconds.
    pub late: (f64, u64),
    /// Longer payloads are lost, bytes.
    pub longest: usize,
    /// Nothing passes from the first robot to the second.
    pub cut: BTreeSet<(u32, u32)>,
}

impl Wire {
    /// Every datagram takes a millisecond.
    pub fn perfect() -> Wire {
        Wire {
            loss: 0.0,
            duplication: 0.0,
            delay_ms: (1, 1),
            late: (0.0, 0),
            longest: usize::MAX,
            cut: BTreeSet::new(),
        }
    }

    /// Every datagram takes this time.
    pub fn delayed(delay_ms: u64) -> Wire {
        Wire {
            delay_ms: (delay_ms, delay_ms),
            ..Wire::perfect()
        }
    }

    /// 30 % lost, 30 % twice, delays that reorder.
    pub fn bad() -> Wire {
        Wire {
            loss: 0.3,
            duplication: 0.3,
            delay_ms: (5, 400),
            ..Wire::perfect()
        }
    }

    /// The longest that a datagram takes.
    pub fn longest_delay(&self) -> Duration {
        let is_late = self.late.0 > 0.0;
        Duration::from_millis(self.delay_ms.1.max(u64::from(is_late) * self.late.1))
    }

    /// Nothing passes between these two robots, either way.
    pub fn part(&mut self, one: u32, other: u32) {
        self.cut.extend([(one, other), (other, one)]);
    }

    /// Nothing passes between a robot and the others of a fleet of this size.
    pub fn isolate(&mut self, robot: u32, fleet: u32) {
        for other in (0..fleet).filter(|&other| other != robot) {
            self.part(robot, other);
        }
    }
}

/// The datagrams in transit, by arrival time; simultaneous arrivals are in the order of sending.
#[derive(Clone, Debug, Default)]
pub(super) struct Mail {
    flying: BTreeMap<(Time, u64), (RobotId, Datagram)>,
    posted: u64,
}

impl Mail {
    /// When the next one arrives; [`Time::NEVER`] if none is on its way.
    pub fn next(&self) -> Time {
        let first = self.flying.first_key_value();
        first.map_or(Time::NEVER, |((at, _), _)| *at)
    }

    /// The next one to arrive and its receiver.
    pub fn take(&mut self) -> Option<(RobotId, Datagram)> {
        self.flying.pop_first().map(|(_, datagram)| datagram)
    }

    /// Sends a datagram; gives the receivers that a copy does not reach, and why.
    pub fn post(
        &mut self,
        at: Time,
        datagram: &Datagram,
        wire: &Wire,
        fleet: &[RobotId],
        random: &mut Random,
    ) -> Vec<(RobotId, DropReason)> {
        let from = datagram.message.from;
        let is_meant = |to: &RobotId| match datagram.destination {
            Destination::All => *to != from,
            Destination::Robot(robot) => *to == robot,
        };
        let mut lost = Vec::new();
        for &to in fleet.iter().filter(|to| is_meant(to)) {
            let copies = 1 + u32::from(random.chance(wire.duplication));
            for _ in 0..copies {
                let is_lost = random.chance(wire.loss);
                let (low, high) = match wire.late.0 > 0.0 && random.chance(wire.late.0) {
                    true => (wire.late.1, wire.late.1),
                    false => wire.delay_ms,
                };
                let delay = random.between(low as f64, high as f64) / 1000.0;
                if wire.cut.contains(&(from.0, to.0)) {
                    lost.push((to, DropReason::Partition));
                } else if datagram.message.payload.len() > wire.longest {
                    lost.push((to, DropReason::Size));
                } else if is_lost {
                    lost.push((to, DropReason::Loss));
                } else {
                    self.posted += 1;
                    let arrival = at + Duration::from_seconds_f64(delay);
                    let key = (arrival, self.posted);
                    self.flying.insert(key, (to, datagram.clone()));
                }
            }
        }
        lost
    }
}
