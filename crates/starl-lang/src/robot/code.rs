//! A program that robots can run: bytecode that was verified and joined to what robots offer.

use super::atomic::{self, Conflicts, Groups, join_groups};
use super::defaults::defaults;
use super::failure::Failure;
use super::instance::Instance;
use super::joint::{Joiner, Joint};
use super::messages::Inbox;
use super::orders::Orders;
use super::primitives::KINDS;
use super::rest;
use super::services::{self, Needs, Services};
use super::shape::Declared;
use super::stable::Stable;
use super::stage::Stage;
use crate::machine::{
    Action, Bytecode, Import, LoadError, Model, Origin, Program, RuntimeError, State,
};
use alloc::format;
use alloc::string::{String, ToString};
use alloc::sync::Arc;
use alloc::vec::Vec;
use starl_core::Port;
use starl_policy::Network;

/// A program that robots can run. Copies share it.
#[derive(Clone)]
pub struct Code(Arc<Inner>);

struct Inner {
    program: Program,
    joints: Vec<Joint>,
    instances: Vec<Instance>,
    groups: Groups,
    /// The conflicts of each action with `atomic`.
    conflicts: Vec<Option<Conflicts>>,
    /// See [`Code::is_steady`].
    is_steady: bool,
    /// The services that its primitives need.
    needs: Needs,
    /// The same, made once for all robots: it takes longer to make than to copy.
    services: Services,
    inbox: Inbox,
    orders: Orders,
    stable: Vec<Stable>,
    /// The networks of its models, in their order.
    networks: Vec<Network>,
    /// Where the program says how far it is.
    stage: Option<Stage>,
    /// The parameters' defaults; or what went wrong when they were worked out.
    initial: Result<State, Failure>,
}

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
            initial: initial.map_err(|error| failure(&program, &error)),
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

    /// The program.
    pub fn program(&self) -> &Program {
        &self.0.program
    }

    /// A state with the parameters' defaults.
    pub(super) fn initial(&self) -> Result<&State, &Failure> {
        self.0.initial.as_ref()
    }

    /// The joint of an import.
    pub(super) fn joint(&self, function: u32) -> Option<&Joint> {
        self.0.joints.get(function as usize)
    }

    /// The primitives that the program binds.
    pub(super) fn instances(&self) -> &[Instance] {
        &self.0.instances
    }

    /// The groups of variables that actions must have for themselves.
    pub(super) fn groups(&self) -> &Groups {
        &self.0.groups
    }

    /// The parts that wait while the writes of an action with `atomic` are being stored.
    pub(super) fn held(&self, services: &Services) -> Option<&Conflicts> {
        let action = services.atomic.as_ref()?.stores()?;
        self.0.conflicts.get(action as usize)?.as_ref()
    }

    /// Whether all guards follow from the program's variables and its primitives.
    pub(super) fn is_steady(&self) -> bool {
        self.0.is_steady
    }

    /// Whether the program has checks, those of its variables' ranges among them.
    pub fn has_checks(&self) -> bool {
        self.checks() > 0
    }

    /// Whether some action waits for time to pass.
    pub fn waits_for_time(&self) -> bool {
        let actions = &self.program().bytecode().actions;
        actions.iter().any(Action::is_timed)
    }

    /// How many of the actions, the first ones, are checks.
    pub(super) fn checks(&self) -> u32 {
        let actions = &self.program().bytecode().actions;
        actions.partition_point(|action| action.is_check) as u32
    }

    /// Whether an action waits for a time.
    pub(super) fn is_timed(&self) -> bool {
        let mut actions = self.program().bytecode().actions.iter();
        actions.any(Action::is_timed)
    }

    /// Where a check is written, e.g. `race.starl:12:7`.
    pub(super) fn place_of_check(&self, action: u32) -> Option<String> {
        let bytecode = self.program().bytecode();
        let action = bytecode.actions.get(action as usize)?;
        let guard = bytecode.functions.get(action.guard as usize)?;
        self.program().source(guard.entry)
    }

    /// The services of the program's primitives, not started.
    pub(super) fn services(&self) -> &Services {
        &self.0.services
    }

    /// Where the program's failure detector listens, if it has one.
    pub fn detector(&self) -> Option<Port> {
        let name = &self.program().bytecode().name;
        self.0.needs.detector.then(|| services::detector_port(name))
    }

    /// The messages that the program handles.
    pub(super) fn inbox(&self) -> &Inbox {
        &self.0.inbox
    }

    /// The name of the message that a datagram of Unicast, Broadcast or Geocast carries; none if the program handles no
    /// such message, and where the datagram carries none or several, as acknowledgements and what keeps a total order
    /// do.
    pub fn message_in(&self, datagram: &[u8]) -> Option<&str> {
        let program = self.program();
        let handlers = self.0.inbox.at_end_of(program, datagram)?;
        let handler = program
            .bytecode()
            .handlers
            .get(*handlers.first()? as usize)?;
        Some(&handler.event)
    }

    /// The inputs that the program handles.
    pub fn orders(&self) -> &Orders {
        &self.0.orders
    }

    /// The stable variables, in the order of the variables.
    pub(super) fn stable(&self) -> &[Stable] {
        &self.0.stable
    }

    /// A model of the program, by its number: its path and its network.
    pub(super) fn model(&self, number: usize) -> Option<(&str, &Network)> {
        let model = self.program().bytecode().models.get(number)?;
        Some((&model.path, self.0.networks.get(number)?))
    }

    /// Where the program says how far it is; none if it has no variable of an enum.
    pub(super) fn stage(&self) -> Option<&Stage> {
        self.0.stage.as_ref()
    }

    /// An error with its place: `race.starl:12:5: index 5 is out of range 0..3`.
    pub fn describe(&self, error: &RuntimeError) -> Failure {
        failure(self.program(), error)
    }
}

fn failure(program: &Program, error: &RuntimeError) -> Failure {
    let function = || Some(program.function_at(error.position)?.name.clone());
    Failure::Fault {
        place: program.source(error.position).or_else(function),
        fault: error.fault.clone(),
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
