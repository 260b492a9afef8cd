//! Repeats a robot's run from its journal, with neither the robot nor its host.

use crate::journal::{Observed, encode};
use alloc::boxed::Box;
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::fmt;
use starl_core::effect::Effects;
use starl_core::{Agent, Effect, Input, Program, Time};

/// Runs a robot's software on the inputs of its journal, and compares its effects with the recorded ones, bit by bit.
#[derive(Clone)]
pub struct Replayer {
    fresh: Box<dyn Program>,
    agent: Option<Agent>,
    effects: Effects,
    entries: u64,
    lives: u32,
}

/// Why a replay cannot continue.
#[derive(Clone, Debug, PartialEq)]
pub enum Departure {
    /// The software asks for something else than it did.
    Different(Box<Difference>),
    /// The journal has entries before the software started.
    NotStarted,
}

/// The first entry at which software behaves otherwise than on record.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// How many entries agree before.
    pub agreed: u64,
    /// When, by the host's clock.
    pub at: Time,
    /// When, by the robot's clock.
    pub now: Time,
    /// The input.
    pub input: Input,
    /// The recorded effects.
    pub recorded: Vec<Effect>,
    /// The effects of the replay.
    pub replayed: Vec<Effect>,
}

impl Replayer {
    /// A replayer of robots that run `fresh`, which has not taken any input.
    pub fn new(fresh: Box<dyn Program>) -> Replayer {
        Replayer {
            fresh,
            agent: None,
            effects: Effects::default(),
            entries: 0,
            lives: 0,
        }
    }

    /// Repeats the next entry of the journal, at `at`.
    ///
    /// # Errors
    /// The effects differ from the recorded ones. The later inputs are answers to the recorded effects, so the replay
    /// cannot continue.
    pub fn observe(&mut self, at: Time, observed: Observed<'_>) -> Result<(), Departure> {
        match observed {
            Observed::Started { random, saved } => {
                let saved = saved.cloned().map(Arc::new);
                let agent = Agent::new(self.fresh.clone(), random.clone());
                self.agent = Some(agent.with_saved(saved));
                self.lives += 1;
            }
            Observed::Corrupted { random } => {
                let agent = self.agent.as_mut().ok_or(Departure::NotStarted)?;
                agent.corrupt(&mut random.clone());
            }
            Observed::Input {
                input,
                view,
                effects,
            } => {
                let agent = self.agent.as_mut().ok_or(Departure::NotStarted)?;
                self.effects.list.clear();
                agent.handle(input, view, &mut self.effects);
                if encode(&self.effects.list) != encode(&effects) {
                    return Err(Departure::Different(Box::new(Difference {
                        agreed: self.entries,
                        at,
                        now: view.now,
                        input: input.clone(),
                        recorded: effects.to_vec(),
                        replayed: self.effects.list.clone(),
                    })));
                }
            }
        }
        self.entries += 1;
        Ok(())
    }

    /// How many entries agree so far.
    pub fn entries(&self) -> u64 {
        self.entries
    }

    /// How often the software has started so far.
    pub fn lives(&self) -> u32 {
        self.lives
    }

    /// The software as it is now; `None` before it has started.
    pub fn agent(&self) -> Option<&Agent> {
        self.agent.as_ref()
    }
}

impl Difference {
    /// The first place in the two lists of effects at which they differ.
    pub fn effect(&self) -> usize {
        let pairs = self.recorded.iter().zip(&self.replayed);
        pairs
            .take_while(|(recorded, replayed)| encode(*recorded) == encode(*replayed))
            .count()
    }
}

impl fmt::Debug for Replayer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Replayer")
            .field("entries", &self.entries)
            .field("lives", &self.lives)
            .finish_non_exhaustive()
    }
}
