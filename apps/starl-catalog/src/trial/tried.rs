//! The report of one trial.

use crate::session::{Failure, Messages, Progress, Violation};
use serde::Serialize;
use starl_sim::profile::Profile;
use starl_sim::{Finding, Run, Trial};

/// The result of a run that ended, or was ended by a failure.
#[derive(Clone, Debug, Serialize)]
pub struct Tried {
    /// The profile of faults.
    pub profile: &'static str,
    /// The seed of 64 bits, as text.
    pub seed: String,
    /// `reached`, `violated`, `timed_out` or `failed`.
    pub outcome: &'static str,
    /// The failure: the violated property, `failed` or `unreached`.
    pub wrong: Option<String>,
    /// The observation, in a sentence; empty without a failure.
    pub text: String,
    /// When the run ended, seconds.
    pub now: f64,
    /// The hash of all events, hexadecimal.
    pub digest: String,
    /// How many robots were where at the end.
    pub progress: Progress,
    /// The fate of datagrams.
    pub messages: Messages,
    /// The number of contacts of bodies.
    pub collisions: u64,
    /// Every violation, those of the last step.
    pub violations: Vec<Violation>,
    /// Every program that could not continue.
    pub failures: Vec<Failure>,
}

impl Tried {
    /// The report of a trial that has ended `run`.
    pub fn of((profile, seed): (Profile, u64), run: &Run, trial: &Trial) -> Tried {
        let simulation = run.simulation();
        Tried {
            profile: profile.name(),
            seed: seed.to_string(),
            outcome: trial.outcome.word(),
            wrong: trial
                .finding
                .as_ref()
                .map(Finding::name)
                .map(str::to_string),
            text: trial.text.clone(),
            now: simulation.now().seconds(),
            digest: simulation.digest().to_string(),
            progress: Progress::of(simulation),
            messages: Messages::of(simulation),
            collisions: simulation.tally().collisions,
            violations: Violation::all(run),
            failures: Failure::all(run),
        }
    }
}
