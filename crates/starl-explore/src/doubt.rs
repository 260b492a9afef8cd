//! Checks that merged states really behave alike.
//!
//! A state of a robot is identified by the text that it writes ([`starl_core::Program::write_state`]). If a program
//! omits a part of its state, states with different futures are merged, and behaviours are missed. So a search may
//! check this: for each state of a robot it keeps a few other robots that reached the same text on other paths, its
//! twins, and gives all of them every input. They must send the same, record the same, and reach the same text again.

use crate::code::Code;
use crate::robot::Local;
use std::collections::BTreeMap;

/// How many are kept of each state.
const TWINS: usize = 4;

/// Twins, and the inputs in which they were compared.
#[derive(Clone, Default)]
pub(crate) struct Doubt {
    pub twins: BTreeMap<u32, Vec<Local>>,
    /// The inputs that were tried in each state.
    pub tried: BTreeMap<u32, Vec<Code>>,
    /// Twins that have not been compared yet.
    pub new: Vec<(u32, Local)>,
    /// How many turns were compared.
    pub compared: u64,
    /// How two twins differ.
    pub contradiction: Option<String>,
}

impl Doubt {
    /// A robot has reached a state in which another was.
    pub fn meet(&mut self, number: u32, local: Local) {
        let twins = self.twins.entry(number).or_default();
        if twins.len() < TWINS {
            twins.push(local.clone());
            self.new.push((number, local));
        }
    }
}
