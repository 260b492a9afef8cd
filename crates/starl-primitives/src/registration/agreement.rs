//! How a list comes to be agreed on: proposing, accepting, committing.
//!
//! Invariant: a list is shown only if all in it have accepted it, and who has accepted a list shows no
//! earlier one.

use super::announcing::is_possible;
use super::packet::{NO_VIEW, Packet, Roll, View, ViewId};
use super::{Alarm, KIND, LATEST, Registration, Stage};
use alloc::collections::BTreeSet;
use alloc::vec::Vec;
use starl_core::event::Value;
use starl_core::{Destination, Duration, Robot, RobotId};

impl Registration {
    /// Computes a list, if there is to be another one and this robot is to do it.
    pub(super) fn look(&mut self, robot: &mut Robot<'_>) {
        let Some(own) = &self.own else { return };
        let left = own.gathers_until.since(robot.now());
        if matches!(self.stage, Stage::Open) && !left.is_zero() {
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

    fn propose(&mut self, robot: &mut Robot<'_>, roll: Roll) {
        self.hear_time(self.promised.time);
        let id = ViewId {
            time: robot.now().max(self.latest + self.apart()),
            coordinator: robot.id(),
            incarnation: self.incarnation.of(robot),
        };
        self.promise(robot, id);
        let members: Vec<RobotId> = roll.keys().copied().collect();
        self.report(robot, "propose", id, Some(members));
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
    fn promise(&mut self, robot: &mut Robot<'_>, id: ViewId) {
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
        if 2 * to.len() > robot.peers().count() {
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
        self.report(robot, "accept", view.id, None);
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
            _ if id.coordinator == robot.id() && id < self.promised => {
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

    /// A robot has gone on to a later list.
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
                // Two that compute lists at once do not go on at once.
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

    fn show(&mut self, robot: &mut Robot<'_>, view: View) {
        let members: BTreeSet<RobotId> = view.roll.keys().copied().collect();
        let listed: Vec<RobotId> = members.iter().copied().collect();
        self.rest(robot);
        self.report(robot, "agree", view.id, Some(listed));
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

    /// There is no list for now; another one may be computed after this time.
    pub(super) fn open(&mut self, robot: &mut Robot<'_>, wait: Duration) {
        let had_list = self.members().is_some();
        self.stage = Stage::Open;
        self.rest(robot);
        if had_list {
            robot.emit_primitive(KIND, self.port, "lose", []);
            self.set(robot, Alarm::Patience, self.options.patience);
            self.begin_announcing(robot, true);
        }
        self.look_within(robot, wait);
    }

    /// How far the times of lists are apart at least.
    fn apart(&self) -> Duration {
        self.options.settle.max(Duration(1))
    }

    /// Undoes what only a corruption of the state can have brought about: alarms that are not set, and a
    /// promise of which no list could come.
    pub(super) fn set_right(&mut self, robot: &mut Robot<'_>) {
        let now = robot.now();
        let longest = self
            .options
            .longest_interval
            .max(self.options.longest_timeout)
            * 8;
        let gather = self.options.gather;
        if let Some(own) = &mut self.own
            && own.gathers_until > now + gather
        {
            own.gathers_until = now;
        }
        self.failed &= self.own.is_some() && self.members().is_none();
        if self.promised.time > LATEST || self.latest > LATEST {
            self.promised = NO_VIEW;
            self.latest = self.latest.min(LATEST);
            if self.own.is_some() {
                self.open(robot, self.options.settle);
            }
        }
        let is_off = |at: starl_core::Time| at + longest < now || now + longest < at;
        if self.own.is_some() && is_off(self.announces_at) {
            self.announce(robot);
        }
        if self.due.is_some_and(is_off) {
            self.act(robot);
        }
    }

    /// Undoes what only a corruption can have done to a list that is shown.
    pub(super) fn set_list_right(&mut self, robot: &mut Robot<'_>) {
        let Stage::Agreed { view, members, .. } = &self.stage else {
            return;
        };
        let ticket = self.own.as_ref().map(|own| own.ticket);
        let is_right = view.id == self.promised
            && view.roll.get(&robot.id()).copied() == ticket
            && view.roll.keys().eq(members.iter());
        if !is_right {
            self.lose(robot);
        }
    }

    fn report(
        &self,
        robot: &mut Robot<'_>,
        event: &'static str,
        id: ViewId,
        members: Option<Vec<RobotId>>,
    ) {
        let time = ("time", Value::Time(id.time));
        let coordinator = ("coordinator", id.coordinator.into());
        let incarnation = ("incarnation", id.incarnation.into());
        match members {
            None => {
                let fields = [time, coordinator, incarnation];
                robot.emit_primitive(KIND, self.port, event, fields);
            }
            Some(members) => {
                let members = ("members", members.into());
                let fields = [time, coordinator, incarnation, members];
                robot.emit_primitive(KIND, self.port, event, fields);
            }
        }
    }
}
