//! Runs an algorithm: the participants, changes, timeouts, and elections that take too long.

use super::epoch::Epoch;
use super::rules::{Leadership, Rules, Scene};
use super::{Algorithm, Change, LeaderElection, MOST_CHANGES};
use starl_core::event::ElectionEvent;
use starl_core::{Duration, Robot, RobotId, Time, TimerKey, timers};

timers! {
    enum Alarm {
        /// The algorithm has something to do.
        Look,
    }
}

impl LeaderElection {
    pub(super) fn begin(&mut self, robot: &mut Robot<'_>) {
        self.meet(robot);
        if self.has_begun {
            return;
        }
        self.has_begun = true;
        let mut participants = self.others.clone();
        if self.takes_part {
            participants.push(robot.id());
            participants.sort_unstable();
        }
        let start = ElectionEvent::Start {
            algorithm: self.options.algorithm,
            participants,
        };
        robot.report(self.port, start);
    }

    /// Determines the participants.
    fn meet(&mut self, robot: &Robot<'_>) {
        let (me, fleet) = (robot.id(), robot.fleet());
        if self.has_begun && fleet.len() == self.fleet_size {
            return;
        }
        self.fleet_size = fleet.len();
        let is_admitted = |robot: &RobotId| match self.options.algorithm {
            Algorithm::Leases => Epoch::fits(*robot),
            _ => true,
        };
        self.others = match &self.participants {
            Some(participants) => participants.iter().copied().collect(),
            None => fleet.to_vec(),
        };
        self.others.retain(is_admitted);
        self.takes_part = self.others.contains(&me);
        self.others.retain(|&peer| peer != me);
    }

    /// Has the algorithm do something.
    pub(super) fn run(
        &mut self,
        robot: &mut Robot<'_>,
        what: impl FnOnce(&mut dyn Rules, &mut Scene<'_, '_>),
    ) {
        let mut scene = Scene {
            robot,
            port: self.port,
            options: &self.options,
            others: &self.others,
            takes_part: self.takes_part,
            stands: self.called && self.takes_part,
            suspects: &self.suspects,
        };
        what(self.rules.rules_mut(), &mut scene);
    }

    /// Performs the due steps, reports changes, and arms the timer of the next step.
    pub(super) fn settle(&mut self, robot: &mut Robot<'_>) {
        let mut due = Time::NEVER;
        self.run(robot, |rules, scene| {
            rules.settle(scene);
            due = rules.due(scene);
        });
        self.report(robot);
        let give_up = self.watch(robot);
        self.arm(robot, due.min(give_up));
    }

    fn report(&mut self, robot: &mut Robot<'_>) {
        let now_shown = self.rules.rules().leadership(robot.id());
        if now_shown == self.shown {
            return;
        }
        let before = core::mem::replace(&mut self.shown, now_shown);
        let change = match (before, now_shown) {
            (None, None) => return,
            (Some(before), None) => {
                robot.report(self.port, ElectionEvent::Lost);
                Change::Lost(before.leader)
            }
            (_, Some(Leadership { leader, epoch })) => {
                let (round, ballot) = self.rules.rules().ballot().unzip();
                let shown = ElectionEvent::Leader {
                    leader,
                    epoch,
                    round,
                    ballot,
                };
                robot.report(self.port, shown);
                Change::Elected(leader)
            }
        };
        if self.changes.len() == MOST_CHANGES {
            self.changes.pop_front();
        }
        self.changes.push_back(change);
    }

    /// Notices that an election takes too long; gives when it will.
    fn watch(&mut self, robot: &mut Robot<'_>) -> Time {
        let now = robot.now();
        let mut due = Time::NEVER;
        let mut failed = self.called && !self.takes_part;
        if self.called && self.takes_part && self.shown.is_none() {
            let since = self.leaderless.get_or_insert(now);
            *since = (*since).min(now);
            let at = *since + self.options.give_up;
            failed = now >= at;
            if !failed {
                due = at;
            }
        } else {
            self.leaderless = None;
        }
        if failed && !self.failed {
            robot.report(self.port, ElectionEvent::Fail);
        }
        self.failed = failed;
        due
    }

    fn arm(&mut self, robot: &mut Robot<'_>, due: Time) {
        if due == Time::NEVER {
            if self.armed.take().is_some() {
                robot.cancel_timer(self.timer());
            }
        } else if self.armed != Some(due) {
            self.armed = Some(due);
            let after = due.since(robot.now()).max(Duration::from_millis(1));
            robot.set_timer(self.timer(), after);
        }
    }

    pub(super) fn timer(&self) -> TimerKey {
        TimerKey::new(self.port, Alarm::Look)
    }
}
