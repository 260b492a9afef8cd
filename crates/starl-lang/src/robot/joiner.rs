//! Joining a program's imports to the functions that serve them.

use super::builtins::BUILTINS;
use super::joint::{Joint, OnRobot};
use super::messages::Outgoing;
use super::primitives::KINDS;
use super::properties::OBSERVABLES;
use super::shape::{Declared, Shape, Signature};
use crate::machine::Import;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::cell::RefCell;

/// The names of all functions that programs can import, as [`crate::machine::Import`] has them.
pub fn functions() -> impl Iterator<Item = String> {
    let builtins = BUILTINS.iter().map(|b| &b.signature);
    let observables = OBSERVABLES.iter().map(|o| &o.signature);
    let plain = builtins.chain(observables).map(|s| s.name.to_string());
    let members = KINDS.iter().flat_map(|kind| {
        let names = kind.members().map(|signature| signature.name);
        let names = ["bind"].into_iter().chain(names);
        names.map(|name| alloc::format!("{}.{name}", kind.name))
    });
    plain.chain(members)
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
        let joint = Joint {
            in_property: OBSERVABLES
                .iter()
                .position(|observable| self.is(import, &observable.signature))
                .map(|number| number as u16),
            is_steady: match on_robot {
                Some(OnRobot::Builtin(number)) => BUILTINS[usize::from(number)].is_steady,
                Some(OnRobot::Member { .. }) => import.query,
                Some(OnRobot::Bind(_)) | None => false,
            },
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

    /// Whether an import has the name and the types of a function outside primitives.
    fn is(&self, import: &Import, signature: &Signature) -> bool {
        signature.name == import.name && self.declared.matches(import, signature, 0)
    }

    /// The implementation of the import on a robot, and the number of arguments before its own.
    fn on_robot(&self, import: &Import) -> (Option<OnRobot>, usize) {
        let Some((kind, member)) = import.name.split_once('.') else {
            let mut builtins = BUILTINS.iter();
            let found = builtins.position(|builtin| self.is(import, &builtin.signature));
            return (found.map(|number| OnRobot::Builtin(number as u16)), 0);
        };
        let mut kinds = KINDS.iter().enumerate();
        let Some((number, entry)) = kinds.find(|(_, entry)| entry.name == kind) else {
            return (None, 0);
        };
        let number = number as u16;
        let fits = |signature: &Signature| self.declared.matches(import, signature, 1);
        if member == "bind" {
            let bind = fits(&Signature::effect("bind", entry.constructor, None));
            return (bind.then_some(OnRobot::Bind(number)), 1);
        }
        let mut members = entry.members().enumerate();
        let found = members.find(|(_, signature)| signature.name == member && fits(signature));
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
