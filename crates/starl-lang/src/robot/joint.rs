//! Joining a program's imports to the functions that serve them.

use super::builtins::{BUILTINS, Builtin};
use super::messages::Outgoing;
use super::primitives::{Entry, KINDS};
use super::properties::{self, observables};
use super::shape::{Declared, Shape, Signature};
use crate::machine::Import;
use alloc::vec::Vec;
use core::cell::RefCell;

/// An import joined to the functions that serve it.
#[derive(Clone, Debug)]
pub struct Joint {
    /// Its implementation on a robot.
    pub on_robot: Option<OnRobot>,
    /// Its implementation in properties.
    pub in_property: Option<properties::Run>,
    /// The message that it sends.
    pub message: Option<Outgoing>,
}

/// The implementation of an import on a robot; kinds are numbered as in [`KINDS`].
#[derive(Clone, Copy, Debug)]
pub enum OnRobot {
    /// It is a built-in function.
    Builtin(&'static Builtin),
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

/// Joins imports and remembers to what.
pub struct Joiner {
    declared: Declared,
    joints: RefCell<Vec<Joint>>,
}

impl Joiner {
    /// One that has joined nothing, for imports of these types.
    pub fn new(declared: Declared) -> Joiner {
        Joiner {
            declared,
            joints: RefCell::default(),
        }
    }

    /// The types.
    pub fn declared(&self) -> &Declared {
        &self.declared
    }

    /// All joints, by the numbers that [`Joiner::join`] gave.
    pub fn finish(self) -> Vec<Joint> {
        self.joints.into_inner()
    }

    /// Joins an import; returns the joint's number, or none if neither robots nor properties implement the import.
    pub fn join(&self, import: &Import) -> Option<u32> {
        let (on_robot, leading) = self.on_robot(import);
        let mut observables = observables().filter(|observable| {
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

    /// The implementation of the import on a robot, and the number of arguments before its own.
    fn on_robot(&self, import: &Import) -> (Option<OnRobot>, usize) {
        let fits =
            |signature: &Signature, leading| self.declared.matches(import, signature, leading);
        let Some((kind, member)) = import.name.split_once('.') else {
            let mut those = BUILTINS.iter().filter(|b| b.signature.name == import.name);
            let found = those.find(|builtin| fits(&builtin.signature, 0));
            return (found.map(OnRobot::Builtin), 0);
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
