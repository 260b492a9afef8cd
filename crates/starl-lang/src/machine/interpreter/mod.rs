//! Running parts of a program: what hosts call.

mod execute;
mod lists;
mod maps;
mod objects;
pub(in crate::machine) mod scalar;
mod sets;
mod texts;
mod view;
pub(in crate::machine) mod workspace;

use crate::machine::error::{Fault, RuntimeError};
use crate::machine::host::Host;
use crate::machine::instruction::Instruction;
use crate::machine::interpreter::execute::Execution;
use crate::machine::interpreter::view::Meter;
use crate::machine::interpreter::workspace::Workspace;
use crate::machine::program::Program;
use crate::machine::types::Layout;
use crate::machine::value::object::Object;
use crate::machine::value::state::State;
use starl_core::RobotId;

/// The limits of one activation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Units of fuel; see [`Instruction`] for what costs how many.
    pub fuel: u64,
    /// Bytes that the state's objects and the values worked on may take together, counted as if
    /// nothing were shared.
    pub memory: usize,
}

impl Default for Limits {
    /// 100,000 instructions and 1 MiB.
    fn default() -> Limits {
        Limits {
            fuel: 100_000,
            memory: 1 << 20,
        }
    }
}

/// One activation of one robot's program. All procedures of the activation share its limits.
///
/// After an error the state is as the program left it: the robot's program should not be run again.
pub struct Machine<'a> {
    execution: Execution<'a>,
}

