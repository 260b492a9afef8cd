//! Runs and traces: a session of the run that a trace records, and the trace of a session.
//!
//! A session forgets its records when they are taken, so its trace is made by running again from the start, which is
//! exact.

use super::open::Refused;
use super::{Diagnostic, Session};
use crate::programs::Registry;
use crate::{read, recording};
use serde::Deserialize;
use starl_core::{Intervention, Time};
use starl_trace::{Header, Outcome, ViewOptions, Writer};
use std::collections::BTreeMap;

/// The start and the interventions of a run, from its trace.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Recorded {
    /// The attachment `starl/scenario.toml`.
    pub scenario: String,
    /// The attachments `starl/files/NAME`, by name.
    pub files: BTreeMap<String, String>,
    /// When the run was steered, nanoseconds, and how: the records on `/starl/intervention`.
    pub interventions: Vec<(u64, Intervention)>,
}

/// The word for how a run ended that was not over.
const INTERRUPTED: &str = "interrupted";

impl Session {
    /// Opens the run that a trace records, at its start.
    ///
    /// # Errors
    /// Why it cannot be run again.
    pub fn open_recorded(recorded: Recorded, registry: &Registry) -> Result<Session, Refused> {
        let header = Header {
            scenario: recorded.scenario,
            files: recorded.files,
            ..Header::default()
        };
        let again = |what: String| format!("the recorded run cannot be run again: {what}");
        let inputs = recording::inputs(&header).map_err(|error| again(error.to_string()))?;
        let application = read(&inputs.request, &inputs, registry);
        let application = application.map_err(|refusal| again(refusal.to_string()))?;
        let mut session = Session::of(application, BTreeMap::new(), Vec::<Diagnostic>::new())?;
        let steered = recorded.interventions.into_iter();
        session
            .live
            .run
            .repeat(steered.map(|(at, what)| (Time(at), what)));
        Ok(session)
    }

    /// The trace of the run up to the present moment, as `starl run --trace` writes it. Takes as long as the run.
    ///
    /// # Errors
    /// The error of an event that a trace cannot contain.
    pub fn trace(&self) -> Result<Vec<u8>, Refused> {
        let now = self.run().simulation().now();
        let run = self.application.run();
        let mut run = run.map_err(|error| self.application.problem(error))?;
        for (at, what) in self.run().simulation().applied() {
            run.apply(*at, what.clone())?;
        }
        let header = recording::header(self.application.resolved(), &run.setting());
        let mut writer = Writer::new(Vec::new(), &header, &ViewOptions::default())?;
        while run.simulation().now() < now {
            for record in run.step() {
                writer.write(record)?;
            }
        }
        let outcome = match run.is_over() {
            true => run.outcome().word(),
            false => INTERRUPTED,
        };
        let outcome = Outcome {
            outcome: outcome.to_string(),
            digest: run.simulation().digest().value(),
            end: now,
        };
        Ok(writer.finish(&outcome)?)
    }
}
