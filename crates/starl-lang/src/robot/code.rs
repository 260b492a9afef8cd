//! A program that robots can run: bytecode that was verified and joined to what robots offer.

use super::builtins::{self, BUILTINS};
use super::messages::{Inbox, Outgoing};
use super::parameter;
use super::primitives::{Entry, KINDS};
use super::properties::{self, OBSERVABLES};
use super::shape::{Declared, Shape, Signature};
use crate::machine::{Bytecode, Import, LoadError, Program, RuntimeError, State};
use alloc::format;
use alloc::string::{String, ToString};
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::cell::RefCell;

/// A program that robots can run. Copies share it.
#[derive(Clone)]
pub struct Code(Arc<Inner>);

struct Inner {
    program: Program,
    joints: Vec<Joint>,
    instances: Vec<Instance>,
    /// The name of the memory that shared variables lie in, if there are any.
    memory: Option<String>,
    inbox: Inbox,
    /// The parameters' defaults; or what went wrong when they were worked out.
    initial: Result<State, String>,
}

/// An import joined to the functions that serve it.
#[derive(Clone, Debug)]
pub struct Joint {
    /// What it does on a robot.
    pub on_robot: Option<OnRobot>,
    /// What it does where properties are judged.
    pub in_property: Option<properties::Run>,
    /// The message that it sends.
    pub message: Option<Outgoing>,
}

/// What an import does on a robot; kinds are numbered as in [`KINDS`].
#[derive(Clone, Copy, Debug)]
pub enum OnRobot {
    /// It is a built-in function.
    Builtin(builtins::Run),
    /// It binds a primitive of this kind.
    Bind(u16),
    /// It is a member of a kind.
    Member {
        /// The kind.
        kind: u16,
        /// The number of the member.
        member: u16,
    },
}

/// A primitive that the program binds.
#[derive(Clone, Debug)]
pub struct Instance {
    /// The name by which instances on different robots find each other.
    pub name: String,
    /// The name in the program.
    pub variable: String,
    /// Its kind, by its number in [`KINDS`].
    pub kind: u16,
    /// For each of the kind's events that is handled its number and the handler's.
    pub handlers: Vec<(usize, u32)>,
}

impl Code {
    /// Verifies bytecode and joins it to what robots offer.
    pub fn load(bytecode: Bytecode) -> Result<Code, LoadError> {
        let joiner = Joiner {
            declared: Declared::of(&bytecode),
            joints: RefCell::default(),
        };
        let program = Program::load(bytecode, &|import: &Import| joiner.join(import))?;
        let instances = instances(program.bytecode(), &joiner.declared)?;
        let inbox = Inbox::of(program.bytecode(), &joiner.declared);
        let inbox = inbox.ok_or(LoadError::Invalid {
            position: None,
            reason: "a message's handler does not take the sender and the message's fields",
        })?;
        let initial = parameter::defaults(&program);
        Ok(Code(Arc::new(Inner {
            initial: initial.map_err(|error| place(&program, &error)),
            joints: joiner.joints.into_inner(),
            memory: memory_name(program.bytecode(), &instances),
            program,
            instances,
            inbox,
        })))
    }

    /// The program.
    pub fn program(&self) -> &Program {
        &self.0.program
    }

    /// A state with the parameters' defaults.
    pub(super) fn initial(&self) -> Result<&State, &str> {
        self.0.initial.as_ref().map_err(|text| &text[..])
    }

    /// What an import was joined to.
    pub(super) fn joint(&self, function: u32) -> Option<&Joint> {
        self.0.joints.get(function as usize)
    }

    /// The primitives that the program binds.
    pub(super) fn instances(&self) -> &[Instance] {
        &self.0.instances
    }

    /// The name of the memory that shared variables lie in, if there are any.
    pub(super) fn memory(&self) -> Option<&str> {
        self.0.memory.as_deref()
    }

