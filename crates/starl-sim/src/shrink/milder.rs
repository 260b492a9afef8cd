//! Reductions of the trouble: a better network, correct clocks, exact sensors and motion.
//!
//! Every change removes or reduces a trouble, so the search ends.

use super::Search;
use crate::Scenario;
use crate::scenario::{Clock, DelayDistribution, Faults, Link, Network, Wind};
use starl_core::Duration;

/// A change of a scenario; false if it would change nothing.
type Change = fn(&mut Scenario) -> bool;

/// A link that leaves nothing to chance.
fn ideal() -> Link {
    Link {
        distribution: DelayDistribution::Constant,
        ..Link::default()
    }
}

/// Puts a value in a place; whether it was another.
fn set<T: PartialEq>(place: &mut T, value: T) -> bool {
    let differs = *place != value;
    *place = value;
    differs
}

/// From the most to the least that can be taken away.
const CHANGES: &[Change] = &[
    |scenario| {
        let ideal = Network {
            link: ideal(),
            ..Network::default()
        };
        set(&mut scenario.network, ideal)
    },
    |scenario| set(&mut scenario.network.link, ideal()),
    |scenario| {
        // Link by link there is nothing to take away any more.
        let default = Link::default();
        scenario.network.link != ideal() && set(&mut scenario.network.link, default)
    },
    |scenario| set(&mut scenario.network.overrides, Vec::new()),
    |scenario| set(&mut scenario.network.range, None),
    |scenario| set(&mut scenario.network.line_of_sight, false),
    |scenario| set(&mut scenario.network.bandwidth, None),
    |scenario| set(&mut scenario.network.link.loss, 0.0),
    |scenario| set(&mut scenario.network.link.duplication, 0.0),
    |scenario| {
        let link = &mut scenario.network.link;
        let delay = Link::default().reordering_delay;
        set(&mut link.reordering, 0.0) | set(&mut link.reordering_delay, delay)
    },
    |scenario| {
        set(
            &mut scenario.network.link.distribution,
            DelayDistribution::Constant,
        )
    },
    |scenario| {
        // An exponential delay is not shorter than its jitter.
        let link = &mut scenario.network.link;
        let default = Link::default();
        link.delay > default.delay && set(&mut link.delay, default.delay) && {
            link.jitter = link.jitter.min(default.jitter);
            true
        }
    },
    |scenario| lessen(&mut scenario.network.link.loss),
    |scenario| lessen(&mut scenario.network.link.duplication),
    |scenario| lessen(&mut scenario.network.link.reordering),
    |scenario| clocks(scenario, |_| Clock::default()),
    |scenario| {
        clocks(scenario, |clock| Clock {
            offset: Duration::ZERO,
            ..clock
        })
    },
    |scenario| {
        clocks(scenario, |clock| Clock {
            drift_ppm: 0.0,
            ..clock
        })
    },
    |scenario| offsets(scenario, 100),
    |scenario| offsets(scenario, 1_000),
    |scenario| offsets(scenario, 10_000),
    |scenario| offsets(scenario, 100_000),
    |scenario| {
        let positioning = &mut scenario.positioning;
        set(&mut positioning.position_noise, 0.0)
            | set(&mut positioning.heading_noise, 0.0)
            | set(&mut positioning.velocity_noise, 0.0)
    },
    |scenario| {
        set(&mut scenario.motion.speed_noise, 0.0) | set(&mut scenario.motion.turn_noise, 0.0)
    },
    |scenario| set(&mut scenario.storage.loss, 0.0),
    |scenario| set(&mut scenario.storage.write_time, Duration::ZERO),
    |scenario| {
        let calm = Wind {
            gust_period: scenario.wind.gust_period,
            ..Wind::default()
        };
        set(&mut scenario.wind, calm)
    },
];

/// The scenario without faults, with an ideal network and right clocks.
pub(super) fn without_trouble(scenario: &Scenario) -> Scenario {
    let mut calm = scenario.clone();
    calm.faults = Faults::default();
    calm.network.link = ideal();
    calm.network.overrides.clear();
    each_clock(&mut calm, &|_| Clock::default());
    calm
}

/// Half of a probability, to the hundredth.
fn lessen(probability: &mut f64) -> bool {
    let half = (*probability * 50.0).floor() / 100.0;
    half > 0.0 && set(probability, half)
}

fn clocks(scenario: &mut Scenario, change: fn(Clock) -> Clock) -> bool {
    each_clock(scenario, &change)
}

/// Brings clocks nearer together.
fn offsets(scenario: &mut Scenario, millis: u64) -> bool {
    let least = Duration::from_millis(millis);
    each_clock(scenario, &|clock| Clock {
        offset: clock.offset.min(least),
        ..clock
    })
}

fn each_clock(scenario: &mut Scenario, change: &dyn Fn(Clock) -> Clock) -> bool {
    let mut any = false;
    for group in &mut scenario.fleet.groups {
        let changed = change(group.clock);
        any |= set(&mut group.clock, changed);
    }
    any
}

impl Search<'_> {
    /// Takes trouble away, as much as can be.
    pub(super) fn milder(&mut self) -> bool {
        self.each(CHANGES, |change, scenario| change(scenario))
    }
}
