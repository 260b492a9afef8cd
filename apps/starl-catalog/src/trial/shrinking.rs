//! A run that went wrong, made as small as it can be while it still goes wrong.
//!
//! Shrinking changes the text of a scenario's file: every candidate is written, read and run as `starl run` would, so
//! that the resulting file fails like the run.

use super::Subject;
use crate::programs::Registry;
use crate::{Application, read};
use serde::Serialize;
use starl_core::{Duration, Time};
use starl_sim::profile::Profile;
use starl_sim::read::{Loader, Request, Source};
use starl_sim::shrink::{self, Limits, shrink};
use starl_sim::{Cause, Finding, History, Run, Scenario, Trial, write};

/// A search for the smallest scenario that fails as a run did. It can be made in pieces: the results of trials are
/// kept.
pub struct Shrinking {
    original: Scenario,
    finding: Finding,
    registry: Registry,
    /// Comments that the file begins with.
    head: String,
    answers: Answers,
    /// The causal past of the original's failure; none before the original has run in this process.
    cause: Option<Cause>,
}

/// When each scenario failed that a search tried so far, in order. The search depends on nothing else, so it can be
/// made in one process and its result taken in another.
pub type Answers = Vec<Option<Time>>;

/// A scenario that fails, as small as it was found.
pub struct Smaller {
    /// The scenario.
    pub scenario: Scenario,
    /// Its file.
    pub text: String,
    /// As it is read from that file.
    pub application: Application,
    /// Its run up to the failure.
    pub run: Run,
    /// The result of that run.
    pub trial: Trial,
    /// How many scenarios were tried.
    pub trials: u64,
    /// Whether nothing more can be left out.
    pub is_minimal: bool,
}

/// How large a scenario is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Robots at the start.
    pub robots: usize,
    /// Faults of one robot or of the network each, drawn ones included.
    pub faults: usize,
    /// When the run ends at the latest.
    pub duration: Duration,
}

impl Size {
    /// The size of a scenario.
    pub fn of(scenario: &Scenario) -> Size {
        Size {
            robots: scenario.fleet.len(),
            faults: shrink::faults(scenario),
            duration: scenario.duration,
        }
    }
}

/// How large a scenario is, for people.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Extent {
    /// Robots at the start.
    pub robots: usize,
    /// Faults of one robot or of the network each, drawn ones included.
    pub faults: usize,
    /// When the run ends at the latest.
    pub duration_seconds: f64,
}

impl From<Size> for Extent {
    fn from(size: Size) -> Extent {
        Extent {
            robots: size.robots,
            faults: size.faults,
            duration_seconds: size.duration.seconds(),
        }
    }
}

impl Shrinking {
    /// A search that begins with the run of a profile and a seed. `rename` gives the names of programs in the file that
    /// is left, which begins with `head`.
    pub fn new(
        subject: &Subject,
        (profile, seed): (Profile, u64),
        finding: Finding,
        head: String,
        rename: &dyn Fn(&str) -> String,
    ) -> Shrinking {
        let mut original = subject.scenario(profile, seed);
        for group in &mut original.fleet.groups {
            group.program = rename(&group.program);
        }
        original.title = format!("{}: {finding}", original.title);
        Shrinking {
            original,
            finding,
            registry: subject.application.registry().clone(),
            head,
            answers: Vec::new(),
            cause: None,
        }
    }

    /// The same search, after another process tried scenarios for it.
    #[must_use]
    pub fn after(self, answers: Answers) -> Shrinking {
        Shrinking { answers, ..self }
    }

    /// The results of all trials so far.
    pub fn into_answers(self) -> Answers {
        self.answers
    }

    /// The size before anything is left out.
    pub fn size(&self) -> Size {
        Size::of(&self.original)
    }

    /// Tries `most` scenarios in all, at least one; those that were tried by earlier calls are not run again. `loader`
    /// is for the files that they name; `watch` sees each before it runs, and ends the search by returning false.
    ///
    /// Returns `None` if the scenario does not fail when it is read from a file of its own.
    pub fn search(
        &mut self,
        most: u64,
        loader: &dyn Loader,
        watch: &mut dyn FnMut(&Scenario) -> bool,
    ) -> Option<Smaller> {
        let limits = Limits {
            trials: most.max(1),
            ..Limits::default()
        };
        let shorter = self.finding != Finding::Unreached;
        let mut known = std::mem::take(&mut self.answers);
        let mut next = 0;
        let mut first: Option<Scenario> = None;
        let original = self.original.clone();
        let shrunk = shrink(&original, limits, shorter, &mut |scenario| {
            let first = first.get_or_insert_with(|| scenario.clone());
            let failed_at = match known.get(next) {
                Some(known) => *known,
                None if !watch(scenario) => return None,
                None => {
                    if self.cause.is_none() && next > 0 {
                        // The original ran in another process.
                        self.failure(first, loader);
                    }
                    let failed_at = self.failure(scenario, loader);
                    known.push(failed_at);
                    failed_at
                }
            };
            next += 1;
            failed_at
        });
        self.answers = known;
        let shrunk = shrunk?;
        let (application, run, trial, _) = self.trial(&shrunk.scenario, loader)?;
        Some(Smaller {
            text: self.text(&shrunk.scenario),
            scenario: shrunk.scenario,
            application,
            run,
            trial,
            trials: shrunk.trials,
            is_minimal: shrunk.is_minimal,
        })
    }

    fn text(&self, scenario: &Scenario) -> String {
        format!("{}{}", self.head, write::scenario(scenario))
    }

    /// The time at which a scenario fails, if it fails for the original's reason. The first call must be for the original.
    fn failure(&mut self, scenario: &Scenario, loader: &dyn Loader) -> Option<Time> {
        let (.., trial, cause) = self.trial(scenario, loader)?;
        let original = self.cause.get_or_insert_with(|| cause.clone());
        cause.is_part_of(original).then_some(trial.end)
    }

    /// The result of a scenario that is read from its file, and the cause of its failure, if its finding is the original's.
    fn trial(
        &self,
        scenario: &Scenario,
        loader: &dyn Loader,
    ) -> Option<(Application, Run, Trial, Cause)> {
        let source = Source::new("the smaller scenario".to_string(), self.text(scenario));
        let application = read(&Request::new(source), loader, &self.registry).ok()?;
        let mut run = application.run().ok()?;
        let demands_goal = self.finding == Finding::Unreached;
        let mut history = History::default();
        let trial = Trial::watched(&mut run, demands_goal, &mut |records| {
            history.observe(records)
        });
        if trial.finding.as_ref() != Some(&self.finding) {
            return None;
        }
        let cause = history.cause(&run, &self.finding);
        Some((application, run, trial, cause))
    }
}