    /// The messages that the program handles.
    pub(super) fn inbox(&self) -> &Inbox {
        &self.0.inbox
    }

    /// An error in words, with its place: `race.starl:12:5: index 5 is out of range 0..3`.
    pub fn describe(&self, error: &RuntimeError) -> String {
        place(self.program(), error)
    }
}

fn place(program: &Program, error: &RuntimeError) -> String {
    match program.source(error.position) {
        Some(place) => format!("{place}: {}", error.fault),
        None => match program.function_at(error.position) {
            Some(function) => format!("{}: {}", function.name, error.fault),
            None => error.fault.to_string(),
        },
    }
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
            if handler.primitive != Some(index as u32) {
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
            kind: kind as u16,
            handlers,
        });
    }
    Ok(instances)
}

fn memory_name(bytecode: &Bytecode, instances: &[Instance]) -> Option<String> {
    let kinds = instances
        .iter()
        .filter_map(|i| KINDS.get(usize::from(i.kind)));
    let is_needed = kinds.into_iter().any(|kind| kind.shared);
    is_needed.then(|| format!("{}/shared", bytecode.name))
}

/// Joins imports and remembers to what.
struct Joiner {
    declared: Declared,
    joints: RefCell<Vec<Joint>>,
}

impl Joiner {
    fn join(&self, import: &Import) -> Option<u32> {
        let (on_robot, leading) = self.on_robot(import);
        let mut observables = OBSERVABLES.iter().filter(|observable| {
            let signature = &observable.signature;
            signature.name == import.name && self.declared.matches(import, signature, 0)
        });
        let joint = Joint {
            in_property: observables.next().map(|observable| observable.run),
            message: on_robot.and_then(|joined| self.message(import, joined, leading)),
            on_robot,
        };
        if joint.on_robot.is_none() && joint.in_property.is_none() {
            return None;
        }
        let mut joints = self.joints.borrow_mut();
        joints.push(joint);
        u32::try_from(joints.len() - 1).ok()
    }

    /// What the import does on a robot, and how many arguments come before its own.
    fn on_robot(&self, import: &Import) -> (Option<OnRobot>, usize) {
        let fits =
            |signature: &Signature, leading| self.declared.matches(import, signature, leading);
        let Some((kind, member)) = import.name.split_once('.') else {
            let mut those = BUILTINS.iter().filter(|b| b.signature.name == import.name);
            let found = those.find(|builtin| fits(&builtin.signature, 0));
            return (found.map(|builtin| OnRobot::Builtin(builtin.run)), 0);
        };
        let mut kinds = KINDS.iter().enumerate();
        let Some((number, entry)) = kinds.find(|(_, entry)| entry.name == kind) else {
            return (None, 0);
        };
        let number = number as u16;
        if member == "bind" {
            let bind = fits(&bind_signature(entry), 1);
            return (bind.then_some(OnRobot::Bind(number)), 1);
        }
        let mut members = entry.members().enumerate();
        let found = members.find(|(_, signature)| signature.name == member && fits(signature, 1));
        let joined = found.map(|(member, _)| OnRobot::Member {
            kind: number,
            member: member as u16,
        });
        (joined, 1)
    }

    /// The message among the import's arguments.
    fn message(&self, import: &Import, joined: OnRobot, leading: usize) -> Option<Outgoing> {
        let OnRobot::Member { kind, member } = joined else {
            return None;
        };
        let signature = (KINDS.get(usize::from(kind))?.member)(usize::from(member))?;
        let mut parameters = signature.parameters.iter();
        let place = parameters.position(|shape| *shape == Shape::Message)?;
        let record = import.arguments.get(leading + place)?;
        Some(Outgoing::new(
            &self.declared,
            import.labels.first()?,
            record,
        ))
    }
}

fn bind_signature(entry: &Entry) -> Signature {
    Signature {
        name: "bind",
        query: false,
        parameters: entry.constructor,
        fields: false,
        result: None,
    }
}
