//! Which robots partitions kept apart, and until when, by the trace alone.
//!
//! The trace shows when a partition begins and when all are healed, not the parts. Two robots were in the same
//! part if datagrams came through: those sent after the partition had begun connect their senders and receivers.
//! Where robots may hear each other in one direction only, datagrams in both directions are needed. Robots without
//! such a connection may have been separated.

use starl_core::event::{Event, Fault};
use starl_core::{Duration, Record, RobotId, Time};
use std::collections::{BTreeSet, VecDeque};

/// The partitions of a run, as far back as anyone asks.
#[derive(Clone, Debug)]
pub(super) struct Parts {
    /// By robot: the number of the last datagram that it sent.
    sent: Vec<Option<u32>>,
    /// In the order of time; at most the last has not ended.
    partitions: VecDeque<Partition>,
    /// Partitions that ended longer ago are forgotten.
    memory: Duration,
}

#[derive(Clone, Debug)]
struct Partition {
    /// When it was healed, or gave way to another one.
    ended: Time,
    /// The datagrams that had been sent when it began.
    sent_before: Vec<Option<u32>>,
    /// By robot: another one of the same part, or itself. Following these leads to the one by which a
    /// part is known (disjoint sets: Galler and Fischer 1964).
    same_as: Vec<u32>,
    /// If robots may hear each other in one direction only: which robot has heard which.
    one_way: Option<BTreeSet<(RobotId, RobotId)>>,
}

impl Parts {
    pub fn new(robots: usize, memory: Duration) -> Parts {
        Parts {
            sent: vec![None; robots],
            partitions: VecDeque::new(),
            memory,
        }
    }

    /// Records partitions and datagrams.
    pub fn observe(&mut self, record: &Record) {
        match (&record.event, record.robot) {
            (Event::Fault(fault), None) if fault.parts() => {
                self.end(record.at);
                self.begin(*fault == Fault::OneWay);
            }
            (Event::Fault(Fault::Heal), None) => self.end(record.at),
            (&Event::Sent { sequence, .. }, Some(robot)) => {
                if let Some(last) = self.sent.get_mut(robot.index()) {
                    *last = Some(sequence);
                }
            }
            (&Event::Delivered { from, sequence }, Some(to)) => {
                let partition = self.partitions.back_mut();
                if let Some(partition) = partition.filter(|p| p.ended == Time::NEVER) {
                    partition.came_through(from, sequence, to);
                }
            }
            _ => {}
        }
    }

    /// Since when no partition can have kept the two apart; [`Time::NEVER`] while one can.
    pub fn together_since(&self, one: RobotId, other: RobotId) -> Time {
        let apart = self.partitions.iter().rev();
        let mut apart = apart.filter(|partition| partition.part(one) != partition.part(other));
        apart.next().map_or(Time::ZERO, |partition| partition.ended)
    }

    fn begin(&mut self, one_way: bool) {
        self.partitions.push_back(Partition {
            ended: Time::NEVER,
            sent_before: self.sent.clone(),
            same_as: (0..self.sent.len() as u32).collect(),
            one_way: one_way.then(BTreeSet::new),
        });
    }

    fn end(&mut self, at: Time) {
        if let Some(partition) = self.partitions.back_mut() {
            partition.ended = partition.ended.min(at);
        }
        let oldest = at - self.memory;
        while self.partitions.front().is_some_and(|p| p.ended < oldest) {
            self.partitions.pop_front();
        }
    }
}

impl Partition {
    fn came_through(&mut self, from: RobotId, sequence: u32, to: RobotId) {
        let before = self.sent_before.get(from.index()).copied().flatten();
        let (one, other) = (self.part(from), self.part(to));
        let (least, greatest) = (one.min(other), one.max(other));
        let is_recent = before.is_none_or(|before| before < sequence);
        let is_answered = match &mut self.one_way {
            Some(heard) if is_recent => {
                heard.insert((to, from));
                heard.contains(&(from, to))
            }
            Some(_) => false,
            None => true,
        };
        if is_recent
            && is_answered
            && let Some(same_as) = self.same_as.get_mut(greatest as usize)
        {
            *same_as = least;
        }
        // Shortens the paths for later queries.
        for robot in [from, to] {
            let part = self.part(robot);
            if let Some(same_as) = self.same_as.get_mut(robot.index()) {
                *same_as = part;
            }
        }
    }

    /// The robot by which the part is known.
    fn part(&self, robot: RobotId) -> u32 {
        let mut part = robot.0;
        while let Some(&next) = self.same_as.get(part as usize)
            && next != part
        {
            part = next;
        }
        part
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use starl_core::{Destination, Payload, Port};

    /// Robot 0 and robot 1 send a datagram each while the network is cut so, of which these come through.
    fn together_after(cut: Fault, through: &[(u32, u32)]) -> bool {
        let mut parts = Parts::new(2, Duration::from_seconds(60));
        let mut tell = |robot: Option<u32>, event: Event| {
            let robot = robot.map(RobotId);
            let at = Time::ZERO;
            parts.observe(&Record { at, robot, event });
        };
        tell(None, Event::Fault(cut));
        for from in 0..2 {
            let sent = Event::Sent {
                sequence: 0,
                destination: Destination::All,
                port: Port::named("any"),
                payload: Payload::new(),
            };
            tell(Some(from), sent);
        }
        for &(from, to) in through {
            let from = RobotId(from);
            tell(Some(to), Event::Delivered { from, sequence: 0 });
        }
        parts.together_since(RobotId(0), RobotId(1)) != Time::NEVER
    }

    #[test]
    fn a_robot_that_is_heard_is_in_the_same_part() {
        assert!(!together_after(Fault::Partition, &[]));
        assert!(together_after(Fault::Partition, &[(0, 1)]));
    }

    #[test]
    fn a_robot_that_is_heard_and_does_not_hear_may_be_apart() {
        assert!(!together_after(Fault::OneWay, &[(0, 1)]));
        assert!(together_after(Fault::OneWay, &[(0, 1), (1, 0)]));
    }
}
