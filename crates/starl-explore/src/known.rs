//! The states that were found, in parts that threads fill side by side.
//!
//! States with the same robots and checkers belong to one part. So a state is only ever compared with states of its own
//! part, in the order of the steps that led to them, and the result does not depend on the number of threads.

use crate::actors::Actors;
use crate::batch::{Batch, PARTS};
use crate::cover::Covers;
use crate::facts::Facts;
use crate::table::Rows;
use crate::threads::each;
use std::collections::BTreeSet;

/// All states that were found. The number of a state says its part, and its place in there.
#[derive(Clone)]
pub(crate) struct Known {
    parts: Vec<Part>,
    facts: Facts,
}

#[derive(Clone)]
struct Part {
    /// Rows of a head and the actors; with each the state before it.
    states: Rows,
    /// None where a fleet that waits for a lost datagram counts: a state that covers another one does not wait.
    covers: Option<Covers>,
    /// The first state that is further from the start than those that are expanded now.
    level: u32,
    /// States that need not be expanded, since others cover them that are as near to the start.
    covered: BTreeSet<u32>,
}

/// Where a step leads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Arrival {
    /// The number of the state, or of one that covers it.
    pub state: u32,
    pub is_new: bool,
}

impl Known {
    /// No states yet. With `covering`, states that others cover are omitted.
    pub fn new(width: usize, covering: bool) -> Known {
        let part = Part {
            states: Rows::new(width, 1),
            covers: covering.then(|| Covers::new(width)),
            level: 0,
            covered: BTreeSet::new(),
        };
        Known {
            parts: vec![part; PARTS],
            facts: Facts::default(),
        }
    }

    /// The row of a state.
    pub fn row(&self, state: u32) -> &[u32] {
        let (part, place) = self.place(state);
        part.states.row(place)
    }

    /// The state before a state.
    pub fn before(&self, state: u32) -> u32 {
        let (part, place) = self.place(state);
        part.states.kept(place)[0]
    }

    /// Whether a state need not be expanded.
    pub fn is_covered(&self, state: u32) -> bool {
        let (part, place) = self.place(state);
        part.covered.contains(&place)
    }

    fn place(&self, state: u32) -> (&Part, u32) {
        let parts = PARTS as u32;
        (&self.parts[(state % parts) as usize], state / parts)
    }

    /// The states that were found last are expanded now: what is found from now on is further from the start.
    pub fn begin_level(&mut self) {
        for part in &mut self.parts {
            part.covered = part.covered.split_off(&part.level);
            part.level = part.states.len();
        }
    }

    /// Records the actors and heads that were found since the last call.
    pub fn catch_up(&mut self, actors: &Actors, heads: &Rows) {
        self.facts.catch_up(actors, heads);
    }

    /// Enters where the steps of a batch lead, part by part, on several threads perhaps.
    pub fn enter(&mut self, batch: &Batch, parallel: bool) -> Vec<Arrival> {
        let Known { parts, facts } = self;
        let mut steps = [const { Vec::new() }; PARTS];
        for (step, &part) in batch.parts().iter().enumerate() {
            steps[usize::from(part)].push(step);
        }
        let jobs: Vec<_> = parts.iter_mut().zip(&steps).collect();
        let entered = each(parallel, jobs, |(part, steps)| {
            part.enter(steps, batch, facts)
        });
        let mut entered: Vec<_> = entered.into_iter().map(Vec::into_iter).collect();
        let arrivals = batch.parts().iter().filter_map(|&part| {
            let Arrival { state, is_new } = entered[usize::from(part)].next()?;
            let state = state * PARTS as u32 + u32::from(part);
            Some(Arrival { state, is_new })
        });
        arrivals.collect()
    }

    /// Memory in use, bytes.
    pub fn bytes(&self) -> usize {
        let bytes =
            |part: &Part| part.states.bytes() + part.covers.as_ref().map_or(0, Covers::bytes);
        self.facts.bytes() + self.parts.iter().map(bytes).sum::<usize>()
    }
}

impl Part {
    /// Enters where these steps of a batch lead, in order. The numbers of the states are those in this part.
    fn enter(&mut self, steps: &[usize], batch: &Batch, facts: &Facts) -> Vec<Arrival> {
        let enter = |&step: &usize| {
            let (row, before) = (batch.row(step), [batch.before(step)]);
            let Some(covers) = &mut self.covers else {
                let (state, is_new) = self.states.insert(row, &before);
                return Arrival { state, is_new };
            };
            let states = &self.states;
            match covers.add(batch.group(step), row, states.len(), facts, |state| {
                states.row(state)
            }) {
                Err(state) => Arrival {
                    state,
                    is_new: false,
                },
                Ok(others) => {
                    // Those of the present level are not further from the start than this one.
                    let level = self.level;
                    self.covered
                        .extend(others.into_iter().filter(|&other| other >= level));
                    Arrival {
                        state: self.states.push(row, &before),
                        is_new: true,
                    }
                }
            }
        };
        steps.iter().map(enter).collect()
    }
}
