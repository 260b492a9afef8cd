//! Fault profiles, which add faults to a scenario in the search for violations.
//!
//! A profile is a function of a scenario, a time span and a seed to a scenario. The faults that it adds are
//! an explicit list, drawn from the seed, so that shrinking can remove some. Random faults of the scenario
//! itself are drawn into the same list. All faults begin within the first three quarters of the span, and
//! temporary faults end by then. The rest is calm, so that guarantees after faults can be checked.
//!
//! Every profile draws from its own stream, independent of the run.

mod clocks;
mod corruption;
mod crashes;
mod network;
mod partitions;
mod restarts;

use crate::Scenario;
use crate::engine;
use crate::scenario::{Fault, FaultKind, FaultRates};
use serde::{Deserialize, Serialize};
use starl_core::{Duration, Random, RobotId, Time};

/// Names the draws of profiles among all draws from the seed.
const PURPOSE: u64 = 0x7072_6f66_696c_6500; // "profile"

/// The kinds of faults. The reference is `docs/reference/testing.md`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Profile {
    /// Only the faults of the scenario itself.
    Calm,
    /// Datagrams are lost, doubled, held back and delayed.
    Lossy,
    /// The network parts and heals.
    Partitions,
    /// Robots crash; most of them restart. A majority is up at any time.
    Crashes,
    /// Clocks are apart and run at different rates.
    Clocks,
    /// Most of the above at once.
    Chaos,
    /// Variables are overwritten at random.
    Corruption,
    /// Some of the above, duplicates that arrive seconds late, robots that receive but are not heard, robots that
    /// restart repeatedly, and majorities that crash at once. Each run draws some of them, so that rare combinations
    /// meet (swarm testing, Groce et al. 2012).
    Swarm,
}

impl Profile {
    /// Every profile.
    pub const ALL: [Profile; 8] = [
        Profile::Calm,
        Profile::Lossy,
        Profile::Partitions,
        Profile::Crashes,
        Profile::Clocks,
        Profile::Chaos,
        Profile::Corruption,
        Profile::Swarm,
    ];

    /// The faults under which primitives keep their safety: all except the corruption of state.
    pub const USUAL: [Profile; 7] = [
        Profile::Calm,
        Profile::Lossy,
        Profile::Partitions,
        Profile::Crashes,
        Profile::Clocks,
        Profile::Chaos,
        Profile::Swarm,
    ];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Profile::Calm => "calm",
            Profile::Lossy => "lossy",
            Profile::Partitions => "partitions",
            Profile::Crashes => "crashes",
            Profile::Clocks => "clocks",
            Profile::Chaos => "chaos",
            Profile::Corruption => "corruption",
            Profile::Swarm => "swarm",
        }
    }

    /// The faults, in one line.
    pub fn summary(self) -> &'static str {
        match self {
            Profile::Calm => "no faults but those of the scenario",
            Profile::Lossy => "messages are lost, doubled, held back and delayed",
            Profile::Partitions => "the network splits into parts for a time",
            Profile::Crashes => "robots crash; most of them restart without memory",
            Profile::Clocks => "clocks of robots differ and run at different rates",
            Profile::Chaos => "message faults, splits, crashes and wrong clocks at once",
            Profile::Corruption => "variables of robots are overwritten at random",
            Profile::Swarm => {
                "some of many faults, among them late copies and restart after restart"
            }
        }
    }

    /// The profile of this name.
    pub fn by_name(name: &str) -> Option<Profile> {
        Profile::ALL
            .into_iter()
            .find(|profile| profile.name() == name)
    }

    /// Whether a run must reach its goal nevertheless. With crashes, some robots never restart, and others may wait for
    /// them for ever; with corrupted state, a program may be unable to continue.
    pub fn demands_goal(self) -> bool {
        match self {
            Profile::Calm | Profile::Lossy | Profile::Partitions | Profile::Clocks => true,
            Profile::Crashes | Profile::Chaos | Profile::Corruption | Profile::Swarm => false,
        }
    }

    /// The scenario with the faults that `seed` draws, and with that seed. The faults begin within
    /// `span`, which should be about as long as the run takes without faults.
    pub fn apply(self, scenario: &Scenario, span: Duration, seed: u64) -> Scenario {
        let mut changed = Scenario {
            seed,
            ..scenario.clone()
        };
        list_faults(&mut changed);
        let mut trouble = Trouble {
            random: Random::keyed(seed, &[PURPOSE, self as u64]),
            until: Time::ZERO + span.min(scenario.duration) * 3 / 4,
            scenario: &mut changed,
        };
        match self {
            Profile::Calm => {}
            Profile::Lossy => network::lossy(&mut trouble),
            Profile::Partitions => partitions::part(&mut trouble),
            Profile::Crashes => crashes::crash(&mut trouble),
            Profile::Clocks => clocks::set_wrong(&mut trouble),
            Profile::Chaos => chaos(&mut trouble),
            Profile::Corruption => corruption::corrupt(&mut trouble),
            Profile::Swarm => swarm(&mut trouble),
        }
        // Faults of one time keep their order.
        changed.faults.schedule.sort_by_key(|fault| fault.at);
        changed
    }
}

