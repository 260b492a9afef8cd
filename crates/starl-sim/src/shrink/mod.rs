//! Shrinks a failing scenario while it still fails: fewer robots, fewer faults, a shorter run, a better network,
//! correct clocks, an emptier world.
//!
//! Every step proposes a smaller scenario and keeps it if it fails in the same way. Lists are reduced by delta
//! debugging (Zeller and Hildebrandt 2002, "Simplifying and Isolating Failure-Inducing Input"). All kinds of steps are
//! tried in turn until none succeeds, so the result is minimal in this sense: no single robot, fault or network problem
//! can be removed. This holds for the tried seeds: because fewer robots draw other numbers, a few seeds are tried where
//! the first one does not fail.
//!
//! A smaller fleet may fail for another reason: two robots form no polygon. So if the whole fleet does not fail without
//! trouble, with several seeds, no smaller fleet is accepted that does. If a majority of the robots was up and
//! connected all the time, this stays so; if it was lost, the fleet stays large enough to have one.
//!
//! The caller decides what fails; this module does not run scenarios.

mod delta;
mod faults;
mod majority;
mod milder;
mod robots;

use crate::{Scenario, profile};
use delta::minimise;
use starl_core::{Duration, Time};

pub use robots::keep_robots;

/// How long to continue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Smaller scenarios that are tried at most; default 1,000.
    pub trials: u64,
    /// Seeds tried besides the first where another seed may do; default 20.
    pub seeds: u64,
}

impl Default for Limits {
    fn default() -> Limits {
        Limits {
            trials: 1_000,
            seeds: 20,
        }
    }
}

/// The result of shrinking.
#[derive(Clone, Debug)]
pub struct Shrunk {
    /// The smallest scenario that was found to fail.
    pub scenario: Scenario,
    /// How many scenarios were tried.
    pub trials: u64,
    /// Whether nothing can be left out any more; the limit came first otherwise.
    pub is_minimal: bool,
}

/// The smallest scenario that fails as `scenario` does. `fails` runs one and says when it failed in that
/// way; none if it did not. With `shorter` the run is cut off when it fails, which makes no sense where the
/// failure is that something did not happen.
///
/// Returns `None` if the scenario does not fail at all.
pub fn shrink(
    scenario: &Scenario,
    limits: Limits,
    shorter: bool,
    fails: &mut dyn FnMut(&Scenario) -> Option<Time>,
) -> Option<Shrunk> {
    let best = listed(scenario);
    let failed_at = fails(&best)?;
    let mut search = Search {
        best,
        failed_at,
        limits,
        trials: 1,
        shorter,
        needs_trouble: false,
        loses_majority: false,
        least_robots: 1,
        fails,
    };
    search.loses_majority = majority::is_lost(&search.best);
    search.least_robots = majority::least_robots(&search.best, shorter);
    search.needs_trouble = !search.fails_without_trouble(scenario, limits.seeds);
    let mut is_minimal = false;
    while !is_minimal && !search.is_exhausted() {
        is_minimal = !search.round();
    }
    let is_minimal = is_minimal && !search.is_exhausted();
    Some(Shrunk {
        scenario: search.best,
        trials: search.trials,
        is_minimal,
    })
}

/// The scenario with each fault, drawn ones included, as one of one robot or of the network. The run stays the same.
fn listed(scenario: &Scenario) -> Scenario {
    let mut listed = scenario.clone();
    profile::list_faults(&mut listed);
    faults::one_by_one(&mut listed);
    listed
}

/// The number of faults in a scenario, of one robot or of the network each, drawn ones included.
pub fn faults(scenario: &Scenario) -> usize {
    listed(scenario).faults.schedule.len()
}

/// The next longer round duration: tenths of a second, and from ten seconds on whole seconds.
fn round_up(duration: Duration) -> Duration {
    let grain = match duration.0 {
        ..10_000_000_000 => 100_000_000,
        _ => 1_000_000_000,
    };
    Duration(duration.0.div_ceil(grain).max(1) * grain)
}

/// The scenario with another duration, without the faults that come later.
fn lasting(scenario: &Scenario, duration: Duration) -> Scenario {
    let mut shorter = scenario.clone();
    shorter.duration = duration;
    let end = Time::ZERO + duration;
    shorter.faults.schedule.retain(|fault| fault.at < end);
    shorter
}

/// The search for the smallest scenario.
struct Search<'a> {
    /// The smallest that fails, so far.
    best: Scenario,
    /// When it does.
    failed_at: Time,
    limits: Limits,
    trials: u64,
    shorter: bool,
    /// Whether the fleet as it was found fails only in trouble.
    needs_trouble: bool,
    /// Whether faults leave no majority of it at some time.
    loses_majority: bool,
    /// No smaller fleet is tried.
    least_robots: usize,
    fails: &'a mut dyn FnMut(&Scenario) -> Option<Time>,
}

