//! The interventions of a run with their times: faults and events of the scenario, and those applied
//! during the run.

use super::{Stream, fault, stream};
use crate::scenario::{Bounds, Occasion, Scenario};
use starl_core::{Duration, Intervention, Point, Time};

/// One intervention that is due.
#[derive(Clone, Debug, PartialEq)]
pub struct Due {
    pub at: Time,
    pub what: Intervention,
    /// Whether it is recorded as an intervention, and not only by its effects on robots.
    pub told: bool,
}

/// All interventions of a run in the order in which they take place.
#[derive(Clone, Debug)]
pub struct Agenda {
    list: Vec<Due>,
    done: usize,
    /// The interventions applied from outside.
    applied: Vec<(Time, Intervention)>,
}

impl Agenda {
    /// The scheduled and random faults and events of a scenario. At equal times faults come first.
    pub fn new(scenario: &Scenario) -> Agenda {
        let faults = fault::timeline(scenario).into_iter().map(|fault| Due {
            at: fault.at,
            what: Intervention::Fault(fault.kind),
            told: false,
        });
        let mut list: Vec<Due> = faults.collect();
        let mut rates = 0;
        for event in &scenario.events {
            let what = event.what.clone().tidy();
            if !what.is_valid() {
                continue;
            }
            match event.occasion {
                Occasion::At(at) => list.push(Due {
                    at,
                    what,
                    told: true,
                }),
                Occasion::Rate { per_second, within } if per_second > 0.0 => {
                    at_random(scenario, rates, (per_second, within), &what, &mut list);
                    rates += 1;
                }
                Occasion::Rate { .. } => {}
            }
        }
        list.sort_by_key(|due| due.at);
        Agenda {
            list,
            done: 0,
            applied: Vec::new(),
        }
    }

    /// Adds an intervention after all those due at the same time or before.
    pub fn apply(&mut self, at: Time, what: Intervention) {
        self.applied.push((at, what.clone()));
        let later = self.list[self.done..].partition_point(|due| due.at <= at);
        let told = true;
        self.list.insert(self.done + later, Due { at, what, told });
    }

    /// The applied interventions, in that order.
    pub fn applied(&self) -> &[(Time, Intervention)] {
        &self.applied
    }

    /// The future events that are recorded as interventions.
    pub fn told(&self) -> impl Iterator<Item = (Time, Intervention)> {
        let told = self.list[self.done..].iter().filter(|due| due.told);
        told.map(|due| (due.at, due.what.clone()))
    }

    /// When the next one is due.
    pub fn next_time(&self) -> Time {
        self.list.get(self.done).map_or(Time::NEVER, |due| due.at)
    }

    /// Takes the next one that is due at `now` or before.
    pub fn next(&mut self, now: Time) -> Option<Due> {
        let due = self.list.get(self.done).filter(|due| due.at <= now)?;
        self.done += 1;
        Some(due.clone())
    }
}

/// Draws the times and places of the `index`-th event that comes at a rate, as a Poisson process.
fn at_random(
    scenario: &Scenario,
    index: u64,
    (per_second, within): (f64, Option<Bounds>),
    what: &Intervention,
    list: &mut Vec<Due>,
) {
    let mut random = stream(scenario.seed, Stream::Events, &[index]);
    let mut at = Time::ZERO;
    for count in 0u32.. {
        at += Duration::from_seconds_f64(random.exponential(1.0 / per_second));
        if at >= Time::ZERO + scenario.duration {
            return;
        }
        let mut what = what.clone();
        let place = within.map(|bounds| {
            Point::planar(
                random.between(bounds.low.x, bounds.high.x),
                random.between(bounds.low.y, bounds.high.y),
            )
        });
        match &mut what {
            Intervention::SetThing { name, position } => {
                name.push_str(&count.to_string());
                *position = place.unwrap_or(*position);
            }
            Intervention::SetWayPoint(way_point) => {
                way_point.name.push_str(&count.to_string());
                way_point.position = place.unwrap_or(way_point.position);
            }
            _ => {}
        }
        let told = true;
        list.push(Due { at, what, told });
    }
}
