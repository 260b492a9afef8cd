//! Actions with `atomic` in a program: tried on a copy, stored, and then performed; and the parts that wait meanwhile.
//!
//! Invariant: between the trial and the execution of an action no part runs that conflicts with it ([`Conflicts`](super::atomic::Conflicts)), so
//! that it takes the same path.

use super::atomic::{Script, Step, Values};
use super::context::Context;
use super::failure::Failure;
use super::host::RobotHost;
use super::program::{Part, Phase, RobotProgram, Waiting};
use super::reports::MOST_WAITING;
use super::workbench::Workbench;
use crate::machine::{Limits, Machine};
use alloc::format;
use alloc::string::ToString;
use alloc::vec::Vec;
use starl_core::event::Level;
use starl_core::{Message, Order, Robot};

impl RobotProgram {
    /// Continues the waiting action with `atomic`, as far as possible now.
    pub(super) fn go_on(&mut self, robot: &mut Robot<'_>) {
        let code = self.code.clone();
        while self.phase == Phase::Running
            && let Some(atomic) = &mut self.services.atomic
            && let Some(step) = atomic.go_on(robot, code.groups())
        {
            match step {
                Step::Try(action, values) => {
                    self.catch_up(robot);
                    if self.phase != Phase::Running {
                        return;
                    }
                    let tried = self.rehearse(robot, action, values);
                    if let Err(reason) = self.store(robot, tried) {
                        self.fail(robot, reason);
                    }
                }
                Step::Perform(action, script) => {
                    // So that it has all the fuel that it was tried with.
                    if !self.reports.is_empty() {
                        self.run(robot, Part::Nothing);
                    }
                    self.run(robot, Part::Perform(action, script));
                    if let Some(atomic) = &mut self.services.atomic {
                        atomic.release(robot, code.groups());
                    }
                }
            }
        }
        self.catch_up(robot);
    }

    /// Finds out what an action writes, without any effect; none if its guard does not hold.
    fn rehearse(
        &mut self,
        robot: &mut Robot<'_>,
        action: u32,
        values: Values,
    ) -> Result<Option<(Values, Script)>, Failure> {
        let code = &self.code;
        let (mut state, mut bound) = (self.state.clone(), self.bound.clone());
        let mut services = self.services.clone();
        if let (Some(atomic), Some(group)) = (&mut services.atomic, code.groups().of_action(action))
        {
            atomic.open(group, values);
        }
        robot.rehearse(|robot| {
            let Workbench { workspace, memo } = &mut Workbench::default();
            let mut host = RobotHost {
                context: Context::new(code, robot, memo, &mut services),
                bound: &mut bound,
                failure: None,
                has_fired: false,
                script: Script::Noted(Vec::new()),
            };
            let (program, limits) = (code.program(), Limits::default());
            let result =
                Machine::new(program, &mut state, workspace, &mut host, limits).action(action);
            let (failure, script) = (host.failure, host.script);
            match result {
                Ok(true) => Ok(services
                    .atomic
                    .map(|mut atomic| (atomic.take_values(), script.follow()))),
                Ok(false) => Ok(None),
                Err(error) => Err(failure.unwrap_or_else(|| code.describe(&error))),
            }
        })
    }

    /// Has stored what an action writes that was tried.
    fn store(
        &mut self,
        robot: &mut Robot<'_>,
        tried: Result<Option<(Values, Script)>, Failure>,
    ) -> Result<(), Failure> {
        let tried = tried?;
        match &mut self.services.atomic {
            Some(atomic) if self.phase == Phase::Running => atomic
                .store(robot, self.code.groups(), tried)
                .map_err(Failure::NotStored),
            _ => Ok(()),
        }
    }

    /// Whether a message must wait until an action with `atomic` has taken place.
    pub(super) fn must_wait(&self, message: &Message) -> bool {
        if self.code.held(&self.services).is_none() {
            return false;
        }
        let program = self.code.program();
        let arrival = self.code.inbox().decode(program, &message.payload);
        arrival.is_some_and(|arrival| self.holds(arrival.handlers))
    }

    /// Whether an event with these handlers must wait until an action with `atomic` has taken place.
    pub(super) fn holds(&self, handlers: &[u32]) -> bool {
        self.code.held(&self.services).is_some_and(|held| {
            let mut handlers = handlers.iter();
            !self.waiting.is_empty() || handlers.any(|&handler| held.keeps_handler(handler))
        })
    }

    /// Has a message or an order wait.
    pub(super) fn keep_waiting(&mut self, waiting: Waiting) {
        self.waiting.push_back(waiting);
        if self.waiting.len() > MOST_WAITING {
            self.waiting.pop_front();
        }
    }

    /// Runs the handlers of an order, unless they must wait for an action with `atomic`.
    pub(super) fn follow(&mut self, robot: &mut Robot<'_>, order: &Order) {
        if self.phase != Phase::Running {
            return;
        }
        let code = self.code.clone();
        match code.orders().decode(code.program(), order) {
            Ok(Some(arrival)) if self.holds(arrival.handlers) => {
                self.keep_waiting(Waiting::Order(order.clone()));
            }
            Ok(Some(arrival)) => self.run(robot, Part::Order(arrival)),
            Ok(None) if order.name == Order::WAY_POINTS => {}
            Ok(None) => {
                let text = format!("order `{}` ignored: it has no handler", order.name);
                robot.log(Level::Debug, text);
            }
            Err(wrong) => robot.log(Level::Warning, wrong.to_string()),
        }
    }

    /// Handles what had to wait, if it need not any longer.
    fn catch_up(&mut self, robot: &mut Robot<'_>) {
        if self.code.held(&self.services).is_some() {
            return;
        }
        if !self.reports.is_empty() {
            self.run(robot, Part::Nothing);
        }
        while let Some(waiting) = self.waiting.pop_front() {
            match waiting {
                Waiting::Message(message) => self.run(robot, Part::Message(&message)),
                Waiting::Order(order) => self.follow(robot, &order),
            }
        }
    }
}