impl<'a> Machine<'a> {
    /// A machine that runs the program on this state, which must be one of the program's.
    pub fn new(
        program: &'a Program,
        state: &'a mut State,
        workspace: &'a mut Workspace,
        host: &'a mut dyn Host,
        limits: Limits,
    ) -> Machine<'a> {
        Machine {
            execution: Execution {
                program,
                state,
                workspace,
                host,
                meter: Meter {
                    fuel: limits.fuel,
                    budget: limits.memory,
                    spare: 0,
                },
            },
        }
    }

    /// The fuel that is left.
    pub fn fuel(&self) -> u64 {
        self.execution.meter.fuel
    }

    /// The state as it is now.
    pub fn state(&self) -> &State {
        self.execution.state
    }

    /// Gives parameters their default values. Others may then be put into the state, see
    /// [`Program::set`], before the start.
    pub fn defaults(&mut self) -> Result<(), RuntimeError> {
        match self.execution.program.bytecode.defaults {
            Some(defaults) => self.call(defaults, &[], &[]).map(|_| ()),
            None => Ok(()),
        }
    }

    /// Gives variables their values, binds primitives and runs the program's `init`.
    pub fn start(&mut self) -> Result<(), RuntimeError> {
        match self.execution.program.bytecode.start {
            Some(start) => self.call(start, &[], &[]).map(|_| ()),
            None => Ok(()),
        }
    }

    /// Runs the effect of an action if its guard holds; whether it did.
    pub fn action(&mut self, index: u32) -> Result<bool, RuntimeError> {
        if !self.guard(index)? {
            return Ok(false);
        }
        let action = self.execution.program.bytecode.actions.get(index as usize);
        match action {
            Some(action) => {
                self.execution.host.fires(index);
                // The bindings follow the guard's Bool: they are the effect's first registers.
                self.run(action.effect, 1).map(|()| true)
            }
            None => Ok(false),
        }
    }

    /// Runs the effect of an action without bindings if its guard holds or cannot be computed; whether it did. `first`
    /// sees the state before that.
    pub fn check(&mut self, index: u32, first: impl FnOnce(&State)) -> Result<bool, RuntimeError> {
        let fails = self.guard(index).unwrap_or(true);
        let action = self.execution.program.bytecode.actions.get(index as usize);
        match action.filter(|_| fails) {
            Some(action) => {
                first(self.execution.state);
                self.execution.host.fires(index);
                self.call(action.effect, &[], &[]).map(|_| true)
            }
            None => Ok(false),
        }
    }

    /// Whether the guard of an action holds. Changes nothing.
    pub fn guard(&mut self, index: u32) -> Result<bool, RuntimeError> {
        let action = self.execution.program.bytecode.actions.get(index as usize);
        match action {
            Some(action) => {
                let guard = action.guard;
                if self.is_ruled_out(guard) {
                    return Ok(false);
                }
                self.execution.workspace.clear();
                self.run(guard, 0)?;
                let holds = self.execution.workspace.scalars.first();
                Ok(holds.is_some_and(|&holds| holds != 0))
            }
            None => Ok(false),
        }
    }

    /// Whether the first instruction of a guard shows that it does not hold. Most guards ask first in which
    /// state the program is, and most are not of that state: these are not worth a run.
    fn is_ruled_out(&mut self, guard: u32) -> bool {
        let Execution { program, state, .. } = &self.execution;
        let instruction = |place: u32| program.bytecode.code.get(place as usize);
        let entry = program.entries.get(guard as usize);
        let Some(&Instruction::JumpIfStateNot {
            right,
            target,
            variable,
        }) = entry.and_then(|&entry| instruction(entry))
        else {
            return false;
        };
        let leaves = matches!(instruction(target.0), Some(Instruction::ReturnFalse { .. }));
        let value = state.scalars.get(usize::from(variable.0));
        let differs = value.is_some_and(|&value| value as i64 != i64::from(right.0));
        // Both instructions are paid for; without the fuel it is run, and stops there.
        let rest = self.execution.meter.fuel.checked_sub(2);
        match rest.filter(|_| leaves && differs) {
            Some(rest) => {
                self.execution.meter.fuel = rest;
                true
            }
            None => false,
        }
    }

    /// Runs a handler with the scalars and objects of its arguments.
    pub fn handler(
        &mut self,
        index: u32,
        scalars: &[u64],
        objects: &[Object],
    ) -> Result<(), RuntimeError> {
        let handler = self.execution.program.bytecode.handlers.get(index as usize);
        match handler {
            Some(handler) => self.call(handler.function, scalars, objects).map(|_| ()),
            None => Ok(()),
        }
    }

    /// Runs a function with the scalars and objects of its arguments; gives those of its results.
    /// Arguments that do not fit the function are [`Fault::Malformed`].
    pub fn call(
        &mut self,
        function: u32,
        scalars: &[u64],
        objects: &[Object],
    ) -> Result<(&[u64], &[Object]), RuntimeError> {
        let program = self.execution.program;
        let Some(called) = program.layouts.get(function as usize) else {
            return Err(malformed(program, function));
        };
        let (arguments, results) = called;
        if arguments.scalars.len() != scalars.len() || arguments.objects.len() != objects.len() {
            return Err(malformed(program, function));
        }
        let workspace = &mut *self.execution.workspace;
        workspace.clear();
        workspace.scalars[..scalars.len()].copy_from_slice(scalars);
        workspace.objects[..objects.len()].clone_from_slice(objects);
        workspace.used |= !objects.is_empty();
        self.run(function, 0)?;
        Ok(self.results(results))
    }

    fn results(&self, results: &Layout) -> (&[u64], &[Object]) {
        let workspace = &*self.execution.workspace;
        (
            &workspace.scalars[..results.scalars.len()],
            &workspace.objects[..results.objects.len()],
        )
    }

    fn run(&mut self, function: u32, base: usize) -> Result<(), RuntimeError> {
        let program = self.execution.program;
        let called = program.bytecode.functions.get(function as usize);
        let uses_objects = called.is_some_and(|called| called.object_registers > 0);
        self.execution.workspace.used |= uses_objects;
        let result = self.execution.run(function, base, 0);
        match &result {
            Ok(()) => {
                // A function empties its registers but those of its results.
                let results = program.layouts.get(function as usize);
                self.execution.workspace.used = results.is_some_and(|(_, r)| !r.objects.is_empty());
            }
            Err(_) => self.execution.workspace.clear(),
        }
        result
    }

    /// Evaluates a claim, a function of kind property, for these robots, whose states the host provides. Changes
    /// nothing.
    pub fn holds(
        program: &Program,
        function: u32,
        robots: &[RobotId],
        workspace: &mut Workspace,
        host: &mut dyn Host,
        limits: Limits,
    ) -> Result<bool, RuntimeError> {
        let mut arguments = [0; MOST_ROBOTS];
        let Some(arguments) = arguments.get_mut(..robots.len()) else {
            return Err(malformed(program, function));
        };
        for (argument, robot) in arguments.iter_mut().zip(robots) {
            *argument = u64::from(robot.0);
        }
        let mut none = State::default(); // properties do not touch a state of their own
        let mut machine = Machine::new(program, &mut none, workspace, host, limits);
        let (scalars, _) = machine.call(function, arguments, &[])?;
        Ok(scalars.first().is_some_and(|&holds| holds != 0))
    }
}

/// The most robots that a property quantifies over at once.
const MOST_ROBOTS: usize = 255;

fn malformed(program: &Program, function: u32) -> RuntimeError {
    RuntimeError {
        fault: Fault::Malformed,
        position: program.entries.get(function as usize).copied().unwrap_or(0),
    }
}
