//! The coordinator's part of an agreement: proposing a list, collecting acceptances, announcing the
//! result.
//!
//! Invariants:
//! - a list is committed only when all in it have accepted it;
//! - lists of different coordinators never have the same time, and those of one life of a coordinator rise. Its next
//!   life makes no list before `gather` has passed, and no list is dated further ahead than that, unless clocks differ
//!   by more than `longest_timeout`. Then two lives may date lists alike by chance.

use super::packet::{Packet, Roll, View, ViewId};
use super::{Alarm, Registration, Stage};
use alloc::collections::BTreeSet;
use alloc::vec::Vec;
use starl_core::event::RegistrationEvent;
use starl_core::{Destination, Duration, Robot, RobotId, Time};

/// The remainder of a list's time by this number of nanoseconds, about a millisecond, is the coordinator's number. So
/// lists of different coordinators differ in their times.
const COORDINATORS: u64 = 1 << 20;

impl Registration {
    /// Computes a list, if a new one is needed and this robot is the coordinator.
    pub(super) fn look(&mut self, robot: &mut Robot<'_>) {
        let Some(own) = &self.own else { return };
        let left = own.gathers_until.since(robot.now());
        if !left.is_zero() {
            let left = left.min(self.options.gather);
            return self.look_within(robot, left);
        }
        if self.leader(robot.id()) != robot.id() {
            return;
        }
        let wanted = self.wanted(robot);
        match &self.stage {
            Stage::Agreed { view, .. } if view.roll == wanted => {}
            _ => self.propose(robot, wanted),
        }
    }

    /// The time of a list that this robot computes now.
    fn next_time(&mut self, robot: &mut Robot<'_>) -> Time {
        self.hear_time(self.promised.time);
        let mut earliest = robot.now().max(self.latest + self.apart());
        if earliest > robot.now() + self.options.gather + self.options.longest_timeout {
            // An earlier life of this robot may have continued from the same list.
            let spread = self.apart().seconds() * robot.random().uniform();
            earliest += Duration::from_seconds_f64(spread);
        }
        let own = u64::from(robot.id().0) % COORDINATORS;
        let later = (own + COORDINATORS - earliest.0 % COORDINATORS) % COORDINATORS;
        earliest + Duration(later)
    }

    fn propose(&mut self, robot: &mut Robot<'_>, roll: Roll) {
        let time = self.next_time(robot);
        let early = time.since(robot.now() + self.options.gather);
        if !early.is_zero() && early <= self.options.longest_timeout {
            return self.look_within(robot, early);
        }
        let id = ViewId {
            time,
            coordinator: robot.id(),
            incarnation: self.incarnation.of(robot),
        };
        self.promise(robot, id);
        let members: Vec<RobotId> = roll.keys().copied().collect();
        let list = id.into();
        robot.report(self.port, RegistrationEvent::Propose { list, members });
        let missing = roll.keys().copied().filter(|&peer| peer != robot.id());
        let missing: BTreeSet<RobotId> = missing.collect();
        let view = View { id, roll };
        if missing.is_empty() {
            return self.show(robot, view);
        }
        self.stage = Stage::Proposed {
            view,
            missing,
            repetitions: 0,
        };
        self.send_proposal(robot);
    }

    /// From now on no list before this one is shown.
    pub(super) fn promise(&mut self, robot: &mut Robot<'_>, id: ViewId) {
        self.promised = id;
        self.hear_time(id.time);
        self.rest(robot);
        if self.members().is_some() {
            self.stage = Stage::Open;
            self.set(robot, Alarm::Patience, self.options.patience);
            self.begin_announcing(robot, false);
        }
    }

    fn send_proposal(&mut self, robot: &mut Robot<'_>) {
        let Stage::Proposed {
            view,
            missing,
            repetitions,
        } = &mut self.stage
        else {
            return;
        };
        let timeout = self.options.timeout(*repetitions);
        *repetitions = repetitions.saturating_add(1);
        let proposal = Packet::Propose(view.clone());
        let missing: Vec<RobotId> = missing.iter().copied().collect();
        self.send(robot, &missing, &proposal);
        self.look_within(robot, timeout);
    }

    /// To all at once where that takes fewer datagrams; it means something to those alone.
    fn send(&self, robot: &mut Robot<'_>, to: &[RobotId], packet: &Packet) {
        if 2 * to.len() >= robot.peers().count() {
            robot.transmit(Destination::All, self.port, packet);
        } else {
            for &peer in to {
                robot.transmit(Destination::Robot(peer), self.port, packet);
            }
        }
    }

    pub(super) fn propose_again(&mut self, robot: &mut Robot<'_>) {
        let Stage::Proposed {
            missing,
            repetitions,
            ..
        } = &self.stage
        else {
            return;
        };
        if *repetitions <= self.options.repetitions {
            return self.send_proposal(robot);
        }
        for peer in missing.clone() {
            self.shun(robot, peer);
        }
        self.open(robot, Duration::ZERO);
    }

    /// A robot has accepted a list of this one.
    pub(super) fn accepted(
        &mut self,
        robot: &mut Robot<'_>,
        from: RobotId,
        id: ViewId,
        also: &Roll,
    ) {
        let is_news = self.hear_of(robot, also);
        self.shunned.remove(&from);
        match &mut self.stage {
            Stage::Proposed { view, missing, .. } if view.id == id => {
                missing.remove(&from);
                if missing.is_empty() {
                    let view = view.clone();
                    let others: Vec<RobotId> = view.roll.keys().copied().collect();
                    let others: Vec<RobotId> = others
                        .into_iter()
                        .filter(|&peer| peer != robot.id())
                        .collect();
                    self.send(robot, &others, &Packet::Commit(view.id));
                    self.show(robot, view);
                }
            }
            Stage::Agreed { view, .. } if view.id == id => {
                if is_news {
                    self.look_within(robot, self.options.settle);
                } else if id.coordinator == robot.id() && view.roll.contains_key(&from) {
                    robot.transmit(Destination::Robot(from), self.port, &Packet::Commit(id));
                }
            }
            // It has given that list up.
            _ if id.coordinator == robot.id() => {
                let refusal = Packet::Refuse {
                    id,
                    promised: self.promised,
                    also: Roll::new(),
                };
                robot.transmit(Destination::Robot(from), self.port, &refusal);
            }
            _ => {}
        }
    }

    /// How far the times of lists are apart at least.
    pub(super) fn apart(&self) -> Duration {
        self.options.settle.max(Duration(1))
    }
}
