//! Undoes states that only a corruption can cause.

use super::packet::NO_VIEW;
use super::{LATEST, Registration, Stage};
use starl_core::{Robot, Time};

impl Registration {
    /// Repairs states that only a corruption can cause: timers that are not armed, and a promise that cannot lead to a
    /// list.
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
            self.latest = Time::ZERO;
            if self.own.is_some() {
                self.open(robot, self.options.settle);
            }
        }
        let is_off = |at: Time| at + longest < now || now + longest < at;
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
}
