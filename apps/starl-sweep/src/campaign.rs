//! Campaigns: applications run under profiles of faults with many seeds, to find what goes wrong.
//!
//! Runs are numbered with the target slowest and the seed fastest. Each run, and each search for a smaller scenario, depends
//! on the campaign and its number alone, and so can be made in any process that holds the [`CampaignPlan`].

use crate::Error;
use crate::task::start_error;
use cpu_time::ThreadTime;
use serde::{Deserialize, Serialize};
use starl_catalog::programs::Registry;
use starl_catalog::read;
use starl_catalog::trial::{Answers, Shrinking, Subject};
use starl_core::Duration;
use starl_core::event::Name;
use starl_properties::Excuse;
use starl_sim::profile::Profile;
use starl_sim::read::Inputs;
use starl_sim::{Finding, Outcome, Run, Scenario, Trial};

/// The runs of a campaign: every target with every profile and every seed.
pub struct Campaign {
    subjects: Vec<Subject>,
    settings: Settings,
}

/// The runs that a campaign makes of each target.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// The kinds of faults.
    pub profiles: Vec<Profile>,
    /// The first seed; the others follow.
    pub first_seed: u64,
    /// The number of seeds.
    pub seeds: u64,
    /// How many scenarios a search for a smaller one tries.
    pub most_trials: u64,
}

/// A campaign as plain data, for another process.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CampaignPlan {
    targets: Vec<Target>,
    settings: Settings,
}

/// A scenario with the files that it names.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Target {
    inputs: Inputs,
    demands_goal: bool,
    /// Faults set in within this time.
    span: Duration,
}

/// The result of one run. The same run of the same campaign gives the same result on every machine, except for
/// `cpu_seconds`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Attempt {
    /// The number of the run.
    pub number: u64,
    /// How it ended.
    pub outcome: Outcome,
    /// The first failure.
    pub finding: Option<Finding>,
    /// The observation, in a sentence; empty without a failure.
    pub text: String,
    /// How often something was excused that speaks against a property, and why.
    pub excused: Vec<(Name, Excuse, u64)>,
    /// The hash of all events, hexadecimal.
    pub digest: String,
    /// Time that the run had of a processor, seconds.
    pub cpu_seconds: f64,
}

impl Campaign {
    /// A campaign of these subjects.
    pub fn new(subjects: Vec<Subject>, settings: Settings) -> Campaign {
        Campaign { subjects, settings }
    }

    /// The campaign of a plan that [`Campaign::plan`] gave, in this process or in another.
    ///
    /// # Errors
    /// If a program is not known here.
    pub fn of_plan(plan: CampaignPlan, registry: &Registry) -> Result<Campaign, Error> {
        let subject = |target: &Target| -> Result<Subject, Error> {
            let application = read(&target.inputs.request, &target.inputs, registry)?;
            let subject = Subject::with_span(&application, target.demands_goal, target.span);
            subject.map_err(|error| start_error(&application, error))
        };
        let subjects: Result<Vec<Subject>, Error> = plan.targets.iter().map(subject).collect();
        Ok(Campaign::new(subjects?, plan.settings))
    }

    /// The campaign as plain data.
    pub fn plan(&self) -> CampaignPlan {
        let target = |subject: &Subject| Target {
            inputs: subject.application.resolved().inputs.clone(),
            demands_goal: subject.demands_goal,
            span: subject.span(),
        };
        CampaignPlan {
            targets: self.subjects.iter().map(target).collect(),
            settings: self.settings.clone(),
        }
    }

    /// The targets.
    pub fn subjects(&self) -> &[Subject] {
        &self.subjects
    }

    /// The runs that are made of each target.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// How many runs there are.
    pub fn runs(&self) -> u64 {
        (self.subjects.len() * self.settings.profiles.len()) as u64 * self.settings.seeds
    }

    /// The subject by its place, the profile and the seed of a run.
    pub fn at(&self, number: u64) -> (usize, Profile, u64) {
        let Settings {
            profiles,
            first_seed,
            seeds,
            ..
        } = &self.settings;
        let (kind, seed) = (number / seeds, number % seeds);
        let count = profiles.len() as u64;
        let profile = profiles[(kind % count) as usize];
        let subject = (kind / count) as usize;
        (subject, profile, first_seed + seed)
    }

    /// Makes a run, until it ends or something goes wrong.
    pub fn attempt(&self, number: u64) -> Attempt {
        let before = ThreadTime::try_now();
        let (run, trial) = self.try_out(number);
        let spent = before.and_then(|before| before.try_elapsed());
        Attempt {
            number,
            outcome: trial.outcome,
            finding: trial.finding,
            text: trial.text,
            excused: trial.excused,
            digest: run.simulation().digest().to_string(),
            cpu_seconds: spent.map_or(0.0, |spent| spent.as_secs_f64()),
        }
    }

    fn try_out(&self, number: u64) -> (Run, Trial) {
        let (subject, profile, seed) = self.at(number);
        self.subjects[subject].try_out(profile, seed)
    }

    /// Looks for a smaller scenario that fails as a run does. The result is what to give to
    /// [`Shrinking::after`]; empty if nothing goes wrong in this run.
    pub fn shrink(&self, number: u64) -> Answers {
        let (subject, profile, seed) = self.at(number);
        let Some(finding) = self.try_out(number).1.finding else {
            return Answers::new();
        };
        let subject = &self.subjects[subject];
        let same = |program: &str| program.to_string();
        let mut shrinking = Shrinking::new(subject, (profile, seed), finding, String::new(), &same);
        let inputs = &subject.application.resolved().inputs;
        shrinking.search(self.settings.most_trials, inputs, &mut |_: &Scenario| true);
        shrinking.into_answers()
    }
}
