//! The values of shared variables: records hold hashes of them, robots the values.

use super::inspect::language_program;
use starl_core::Record;
use starl_core::event::{Event, PrimitiveEvent, SharedMemoryEvent};
use starl_sim::Run;
use std::collections::BTreeSet;
use std::mem;

/// The limit of values that a session reports.
const MOST: usize = 10_000;

/// A value of a shared variable: the variable, the hash of the value in records, and the value as text.
pub type SharedValue = (String, i64, String);

/// The values that the records so far are about. They do not depend on the moment of the run.
#[derive(Clone, Default)]
pub(super) struct SharedValues {
    known: BTreeSet<(String, i64)>,
    fresh: Vec<SharedValue>,
}

impl SharedValues {
    /// Notes the values in the records of a step. Call it after the step, while robots still hold them.
    pub fn look(&mut self, run: &Run, records: &[Record]) {
        for record in records {
            if self.known.len() >= MOST {
                return;
            }
            let Event::Primitive { event, .. } = &record.event else {
                continue;
            };
            let PrimitiveEvent::SharedMemory(event) = event else {
                continue;
            };
            let (variable, hash) = match event {
                SharedMemoryEvent::Initialize {
                    variable, value, ..
                } => (variable, *value),
                SharedMemoryEvent::Write { written }
                | SharedMemoryEvent::WriteAgain { written }
                | SharedMemoryEvent::Update { written } => (&written.variable, written.value),
                _ => continue,
            };
            let key = (variable.to_string(), hash);
            let Some(robot) = record.robot.filter(|_| !self.known.contains(&key)) else {
                continue;
            };
            let program = language_program(run.simulation(), robot);
            let value = program.and_then(|program| program.shared_value(variable, hash));
            if let Some(value) = value {
                self.fresh.push((key.0.clone(), hash, value));
                self.known.insert(key);
            }
        }
    }

    /// Takes the values that are new since the last call.
    pub fn take(&mut self) -> Vec<SharedValue> {
        mem::take(&mut self.fresh)
    }
}
