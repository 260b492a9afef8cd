//! Stable variables: if the robot has storage, each is saved under its name when it has changed, and begins with the
//! saved value.
//!
//! A saved value begins with a tag, a hash of the variable's name and type. So a value saved by another version of the
//! program with another type is not used.

use super::messages::tag;
use super::shape::Declared;
use crate::machine::{Bytecode, Program, State, Variable};
use alloc::string::String;
use alloc::vec::Vec;
use starl_core::{Digest, Payload, Port, Robot, Saved};

/// Bytes of a tag.
const TAG: usize = 4;

/// A stable variable.
#[derive(Clone, Debug)]
pub struct Stable {
    /// Its number among the program's variables.
    variable: usize,
    name: String,
    tag: [u8; TAG],
}

impl Stable {
    /// Those of a program, in the order of its variables.
    pub fn of(bytecode: &Bytecode, declared: &Declared) -> Vec<Stable> {
        let variables = bytecode.variables.iter().enumerate();
        let stable = variables.filter(|(_, variable)| variable.is_stable);
        let named = |(number, variable): (usize, &Variable)| Stable {
            variable: number,
            name: variable.name.clone(),
            tag: tag(declared, &variable.name, &[&variable.kind]).to_le_bytes(),
        };
        stable.map(named).collect()
    }

    fn find<'s>(&self, saved: &'s Saved) -> Option<&'s [u8]> {
        let mut values = saved.of(Port::PROGRAM);
        let found = values.find(|(key, _)| *key == self.name);
        found.map(|(_, value)| value)
    }
}

/// The saved value of the variable with this number among the stable ones, without its tag; none if there is none of its type.
pub fn saved<'s>(all: &[Stable], saved: &'s Saved, variable: usize) -> Option<&'s [u8]> {
    let stable = all.iter().find(|stable| stable.variable == variable)?;
    stable.find(saved)?.strip_prefix(&stable.tag)
}

/// A program's stable variables in storage.
#[derive(Clone, Debug)]
pub struct Kept {
    /// The version of the variables that was saved last.
    version: u64,
    /// A digest of each variable's value in storage; none if there is none.
    digests: Vec<Option<u64>>,
}

impl Kept {
    /// The stored variables when the program has started; none if there is nothing to save.
    pub fn at_start(stable: &[Stable], robot: &Robot<'_>) -> Option<Kept> {
        let saved = robot.saved()?;
        (!stable.is_empty()).then(|| Kept {
            version: 0,
            digests: stable.iter().map(|s| s.find(saved).map(digest)).collect(),
        })
    }

    /// Saves the variables that have changed since the last save.
    pub fn save(
        &mut self,
        stable: &[Stable],
        (program, state): (&Program, &State),
        version: u64,
        robot: &mut Robot<'_>,
    ) {
        if core::mem::replace(&mut self.version, version) == version {
            return;
        }
        let values = program.encode_stable(state);
        for ((stable, value), kept) in stable.iter().zip(values).zip(&mut self.digests) {
            let mut bytes = Payload::from_slice(&stable.tag);
            bytes.extend_from_slice(&value);
            let digest = Some(digest(&bytes));
            if *kept != digest {
                *kept = digest;
                robot.save_bytes(Port::PROGRAM, stable.name.clone(), bytes);
            }
        }
    }

    /// The part of the state on which later saves depend.
    pub fn digests(&self) -> &[Option<u64>] {
        &self.digests
    }
}

fn digest(bytes: &[u8]) -> u64 {
    let mut digest = Digest::default();
    digest.bytes(bytes);
    digest.value()
}
