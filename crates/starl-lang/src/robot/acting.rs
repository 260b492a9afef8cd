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
use super::services::Services;
use super::workbench::Workbench;
use crate::machine::{Limits, Machine, RuntimeError};
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
        let mut services = self.services.clone();
        let group = self.code.groups().of_action(action);
        if let (Some(atomic), Some(group)) = (&mut services.atomic, group) {
            atomic.open(group, values);
        }
        let noted = Script::Noted(Vec::new());
        let (fires, script) = self.on_copy(robot, &mut services, noted, |machine| {
            machine.action(action)
        });
        let atomic = services.atomic.filter(|_| fires == Ok(true));
        fires?;
        Ok(atomic.map(|mut atomic| (atomic.take_values(), script.follow())))
    }

    /// Runs a part of the program on a copy of it, which shares only these services. Returns its result and the calls
    /// that the script has noted.
    pub(super) fn on_copy<T>(
        &self,
        robot: &mut Robot<'_>,
        services: &mut Services,
        script: Script,
        run: impl FnOnce(&mut Machine<'_>) -> Result<T, RuntimeError>,
    ) -> (Result<T, Failure>, Script) {
        let code = &self.code;
        let (mut state, mut bound) = (self.state.clone(), self.bound.clone());
        robot.rehearse(|robot| {
            let Workbench { workspace, memo } = &mut Workbench::default();
            let context = Context::new(code, robot, memo, services);
            let mut host = RobotHost::new(context, &mut bound, script);
            let (program, limits) = (code.program(), Limits::default());
            let result = run(&mut Machine::new(
                program, &mut state, workspace, &mut host, limits,
            ));
            let (failure, script) = (host.failure, host.script);
            let result = result.map_err(|error| failure.unwrap_or_else(|| code.describe(&error)));
            (result, script)
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
