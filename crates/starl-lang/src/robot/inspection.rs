//! Inspects a program that runs on a robot, without changing it: for observers and debuggers.

use super::atomic::Script;
use super::failure::Failure;
use super::primitives::KINDS;
use super::program::{Phase, RobotProgram};
use super::words::type_name;
use crate::machine::{Import, Parameter, Type, Value};
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::fmt;
use starl_core::{Port, Primitive, Robot};

/// A variable with its value.
#[derive(Clone, Debug, PartialEq)]
pub struct VariableState {
    /// Its name.
    pub name: String,
    /// Its type, as programs write it.
    pub kind: String,
    /// Its value.
    pub value: Value,
    /// Whether it is a parameter, which the scenario sets and nothing changes.
    pub is_parameter: bool,
}

/// An action, and whether it would fire.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ActionState {
    /// Its name.
    pub name: String,
    /// Whether its guard holds, or why evaluating it fails.
    pub enabled: Result<bool, Failure>,
}

/// A primitive and its state.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PrimitiveState {
    /// Its name in the program; what the program's primitives share has a name of its own.
    pub name: String,
    /// Its kind, for instance `Mutex`.
    pub kind: String,
    /// Where it listens; nowhere, if it is not bound yet or has no state machine of its own.
    pub port: Option<Port>,
    /// All of its state as Rust's `Debug` shows it; none before it is bound.
    pub state: Option<String>,
}

impl RobotProgram {
    /// Its variables and parameters in the order of the text; none before it starts. A variable whose value is invalid
    /// after a fault is omitted.
    pub fn variables(&self) -> Vec<VariableState> {
        if !self.has_started() {
            return Vec::new();
        }
        let program = self.code.program();
        let bytecode = program.bytecode();
        let variables = program.values(&self.state).map(|(name, value)| {
            let declared = bytecode.variables.iter().find(|known| known.name == name);
            VariableState {
                name: name.to_string(),
                kind: declared.map_or(String::new(), |known| type_name(bytecode, &known.kind)),
                value,
                is_parameter: declared.is_some_and(|known| known.parameter != Parameter::No),
            }
        });
        variables.collect()
    }

    /// The value of a shared variable that has this hash in events, as text; none if the robot does not hold it now.
    ///
    /// Bytecode does not say which variable has which type. So this is none, too, if the bytes are a value of several
    /// types that shared variables of the same kind have.
    pub fn shared_value(&self, variable: &str, hash: i64) -> Option<String> {
        let bytes = self.services.memory.as_ref()?.with_hash(variable, hash)?;
        let program = self.code.program();
        let bytecode = program.bytecode();
        let mut bindings = bytecode.primitives.iter();
        let binding = bindings.find(|binding| binding.name == variable)?;
        let writes = |import: &&Import| {
            let member = import.name.strip_prefix(&binding.kind);
            matches!(member, Some(".initialize" | ".write"))
        };
        let mut kinds: Vec<&Type> = Vec::new();
        for import in bytecode.imports.iter().filter(writes) {
            let kind = import.arguments.last();
            kinds.extend(kind.filter(|kind| !kinds.contains(kind)));
        }
        let mut values = kinds.into_iter().filter_map(|kind| {
            let (scalars, objects) = program.decode(core::slice::from_ref(kind), bytes)?;
            Value::read(program, kind, &scalars, &objects)
        });
        let value = values.next()?;
        values.next().is_none().then(|| value.to_string())
    }

    /// Where it is, in a word: the value of its first variable of an enum, else its role. None before it starts, or if
    /// it has no such variable.
    pub fn stage(&self) -> Option<&str> {
        let stage = self.code.stage().filter(|_| self.has_started())?;
        stage.read(self.code.program().bytecode(), &self.state)
    }

    /// Its actions in the order of the text, each with whether its guard holds now; none if the program does not
    /// run. Guards are evaluated on a copy of the program, each with the fuel of a whole activation. An action
    /// with `atomic` may have to wait for its variables even if its guard holds.
    pub fn actions(&self, robot: &mut Robot<'_>) -> Vec<ActionState> {
        if self.phase != Phase::Running {
            return Vec::new();
        }
        let actions = self.code.program().bytecode().actions.iter();
        (0..)
            .zip(actions)
            .map(|(number, action)| {
                let services = &mut self.services.clone();
                let (enabled, _) = self.on_copy(robot, services, Script::None, |machine| {
                    machine.guard(number)
                });
                let name = action.name.clone();
                ActionState { name, enabled }
            })
            .collect()
    }

    /// Its primitives in the order of the text, then their shared services: the memory of shared variables, the state
    /// of actions with `atomic`, and the failure detector.
    pub fn primitives_state(&self) -> Vec<PrimitiveState> {
        let bound = self.code.instances().iter().zip(&self.bound);
        let mut primitives: Vec<PrimitiveState> = bound
            .map(|(instance, slot)| PrimitiveState {
                name: instance.variable.clone(),
                kind: KINDS
                    .get(usize::from(instance.kind))
                    .map_or(String::new(), |kind| kind.name.to_string()),
                port: slot.as_ref().and_then(|slot| slot.port),
                state: slot.as_ref().map(|slot| format!("{slot:?}")),
            })
            .collect();
        let services = &self.services;
        let mut share = |kind: &str, port, state: Option<&dyn fmt::Debug>| {
            if let Some(state) = state {
                primitives.push(PrimitiveState {
                    name: kind.to_string(),
                    kind: kind.to_string(),
                    port,
                    state: Some(format!("{state:?}")),
                });
            }
        };
        share(
            "SharedMemory",
            services.memory.as_ref().map(|memory| memory.port()),
            services.memory.as_ref().map(|memory| memory as _),
        );
        share(
            "Atomic",
            None,
            services.atomic.as_ref().map(|atomic| atomic as _),
        );
        share(
            "FailureDetector",
            self.code.detector(),
            services.detector.as_ref().map(|detector| detector as _),
        );
        primitives
    }
}
