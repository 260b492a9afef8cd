//! The part of all others in an agreement: accepting a list, waiting to hear that all have, showing it.
//!
//! Invariant: a robot that has accepted a list shows no earlier one.

use super::announcing::is_possible;
use super::packet::{NO_VIEW, Packet, Roll, View, ViewId};
use super::{Alarm, Registration, Stage};
use alloc::collections::BTreeSet;
use alloc::vec::Vec;
use starl_core::event::RegistrationEvent;
use starl_core::{Destination, Duration, Robot, RobotId};

impl Registration {
    /// Another robot proposes a list.
    pub(super) fn consider(&mut self, robot: &mut Robot<'_>, from: RobotId, view: View) {
        if !is_possible(&view, from, self.options.most_members) {
            return;
        }
        self.is_gone(robot, view.id, &view.roll);
        let ticket = self.own.as_ref().map(|own| own.ticket);
        let Some(&named) = view.roll.get(&robot.id()) else {
            let shown = self.view_id().filter(|shown| *shown < view.id);
            if shown.is_some_and(|shown| shown.coordinator == from) {
                self.lose(robot);
            }
            return;
        };
        if Some(named) != ticket {
            return self.deny(robot, Destination::Robot(from), named);
        }
        if let Some(&ticket) = view.roll.get(&from)
            && self.past.is_over(from, ticket)
        {
            // It has left since, and would not say that all have accepted.
            let over = Packet::Over { ticket };
            return robot.transmit(Destination::Robot(from), self.port, &over);
        }
        self.hear_time(view.id.time);
        self.shunned.remove(&from);
        self.hear_of(robot, &view.roll);
        if view.id == self.promised {
            match &self.stage {
                Stage::Agreed { view: known, .. } | Stage::Accepted { view: known, .. }
                    if known.roll == view.roll => {}
                _ => self.accept(robot, view),
            }
            self.send_acceptance(robot);
        } else if self.promised == NO_VIEW || view.id.time >= self.promised.time + self.apart() {
            self.accept(robot, view);
            self.send_acceptance(robot);
        } else {
            let refusal = Packet::Refuse {
                id: view.id,
                promised: self.promised,
                also: self.others_than(&view.roll),
            };
            robot.transmit(Destination::Robot(from), self.port, &refusal);
        }
    }

    fn accept(&mut self, robot: &mut Robot<'_>, view: View) {
        self.promise(robot, view.id);
        let list = view.id.into();
        robot.report(self.port, RegistrationEvent::Accept { list });
        self.stage = Stage::Accepted {
            view,
            repetitions: 0,
        };
    }

    fn send_acceptance(&mut self, robot: &mut Robot<'_>) {
        let (Stage::Accepted { view, .. } | Stage::Agreed { view, .. }) = &self.stage else {
            return;
        };
        let acceptance = Packet::Accept {
            id: view.id,
            also: self.others_than(&view.roll),
        };
        let coordinator = Destination::Robot(view.id.coordinator);
        robot.transmit(coordinator, self.port, &acceptance);
        if let Stage::Accepted { repetitions, .. } = &self.stage {
            let timeout = self.options.timeout(*repetitions);
            self.look_within(robot, timeout);
        }
    }

    pub(super) fn accept_again(&mut self, robot: &mut Robot<'_>) {
        let Stage::Accepted { view, repetitions } = &mut self.stage else {
            return;
        };
        *repetitions = repetitions.saturating_add(1);
        let coordinator = view.id.coordinator;
        // The coordinator gives up first, on those that do not answer it.
        if *repetitions <= self.options.repetitions.saturating_mul(2) {
            return self.send_acceptance(robot);
        }
        self.shun(robot, coordinator);
        self.open(robot, self.options.settle);
    }

    /// A robot has changed to a later list.
    pub(super) fn refused(
        &mut self,
        robot: &mut Robot<'_>,
        from: RobotId,
        id: ViewId,
        promised: ViewId,
        also: &Roll,
    ) {
        self.hear_time(promised.time);
        self.hear_of(robot, also);
        let concerns = |view: &View| view.id == id && view.roll.contains_key(&from);
        match &self.stage {
            Stage::Proposed { view, .. } if concerns(view) => {
                // Two that compute lists at once do not continue at once.
                let wait = self.options.settle.seconds() * robot.random().uniform();
                self.open(robot, Duration::from_seconds_f64(wait));
            }
            Stage::Accepted { view, .. } if concerns(view) && from == id.coordinator => {
                self.open(robot, self.options.settle);
            }
            Stage::Agreed { view, .. } if concerns(view) && promised > id => self.lose(robot),
            _ => {}
        }
    }

    pub(super) fn committed(&mut self, robot: &mut Robot<'_>, from: RobotId, id: ViewId) {
        if let Stage::Accepted { view, .. } = &self.stage
            && view.id == id
            && id.coordinator == from
        {
            let view = view.clone();
            self.show(robot, view);
        }
    }

    pub(super) fn show(&mut self, robot: &mut Robot<'_>, view: View) {
        let members: BTreeSet<RobotId> = view.roll.keys().copied().collect();
        let listed: Vec<RobotId> = members.iter().copied().collect();
        self.rest(robot);
        let agree = RegistrationEvent::Agree {
            list: view.id.into(),
            members: listed,
        };
        robot.report(self.port, agree);
        for peer in &members {
            if let Some(known) = self.peers.get_mut(peer) {
                known.led_by = Some(view.id.coordinator);
            }
        }
        let wanted = self.wanted(robot);
        self.failed = false;
        robot.cancel_timer(self.timer(Alarm::Patience));
        let is_complete = wanted == view.roll;
        self.stage = Stage::Agreed {
            view,
            members,
            heard: false,
        };
        self.begin_announcing(robot, false);
        if !is_complete {
            self.look_within(robot, self.options.settle);
        }
    }

    /// There is no list now; another may be computed after this time.
    pub(super) fn open(&mut self, robot: &mut Robot<'_>, wait: Duration) {
        let had_list = self.members().is_some();
        self.stage = Stage::Open;
        self.rest(robot);
        if had_list {
            robot.report(self.port, RegistrationEvent::Lose);
            self.set(robot, Alarm::Patience, self.options.patience);
            self.begin_announcing(robot, true);
        }
        self.look_within(robot, wait);
    }
}
