//! Trials: runs of an application under profiles of faults, and shrunk failures.
//!
//! Invariant: the same application, profile and seed give the same run everywhere, in `starl test` and in a page.

mod service;
mod shrinking;
mod tried;

pub use service::{ProfileReport, Shrunk, Trials, profiles};
pub use shrinking::{Answers, Extent, Shrinking, Size, Smaller};
pub use tried::Tried;

use crate::Application;
use starl_core::{Duration, Time};
use starl_sim::engine::StartError;
use starl_sim::profile::Profile;
use starl_sim::scenario::Goal;
use starl_sim::{Outcome, Run, Scenario, Trial};

/// An application that was read and compiled once, however often it is tried.
#[derive(Clone, Debug)]
pub struct Subject {
    /// Its scenario and programs.
    pub application: Application,
    /// Whether its goal must be reached under every profile.
    pub demands_goal: bool,
    /// Faults set in within this time: twice what the application takes without them, or as long as it lasts if it has
    /// no other end.
    span: Duration,
}

impl Subject {
    /// Runs the application once to see how long it takes.
    ///
    /// # Errors
    /// Returns only errors that [`read()`](crate::read()) has found before.
    pub fn new(application: &Application, demands_goal: bool) -> Result<Subject, StartError> {
        let mut run = application.run()?;
        let scenario = application.scenario();
        let duration = scenario.duration;
        let span = match scenario.goal {
            Goal::Duration => duration,
            Goal::AllFinished | Goal::Condition(_) => {
                let calm = Trial::of(&mut run, true);
                match calm.outcome {
                    Outcome::Reached => (calm.end.since(Time::ZERO) * 2).min(duration),
                    _ => duration,
                }
            }
        };
        Ok(Subject {
            application: application.clone(),
            demands_goal,
            span,
        })
    }

    /// The subject of a campaign that was begun elsewhere, where `span` was measured.
    ///
    /// # Errors
    /// As for [`Subject::new`].
    pub fn with_span(
        application: &Application,
        demands_goal: bool,
        span: Duration,
    ) -> Result<Subject, StartError> {
        application.run()?;
        Ok(Subject {
            application: application.clone(),
            demands_goal,
            span,
        })
    }

    /// Faults of profiles set in within this time.
    pub fn span(&self) -> Duration {
        self.span
    }

    /// The scenario with the faults that a seed draws.
    pub fn scenario(&self, profile: Profile, seed: u64) -> Scenario {
        profile.apply(self.application.scenario(), self.span, seed)
    }

    /// Runs the application with the faults that a seed draws, until it ends or something goes wrong.
    pub fn try_out(&self, profile: Profile, seed: u64) -> (Run, Trial) {
        let run = self.application.run_of(self.scenario(profile, seed));
        // Profiles change neither programs nor parameters.
        let mut run = run.unwrap_or_else(|error| unreachable!("it ran before: {error:?}"));
        let trial = Trial::of(&mut run, self.demands_goal || profile.demands_goal());
        (run, trial)
    }
}
