//! All runs, on several threads or on a cluster. The results do not depend on that: runs are identified by their numbers in
//! the campaign, and of equal failures the first counts.

use super::subject::Target;
use crate::cluster::Workers;
use crate::failure::Failure;
use crate::progress::Count;
use starl_catalog::trial::Answers;
use starl_core::event::Name;
use starl_properties::Excuse;
use starl_sim::profile::Profile;
use starl_sim::{Finding, Outcome};
use starl_sweep::{Attempt, Campaign, spread};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

/// The runs to do: every target with every profile and every seed.
pub struct Search {
    /// As they were given, in the order of the campaign.
    pub targets: Vec<Target>,
    pub campaign: Campaign,
}

/// A run that went wrong.
#[derive(Clone, Debug)]
pub struct Case {
    /// The number of the run.
    pub number: u64,
    pub subject: usize,
    pub profile: Profile,
    pub seed: u64,
    pub finding: Finding,
    pub text: String,
}

/// How runs of one subject with one profile ended.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    pub runs: u64,
    pub reached: u64,
    pub timed_out: u64,
    pub violated: u64,
    pub failed: u64,
    /// Those among them that are held to be wrong.
    pub wrong: u64,
    /// How often something was excused that speaks against a property, and why.
    pub excused: BTreeMap<(Name, Excuse), u64>,
}

/// The results of the runs.
#[derive(Default)]
pub struct Found {
    /// By subject and profile.
    pub tallies: BTreeMap<(usize, Profile), Tally>,
    /// By subject and what went wrong: the first such run, and how many there are.
    first: BTreeMap<(usize, Finding), (Case, u64)>,
    /// Time on the wall.
    pub wall: Duration,
    /// Time that the runs had of processors.
    pub cpu_seconds: f64,
}

impl Search {
    /// Does all runs, or as many as there is time for until someone stops it.
    pub fn run(
        &self,
        workers: &mut Workers,
        stop: &AtomicBool,
        progress: &Count,
    ) -> Result<Found, Failure> {
        let begun = Instant::now();
        let mut found = Found::default();
        let numbers = 0..self.campaign.runs();
        let mut take = |attempt: Attempt| {
            found.note(self.campaign.at(attempt.number), attempt);
            progress.add(1);
            Ok(())
        };
        match workers {
            Workers::Threads(threads) => {
                let work = |number| self.campaign.attempt(number);
                spread(*threads, numbers, stop, work, take)?;
            }
            Workers::Cluster(cluster) => {
                let numbers: Vec<u64> = numbers.collect();
                cluster.run("test", &self.campaign.plan(), &numbers, stop, &mut take)?;
            }
        }
        found.wall = begun.elapsed();
        Ok(found)
    }

    /// Searches for smaller scenarios on a cluster, for all cases in parallel. Returns for each case the results of the
    /// scenarios that were tried; empty if interrupted before, or without a cluster.
    pub fn shrink(
        &self,
        cases: &[(Case, u64)],
        workers: &mut Workers,
        stop: &AtomicBool,
        progress: &Count,
    ) -> Result<BTreeMap<u64, Answers>, Failure> {
        let mut known = BTreeMap::new();
        if let Workers::Cluster(cluster) = workers
            && !cases.is_empty()
        {
            let numbers: Vec<u64> = cases.iter().map(|(case, _)| case.number).collect();
            let take = |(number, answers)| {
                known.insert(number, answers);
                progress.add(1);
                Ok(())
            };
            cluster.run("shrink", &self.campaign.plan(), &numbers, stop, take)?;
        }
        Ok(known)
    }
}

impl Found {
    fn note(&mut self, (subject, profile, seed): (usize, Profile, u64), trial: Attempt) {
        self.cpu_seconds += trial.cpu_seconds;
        let tally = self.tallies.entry((subject, profile)).or_default();
        tally.runs += 1;
        match trial.outcome {
            Outcome::Reached => tally.reached += 1,
            Outcome::TimedOut => tally.timed_out += 1,
            Outcome::Violated => tally.violated += 1,
            Outcome::Failed => tally.failed += 1,
        }
        for (property, excuse, count) in trial.excused {
            *tally.excused.entry((property, excuse)).or_default() += count;
        }
        let Some(finding) = trial.finding else { return };
        tally.wrong += 1;
        let number = trial.number;
        let case = Case {
            number,
            subject,
            profile,
            seed,
            finding: finding.clone(),
            text: trial.text,
        };
        match self.first.entry((subject, finding)) {
            Entry::Occupied(mut known) => {
                let (first, times) = known.get_mut();
                *times += 1;
                if number < first.number {
                    *first = case;
                }
            }
            Entry::Vacant(vacant) => {
                vacant.insert((case, 1));
            }
        }
    }

    /// The failures, each kind once, with its count.
    pub fn findings(&self) -> Vec<(Case, u64)> {
        let mut cases: Vec<_> = self.first.values().collect();
        cases.sort_by_key(|(case, _)| case.number);
        cases.into_iter().cloned().collect()
    }

    /// The runs that were done.
    pub fn runs(&self) -> u64 {
        self.tallies.values().map(|tally| tally.runs).sum()
    }
}

impl Case {
    /// The property that was violated, `failed` or `unreached`.
    pub fn property(&self) -> &str {
        self.finding.name()
    }
}