impl Search<'_> {
    /// Tries every kind of step once; whether any was of use.
    fn round(&mut self) -> bool {
        // Robots go first, and the length last: fewer robots may need longer to fail.
        let steps: [fn(&mut Self) -> bool; 7] = [
            Search::fewer_robots,
            Search::fewer_faults,
            Search::milder,
            Search::emptier,
            Search::cut,
            Search::sooner,
            Search::rounder,
        ];
        let mut any = false;
        for step in steps {
            any |= step(self);
        }
        any
    }

    fn is_exhausted(&self) -> bool {
        self.trials >= self.limits.trials
    }

    /// Runs a scenario, unless so many were run that it is time to stop, or it loses a majority that was there.
    fn try_out(&mut self, candidate: &Scenario) -> Option<Time> {
        let loses_majority = !self.loses_majority && majority::is_lost(candidate);
        if self.is_exhausted() || loses_majority {
            return None;
        }
        self.trials += 1;
        (self.fails)(candidate)
    }

    /// Keeps the candidate if it fails.
    fn propose(&mut self, candidate: Scenario) -> bool {
        let failed_at = self.try_out(&candidate);
        if let Some(at) = failed_at {
            (self.best, self.failed_at) = (candidate, at);
        }
        failed_at.is_some()
    }

    /// Keeps a candidate with a smaller fleet if it fails, and for the trouble that it is in if that was so
    /// before.
    fn propose_fleet(&mut self, candidate: Scenario) -> bool {
        let failed_at = self.try_out(&candidate);
        let fails = failed_at.is_some()
            && !(self.needs_trouble && self.fails_without_trouble(&candidate, 0));
        if let (true, Some(at)) = (fails, failed_at) {
            (self.best, self.failed_at) = (candidate, at);
        }
        fails
    }

    /// Whether the scenario without faults in an ideal network fails with its own seed or one of so many
    /// others.
    fn fails_without_trouble(&mut self, scenario: &Scenario, seeds: u64) -> bool {
        let mut calm = milder::without_trouble(scenario);
        let mut seeds = [scenario.seed].into_iter().chain(1..=seeds);
        seeds.any(|seed| {
            calm.seed = seed;
            self.try_out(&calm).is_some()
        })
    }

    /// Proposes a scenario with its own seed and, if it does not fail with that, with others.
    fn with_seeds(
        &mut self,
        candidate: &Scenario,
        propose: fn(&mut Self, Scenario) -> bool,
    ) -> bool {
        let mut seeds = [candidate.seed].into_iter().chain(1..=self.limits.seeds);
        seeds.any(|seed| {
            let mut candidate = candidate.clone();
            candidate.seed = seed;
            propose(self, candidate)
        })
    }

    /// Ends the run when it fails.
    fn cut(&mut self) -> bool {
        let duration = round_up(self.failed_at.since(Time::ZERO));
        if !self.shorter || duration >= self.best.duration {
            return false;
        }
        let candidate = lasting(&self.best, duration);
        self.propose(candidate)
    }

    /// Looks for a seed with which the run fails in half the time.
    fn sooner(&mut self) -> bool {
        let half = round_up(self.best.duration / 2);
        if !self.shorter || half >= self.best.duration {
            return false;
        }
        let candidate = lasting(&self.best, half);
        self.with_seeds(&candidate, Search::propose)
    }

    fn fewer_robots(&mut self) -> bool {
        let base = self.best.clone();
        let all: Vec<usize> = (0..base.fleet.len()).collect();
        let kept = minimise(&all, &mut |kept| {
            if kept.len() < self.least_robots {
                return false;
            }
            let mut candidate = keep_robots(&base, kept);
            (candidate.seed, candidate.duration) = (self.best.seed, self.best.duration);
            self.with_seeds(&candidate, Search::propose_fleet)
        });
        kept.len() < all.len()
    }

    fn fewer_faults(&mut self) -> bool {
        let base = self.best.faults.schedule.clone();
        let kept = minimise(&base, &mut |kept| {
            let mut candidate = self.best.clone();
            candidate.faults.schedule = kept.to_vec();
            self.propose(candidate)
        });
        kept.len() < base.len()
    }

    fn emptier(&mut self) -> bool {
        let base = self.best.world.obstacles.clone();
        let kept = minimise(&base, &mut |kept| {
            let mut candidate = self.best.clone();
            candidate.world.obstacles = kept.to_vec();
            self.propose(candidate)
        });
        kept.len() < base.len()
    }

    /// Tries changes one after the other, each on what the ones before have left.
    fn each<T>(&mut self, changes: &[T], change: impl Fn(&T, &mut Scenario) -> bool) -> bool {
        let mut any = false;
        for wanted in changes {
            let mut candidate = self.best.clone();
            any |= change(wanted, &mut candidate) && self.propose(candidate);
        }
        any
    }
}
