//! All runs, on several threads. The results do not depend on their number: runs are identified by
//! their places in the whole list, and of equal failures the first counts.

use super::subject::Subject;
use crate::progress::Count;
use starl_core::event::Name;
use starl_properties::Excuse;
use starl_sim::profile::Profile;
use starl_sim::{Finding, Outcome, Trial};
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread;
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
        let next = AtomicU64::new(0);
        let begun = Instant::now();
        let before = cpu_time::ProcessTime::try_now();
        let mut all = Found::default();
        thread::scope(|scope| {
            let work = || self.work(&next, stop, progress);
            let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
            for worker in workers {
                match worker.join() {
                    Ok(found) => all.add(found),
                    // A bug of ours: it is told as such.
                    Err(panic) => std::panic::resume_unwind(panic),
                }
            }
        });
        all.wall = begun.elapsed();
        all.processors = match (before, cpu_time::ProcessTime::try_now()) {
            (Ok(before), Ok(after)) => after.duration_since(before),
            _ => all.wall,
        };
        all
    }

    fn work(&self, next: &AtomicU64, stop: &AtomicBool, progress: &Count) -> Found {
        let mut found = Found::default();
        let runs = self.runs();
        loop {
            let place = next.fetch_add(1, Ordering::Relaxed);
            if place >= runs || stop.load(Ordering::Relaxed) {
                return found;
            }
            let (subject, profile, seed) = self.at(place);
            let tested = &self.subjects[subject].tested;
            let (_, trial) = tested.try_out(profile, seed);
            found.note(place, (subject, profile, seed), trial);
            progress.add(1);
        }
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
        self.keep((subject, finding), (place, case, 1));
    }

    fn keep(&mut self, key: (usize, Finding), (place, case, times): (u64, Case, u64)) {
        match self.first.get_mut(&key) {
            Some(known) => {
                known.2 += times;
                if place < known.0 {
                    (known.0, known.1) = (place, case);
                }
            }
            None => {
                self.first.insert(key, (place, case, times));
            }
        }
    }

    fn add(&mut self, other: Found) {
        for (key, tally) in other.tallies {
            let sum = self.tallies.entry(key).or_default();
            sum.runs += tally.runs;
            sum.reached += tally.reached;
            sum.timed_out += tally.timed_out;
            sum.violated += tally.violated;
            sum.failed += tally.failed;
            sum.wrong += tally.wrong;
            for (excused, count) in tally.excused {
                *sum.excused.entry(excused).or_default() += count;
            }
        }
        for (key, case) in other.first {
            self.keep(key, case);
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
