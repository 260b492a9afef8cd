//! Whether states that were merged are really alike.
//!
//! A state of a robot is known by what it writes of itself ([`starl_core::Program::write_state`]). A
//! program that leaves something out would have states taken for one that go on in different ways, and
//! behaviours would be missed. So a search may doubt: of each state of a robot it keeps a few other robots
//! that came to the same text by other ways, its twins, and has all take every input. They must send
//! the same, tell the same, and come to the same text again.

use crate::code::Code;
use crate::robot::Local;
use crate::robots::Robots;
use std::collections::BTreeMap;

/// How many are kept of each state.
const TWINS: usize = 4;

/// Twins, and what they were compared in.
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
    /// A robot has come to a state in which another was.
    pub fn meet(&mut self, number: u32, local: Local) {
        let twins = self.twins.entry(number).or_default();
        if twins.len() < TWINS {
            twins.push(local.clone());
            self.new.push((number, local));
        }
    }
}

impl Robots {
    /// Has twins take the input that a robot in this state has just taken, and new twins all that were
    /// taken in their states before.
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
                    "robot {robot} came to the same state in two ways and then went on in two ways \
                     ({happening:?}): its program does not write all of its state"
                )
            });
        }
    }
}
