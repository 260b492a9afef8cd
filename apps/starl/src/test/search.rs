//! All runs, on several threads. The results do not depend on their number: runs are identified by
//! their places in the whole list, and of equal failures the first counts.

use super::subject::Subject;
use crate::progress::Count;
use starl_core::event::Name;
use starl_properties::Excuse;
use starl_sim::profile::Profile;
use starl_sim::{Finding, Outcome, Trial};
use starl_sweep::spread;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::convert::Infallible;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

/// The runs to do: every subject with every profile and every seed.
pub struct Search {
    pub subjects: Vec<Subject>,
    pub profiles: Vec<Profile>,
    pub first_seed: u64,
    pub seeds: u64,
}

/// A run that went wrong.
#[derive(Clone, Debug)]
pub struct Case {
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
    /// By subject and what went wrong: the place of the first such run, and how many there are.
    first: BTreeMap<(usize, Finding), (u64, Case, u64)>,
    /// Time on the wall.
    pub wall: Duration,
    /// Time that the process had of the processors.
    pub processors: Duration,
}

impl Search {
    /// How many runs there are.
    pub fn runs(&self) -> u64 {
        (self.subjects.len() * self.profiles.len()) as u64 * self.seeds
    }

    /// Does all runs, or as many as there is time for until someone stops it.
    pub fn run(&self, threads: usize, stop: &AtomicBool, progress: &Count) -> Found {
        let begun = Instant::now();
        let before = cpu_time::ProcessTime::try_now();
        let mut found = Found::default();
        let work = |place| {
            let (subject, profile, seed) = self.at(place);
            let (_, trial) = self.subjects[subject].tested.try_out(profile, seed);
            (place, (subject, profile, seed), trial)
        };
        let Ok(()) = spread(
            threads,
            0..self.runs(),
            stop,
            work,
            |(place, key, trial)| {
                found.note(place, key, trial);
                progress.add(1);
                Ok::<(), Infallible>(())
            },
        );
        found.wall = begun.elapsed();
        found.processors = match (before, cpu_time::ProcessTime::try_now()) {
            (Ok(before), Ok(after)) => after.duration_since(before),
            _ => found.wall,
        };
        found
    }

    /// The run at a place in the list.
    fn at(&self, place: u64) -> (usize, Profile, u64) {
        let (kind, seed) = (place / self.seeds, place % self.seeds);
        let profiles = self.profiles.len() as u64;
        let profile = self.profiles[(kind % profiles) as usize];
        let subject = (kind / profiles) as usize;
        (subject, profile, self.first_seed + seed)
    }
}

impl Found {
    fn note(&mut self, place: u64, (subject, profile, seed): (usize, Profile, u64), trial: Trial) {
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
        let case = Case {
            subject,
            profile,
            seed,
            finding: finding.clone(),
            text: trial.text,
        };
        match self.first.entry((subject, finding)) {
            Entry::Occupied(mut known) => {
                let (first, its_case, times) = known.get_mut();
                *times += 1;
                if place < *first {
                    (*first, *its_case) = (place, case);
                }
            }
            Entry::Vacant(vacant) => {
                vacant.insert((place, case, 1));
            }
        }
    }

    /// The failures, each kind once, with its count.
    pub fn findings(&self) -> Vec<(Case, u64)> {
        let mut cases: Vec<_> = self.first.values().collect();
        cases.sort_by_key(|(place, ..)| *place);
        let told = |(_, case, times): &(u64, Case, u64)| (case.clone(), *times);
        cases.into_iter().map(told).collect()
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
