//! Loading: bytecode is verified and joined to what robots offer.

use super::atomic::{self, Conflicts, Groups, join_groups};
use super::code::{Code, Inner};
use super::defaults::defaults;
use super::failure::Failure;
use super::instance::Instance;
use super::joiner::Joiner;
use super::messages::Inbox;
use super::orders::Orders;
use super::primitives::KINDS;
use super::rest;
use super::services::{Needs, Services};
use super::shape::Declared;
use super::stable::Stable;
use super::stage::Stage;
use crate::machine::{Bytecode, Import, LoadError, Model, Origin, Program};
use alloc::format;
use alloc::string::ToString;
use alloc::sync::Arc;
use alloc::vec::Vec;
use starl_policy::Network;

impl Code {
    /// Verifies bytecode and joins it to what robots offer.
    pub fn load(bytecode: Bytecode) -> Result<Code, LoadError> {
        let joiner = Joiner::new(Declared::of(&bytecode));
        let program = Program::load(bytecode, &|import: &Import| joiner.join(import))?;
        let mut instances = instances(program.bytecode(), joiner.declared())?;
        group(program.bytecode(), &mut instances)?;
        let inbox = Inbox::of(program.bytecode(), joiner.declared());
        let inbox = inbox.ok_or(LoadError::Invalid {
            position: None,
            reason: "a message's handler does not take the sender and the message's fields",
        })?;
        let orders = Orders::of(program.bytecode()).ok_or(LoadError::Invalid {
            position: None,
            reason: "handlers of one input have different fields",
        })?;
        let networks = networks(program.bytecode())?;
        let stable = Stable::of(program.bytecode(), joiner.declared());
        let initial = defaults(&program);
        let joints = joiner.finish();
        Ok(Code(Arc::new(Inner {
            initial: initial.map_err(|error| Failure::of(&program, &error)),
            is_steady: rest::is_steady(program.bytecode(), &joints),
            joints,
            services: Services::of(&program.bytecode().name, needs(&instances)),
            needs: needs(&instances),
            groups: Groups::new(&program.bytecode().actions, &instances),
            conflicts: Conflicts::of(program.bytecode()),
            stage: Stage::of(program.bytecode()),
            program,
            instances,
            inbox,
            orders,
            stable,
            networks,
        })))
    }
}

/// The networks of a program's models.
fn networks(bytecode: &Bytecode) -> Result<Vec<Network>, LoadError> {
    let read = |model: &Model| {
        Network::read(&model.bytes).map_err(|error| LoadError::Model {
            path: model.path.clone(),
            reason: error.to_string(),
        })
    };
    bytecode.models.iter().map(read).collect()
}

/// The primitives that a program binds, with the handlers of their events.
fn instances(bytecode: &Bytecode, declared: &Declared) -> Result<Vec<Instance>, LoadError> {
    let mut instances = Vec::new();
    for (index, binding) in bytecode.primitives.iter().enumerate() {
        let Some(kind) = KINDS.iter().position(|kind| kind.name == binding.kind) else {
            return Err(LoadError::UnknownImport(binding.kind.clone()));
        };
        let mut handlers = Vec::new();
        for (number, handler) in bytecode.handlers.iter().enumerate() {
            if handler.origin != Origin::Primitive(index as u32) {
                continue;
            }
            let function = bytecode.functions.get(handler.function as usize);
            let events = KINDS[kind].events.iter();
            let event = events.enumerate().find(|(_, event)| {
                event.name == handler.event
                    && function.is_some_and(|f| declared.all(event.parameters, &f.arguments))
            });
            let Some((event, _)) = event else {
                let name = format!("{}.{}", binding.kind, handler.event);
                return Err(LoadError::UnknownImport(name));
            };
            handlers.push((event, number as u32));
        }
        instances.push(Instance {
            name: format!("{}/{}", bytecode.name, binding.name),
            variable: binding.name.clone(),
            group: binding.name.clone(),
            kind: kind as u16,
            handlers,
        });
    }
    Ok(instances)
}

/// Gives each linearizable variable the name of its group.
fn group(bytecode: &Bytecode, instances: &mut [Instance]) -> Result<(), LoadError> {
    let actions = bytecode.actions.iter();
    let actions: Vec<Vec<u32>> = actions.map(|action| action.atomic.clone()).collect();
    for instance in actions.iter().flatten() {
        let kind = bytecode.primitives.get(*instance as usize);
        if kind.is_none_or(|binding| binding.kind != atomic::KIND) {
            return Err(LoadError::Invalid {
                position: None,
                reason: "an action waits for something else than a linearizable variable",
            });
        }
    }
    for (number, first) in join_groups(instances.len(), &actions)
        .into_iter()
        .enumerate()
    {
        if let Some(name) = bytecode.primitives.get(first as usize) {
            instances[number].group = name.name.clone();
        }
    }
    Ok(())
}

fn needs(instances: &[Instance]) -> Needs {
    let kinds = instances
        .iter()
        .filter_map(|instance| KINDS.get(usize::from(instance.kind)));
    kinds.fold(Needs::NOTHING, |needs, kind| needs.or(kind.needs))
}