/// Each kind of trouble three times out of four.
fn chaos(trouble: &mut Trouble<'_>) {
    let kinds = [
        network::lossy,
        partitions::part,
        crashes::crash,
        clocks::set_wrong,
    ];
    trouble.draw(0.75, &kinds);
}

/// Each kind of trouble every other time.
fn swarm(trouble: &mut Trouble<'_>) {
    let kinds = [
        network::lossy,
        network::late,
        partitions::part,
        partitions::one_way,
        clocks::set_wrong,
    ];
    trouble.draw(0.5, &kinds);
    // Only one kind of crash at a time, so that the robots that are down are known.
    match trouble.random.below(5) {
        0 => crashes::crash(trouble),
        1 | 2 => restarts::repeat(trouble),
        3 => restarts::majority(trouble),
        _ => {}
    }
}

/// A scenario that gets into trouble.
struct Trouble<'a> {
    scenario: &'a mut Scenario,
    random: Random,
    /// Temporary faults have ended by then.
    until: Time,
}

impl Trouble<'_> {
    /// Each of these with this likelihood.
    fn draw(&mut self, likelihood: f64, kinds: &[fn(&mut Trouble<'_>)]) {
        for kind in kinds {
            if self.random.chance(likelihood) {
                kind(self);
            }
        }
    }

    fn robots(&self) -> Vec<RobotId> {
        (0..self.scenario.fleet.len() as u32).map(RobotId).collect()
    }

    fn add(&mut self, at: Time, kind: FaultKind) {
        self.scenario.faults.schedule.push(Fault { at, kind });
    }

    /// A moment before the faults end, in whole milliseconds.
    fn moment(&mut self) -> Time {
        Time::ZERO + self.span(0.0, 1.0)
    }

    /// A span of time, as a fraction of the time in which there is trouble, in whole milliseconds.
    fn span(&mut self, least: f64, most: f64) -> Duration {
        let millis = self.random.between(least, most) * self.until.seconds() * 1e3;
        Duration::from_millis(millis as u64)
    }

    /// A number within bounds, to the hundredth, so that it is easy to read.
    fn hundredths(&mut self, low: f64, high: f64) -> f64 {
        (self.random.between(low, high) * 100.0).round() / 100.0
    }

    /// From `low` to `high`, both included.
    fn count(&mut self, low: u32, high: u32) -> u32 {
        low + self.random.below(high.saturating_sub(low) + 1)
    }

    /// One of these.
    fn one<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.random.below(all.len() as u32) as usize]
    }

    /// Some of these, in random order (Fisher and Yates 1938).
    fn some<T>(&mut self, mut all: Vec<T>, count: usize) -> Vec<T> {
        for place in 0..count.min(all.len()) {
            let left = (all.len() - place) as u32;
            let drawn = place + self.random.below(left) as usize;
            all.swap(place, drawn);
        }
        all.truncate(count);
        all
    }
}

/// Draws the random faults of a scenario into its list of faults. The run stays the same.
pub fn list_faults(scenario: &mut Scenario) {
    let end = Time::ZERO + scenario.duration;
    let mut schedule = engine::timeline(scenario);
    schedule.retain(|fault| fault.at < end);
    scenario.faults.schedule = schedule;
    scenario.faults.rates = FaultRates::default();
}
