//! Finds the parts of a program that use the same variables.
//!
//! The writes of an action with `atomic` are computed first, then stored, and then the action takes place. Nothing that
//! the action depends on may change meanwhile, so parts that use the same variables or the same kind of primitive wait.

use super::groups::KIND;
use crate::machine::operand::{FIRST_STATE_OPERAND, Use};
use crate::machine::{Bytecode, Instruction};
use alloc::boxed::Box;
use alloc::collections::BTreeSet;
use alloc::string::String;
use alloc::vec::Vec;
use core::ops::Range;

/// Something that parts of a program have in common.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Place {
    /// A scalar of the state.
    Scalar(u32),
    /// An object of the state.
    Object(u32),
    /// The primitives of a kind.
    Kind(String),
}

/// The variables and primitives that a part of a program uses.
#[derive(Clone, Debug, Default)]
struct Footprint {
    read: BTreeSet<Place>,
    written: BTreeSet<Place>,
}

/// The parts of a program that wait for an action with `atomic`.
#[derive(Clone, Debug)]
pub struct Conflicts {
    /// Whether it does, for each action.
    actions: Box<[bool]>,
    /// Whether it does, for each handler.
    handlers: Box<[bool]>,
}

impl Conflicts {
    /// Whether an action waits.
    pub fn keeps_action(&self, action: u32) -> bool {
        self.actions.get(action as usize) == Some(&true)
    }

    /// Whether a handler waits.
    pub fn keeps_handler(&self, handler: u32) -> bool {
        self.handlers.get(handler as usize) == Some(&true)
    }

    /// Those of each action; none for actions without `atomic`.
    pub fn of(bytecode: &Bytecode) -> Vec<Option<Conflicts>> {
        let actions = bytecode.actions.iter();
        if actions.clone().all(|action| action.atomic.is_empty()) {
            return actions.map(|_| None).collect();
        }
        let parts = actions.map(|action| Footprint::of(bytecode, &[action.guard, action.effect]));
        let parts: Vec<Footprint> = parts.collect();
        let handlers = bytecode.handlers.iter();
        let handlers = handlers.map(|handler| Footprint::of(bytecode, &[handler.function]));
        let handlers: Vec<Footprint> = handlers.collect();
        let with = |others: &[Footprint], part: &Footprint| {
            let others = others.iter();
            others.map(|other| part.disturbs(other)).collect()
        };
        let conflicts = bytecode.actions.iter().zip(&parts).map(|(action, part)| {
            (!action.atomic.is_empty()).then(|| Conflicts {
                actions: with(&parts, part),
                handlers: with(&handlers, part),
            })
        });
        conflicts.collect()
    }
}

/// Whether a function, or one that it calls, reads a variable with these scalars and objects of the state.
pub fn reads(bytecode: &Bytecode, function: u32) -> impl Fn(&Range<usize>, &Range<usize>) -> bool {
    let footprint = Footprint::of(bytecode, &[function]);
    move |scalars, objects| {
        footprint.read.iter().any(|place| match place {
            Place::Scalar(number) => scalars.contains(&(*number as usize)),
            Place::Object(number) => objects.contains(&(*number as usize)),
            Place::Kind(_) => false,
        })
    }
}

impl Footprint {
    /// That of these functions and all that they call.
    fn of(bytecode: &Bytecode, functions: &[u32]) -> Footprint {
        let mut footprint = Footprint::default();
        for instruction in bytecode.reachable(functions) {
            footprint.add(bytecode, instruction);
        }
        footprint
    }

    fn add(&mut self, bytecode: &Bytecode, instruction: &Instruction) {
        let point = |first: u32| (first..first + 3).map(Place::Scalar);
        match *instruction {
            Instruction::Load { variable, .. } => {
                self.read.insert(Place::Scalar(variable.0));
            }
            Instruction::LoadPoint { variable, .. } => self.read.extend(point(variable.0)),
            Instruction::JumpIfStateNot { variable, .. } => {
                self.read.insert(Place::Scalar(variable.0.into()));
            }
            Instruction::Store { variable, .. } => {
                self.written.insert(Place::Scalar(variable.0));
            }
            Instruction::StorePoint { variable, .. } => self.written.extend(point(variable.0)),
            Instruction::LoadObject { variable, .. } => {
                self.read.insert(Place::Object(variable.0));
            }
            Instruction::StoreObject { variable, .. } => {
                self.written.insert(Place::Object(variable.0));
            }
            Instruction::CallHost { import, .. } => {
                let import = bytecode.imports.get(import.0 as usize);
                // Linearizable variables are used by actions with `atomic` only, one at a time.
                if let Some(import) = import
                    && let Some((kind, _)) = import.name.split_once('.')
                    && kind != KIND
                {
                    let places = match import.query {
                        true => &mut self.read,
                        false => &mut self.written,
                    };
                    places.insert(Place::Kind(kind.into()));
                }
            }
            _ => {}
        }
        instruction.uses(&mut |used| {
            let (operand, is_read) = match used {
                Use::ReadsObject(operand) => (operand, true),
                Use::ChangesObject(operand) | Use::WritesObject(operand) => (operand, false),
                _ => return,
            };
            if let Some(variable) = operand.checked_sub(FIRST_STATE_OPERAND) {
                let places = match is_read {
                    true => &mut self.read,
                    false => &mut self.written,
                };
                places.insert(Place::Object(variable.into()));
            }
        });
    }

    /// Whether the one writes what the other reads or writes.
    fn disturbs(&self, other: &Footprint) -> bool {
        let all = [
            (&self.written, &other.read),
            (&self.read, &other.written),
            (&self.written, &other.written),
        ];
        all.iter().any(|(one, other)| !one.is_disjoint(other))
    }
}
