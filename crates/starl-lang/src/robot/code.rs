//! A program that robots can run: bytecode that was verified and joined to what robots offer.

use super::atomic::{Conflicts, Groups};
use super::failure::Failure;
use super::instance::Instance;
use super::joint::Joint;
use super::messages::Inbox;
use super::orders::Orders;
use super::services::{self, Needs, Services};
use super::stable::Stable;
use super::stage::Stage;
use crate::machine::{Action, Program, RuntimeError, State};
use alloc::string::String;
use alloc::sync::Arc;
use alloc::vec::Vec;
use starl_core::Port;
use starl_policy::Network;

/// A program that robots can run. Copies share it.
#[derive(Clone)]
pub struct Code(pub(super) Arc<Inner>);

/// The parts of a program that robots can run.
pub struct Inner {
    pub program: Program,
    pub joints: Vec<Joint>,
    pub instances: Vec<Instance>,
    pub groups: Groups,
    /// The conflicts of each action with `atomic`.
    pub conflicts: Vec<Option<Conflicts>>,
    /// See [`Code::is_steady`].
    pub is_steady: bool,
    /// The services that its primitives need.
    pub needs: Needs,
    /// The same, made once for all robots: it takes longer to make than to copy.
    pub services: Services,
    pub inbox: Inbox,
    pub orders: Orders,
    pub stable: Vec<Stable>,
    /// The networks of its models, in their order.
    pub networks: Vec<Network>,
    /// Where the program says how far it is.
    pub stage: Option<Stage>,
    /// The parameters' defaults; or what went wrong when they were worked out.
    pub initial: Result<State, Failure>,
}

impl Code {
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
        Failure::of(self.program(), error)
    }
}
