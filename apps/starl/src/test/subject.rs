//! What is tested: a target that was read and compiled once, however often it runs.

use crate::args::TestArguments;
use crate::failure::Failure;
use crate::origin::Origin;
use crate::target::{self, Selection};
use starl_catalog::Application;
use starl_catalog::programs::Registry;
use starl_core::Duration;
use starl_sim::profile::Profile;
use starl_sim::scenario::Goal;
use starl_sim::{Outcome, Scenario, Trial};

/// A target.
pub struct Subject {
    /// As it was given.
    pub target: String,
    /// Its scenario and programs.
    pub application: Application,
    /// Where its files come from.
    pub origin: Origin,
    /// How long it is in trouble at most: twice what it takes when nothing is wrong, or as long as it
    /// lasts if it has no other end.
    pub span: Duration,
    /// Whether its goal is to be reached whatever the trouble.
    pub demands_goal: bool,
}

impl Subject {
    /// Reads a target, and runs it once to see how long it takes.
    pub fn read(
        target: &str,
        arguments: &TestArguments,
        registry: &Registry,
    ) -> Result<Subject, Failure> {
        let quiet = arguments.quiet || arguments.json;
        let selection = target::read(&arguments.changes.of(target, None, quiet), registry)?;
        let Selection {
            application,
            origin,
            ..
        } = selection;
        let scenario = application.scenario();
        let duration = scenario.duration;
        let span = match (scenario.goal, crate::run::start(&application)) {
            (Goal::Duration, _) => duration,
            (Goal::AllFinished, run) => {
                let calm = Trial::of(&mut run?, true);
                match calm.outcome {
                    Outcome::Reached => (calm.end.since(starl_core::Time::ZERO) * 2).min(duration),
                    _ => duration,
                }
            }
        };
        Ok(Subject {
            target: target.to_string(),
            application,
            origin,
            span,
            demands_goal: arguments.demand_goal,
        })
    }

    /// The scenario with the trouble that a seed draws.
    pub fn scenario(&self, profile: Profile, seed: u64) -> Scenario {
        profile.apply(self.application.scenario(), self.span, seed)
    }

    /// Runs it with the trouble that a seed draws.
    pub fn trial(&self, profile: Profile, seed: u64) -> Trial {
        let run = self.application.run_of(self.scenario(profile, seed));
        // Profiles change neither programs nor parameters.
        let mut run = run.unwrap_or_else(|error| unreachable!("it ran before: {error:?}"));
        Trial::of(&mut run, self.demands_goal || profile.demands_goal())
    }
}
