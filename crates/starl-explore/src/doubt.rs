//! Checks that merged states really behave alike.
//!
//! A state of a robot is identified by the text that it writes ([`starl_core::Program::write_state`]). If a program
//! omits a part of its state, states with different futures are merged, and behaviours are missed. So a search may
//! check this: for each state of a robot it keeps a few other robots that reached the same text on other paths, its
//! twins, and gives all of them every input. They must send the same, record the same, and reach the same text again.

use crate::code::Code;
use crate::robot::Local;
use crate::robots::Robots;
use std::collections::BTreeMap;

/// How many are kept of each state.
const TWINS: usize = 4;

/// Twins, and the inputs in which they were compared.
#[derive(Clone, Default)]
pub(crate) struct Doubt {
    twins: BTreeMap<u32, Vec<Local>>,
    /// The inputs that were tried in each state.
    tried: BTreeMap<u32, Vec<Code>>,
    /// Twins that have not been compared yet.
    new: Vec<(u32, Local)>,
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

impl Robots {
    /// Gives twins the input that a robot in this state has just handled, and new twins all inputs that were handled in
    /// their states before.
    pub fn compare_twins(&mut self, local: u32, code: Code) {
        let Some(doubt) = &mut self.doubt else { return };
        doubt.tried.entry(local).or_default().push(code);
        let twins = doubt.twins.get(&local).cloned().unwrap_or_default();
        for twin in &twins {
            self.compare(local, twin, code);
        }
        // Twins lead to twins.
        while let Some(doubt) = &mut self.doubt
            && let Some((local, twin)) = doubt.new.pop()
        {
            let tried = doubt.tried.get(&local).cloned().unwrap_or_default();
            for code in tried {
                self.compare(local, &twin, code);
            }
        }
    }

    fn compare(&mut self, local: u32, twin: &Local, code: Code) {
        let happening = self.happening(local, code);
        let mine = self.state(local).turn(&happening, &self.surroundings);
        let its = twin.turn(&happening, &self.surroundings);
        let robot = twin.robot();
        let is_same = mine.sent == its.sent && mine.events == its.events;
        let motions = self.motions;
        let (mine, its) = (self.enter(mine), self.enter(its));
        self.motions = motions;
        let Some(doubt) = &mut self.doubt else { return };
        doubt.compared += 1;
        if !is_same || mine.local != its.local {
            doubt.contradiction.get_or_insert_with(|| {
                format!(
                    "robot {robot} reached one state on two paths and then behaved in two ways \
                     ({happening:?}): its program does not write all of its state"
                )
            });
        }
    }
}
