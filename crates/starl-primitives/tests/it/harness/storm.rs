//! Long lives under load: every robot broadcasts all the time, robots restart again and again, and datagrams
//! are lost, repeated, and held back for long.

use super::late::LateCopies;
use super::teller::{Id, Step, Teller, runs, tell};
use super::{Wire, World};
use starl_core::{Duration, Random, Time};
use starl_primitives::broadcast::Order;
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};

/// Which robots crash.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Victims {
    /// Always this one.
    One(usize),
    /// Any, drawn at random.
    Any,
    /// All, one after the other.
    InTurn,
}

/// The faults of a fleet.
#[derive(Clone, Debug)]
pub struct Storm {
    pub robots: usize,
    pub seed: u64,
    pub span: Duration,
    pub wire: Wire,
    /// The share of datagrams that arrive late, and how late at most.
    pub late: (f64, Duration),
    /// How often each robot broadcasts.
    pub period: Duration,
    pub victims: Victims,
    /// The time between crashes, about, and until the crashed robot starts again.
    pub crash_period: Duration,
    pub downtime: Duration,
}

/// The result.
pub struct Aftermath {
    pub world: World,
    pub runs: Vec<(u32, Vec<(usize, Step)>)>,
    pub restarts: usize,
}

/// The time step.
const STEP: Duration = Duration::from_millis(10);

impl Storm {
    /// Runs it, and a calm of 20 s in which robots broadcast on and none crashes.
    pub fn run(&self) -> Aftermath {
        let make = Teller::boxed(Order::Total, 0, 0.0);
        let mut world = World::new(self.robots, self.seed, self.wire.clone(), None, make);
        let mut late = LateCopies::new(self.late.0, self.late.1, self.seed);
        let mut random = Random::keyed(self.seed, &[78]);
        let mut starts = Vec::new();
        let mut down: BTreeMap<usize, Time> = BTreeMap::new();
        let mut next: Vec<Time> = (0..self.robots)
            .map(|_| world.now + self.spread(self.period, &mut random))
            .collect();
        let storm_end = world.now + self.span;
        let end = storm_end + Duration::from_seconds(20);
        let mut next_crash = world.now + self.spread(self.crash_period, &mut random);
        let mut count = 0;
        while world.now < end {
            world.run_for(STEP);
            late.step(&mut world);
            let is_back = |at: &Time| *at <= world.now || world.now >= storm_end;
            let back: Vec<usize> = down
                .iter()
                .filter(|(_, at)| is_back(at))
                .map(|b| *b.0)
                .collect();
            for robot in back {
                down.remove(&robot);
                starts.push((world.now, robot as u32));
                world.start(robot);
            }
            for (robot, next) in next.iter_mut().enumerate() {
                if *next <= world.now && !down.contains_key(&robot) {
                    *next = world.now + self.spread(self.period, &mut random);
                    world.command(robot, tell(count as u32));
                }
            }
            if next_crash <= world.now && world.now < storm_end {
                next_crash = world.now + self.spread(self.crash_period, &mut random);
                let robot = match self.victims {
                    Victims::One(robot) => robot,
                    Victims::Any => random.below(self.robots as u32) as usize,
                    Victims::InTurn => count % self.robots,
                };
                count += 1;
                if let Entry::Vacant(place) = down.entry(robot) {
                    place.insert(world.now + self.downtime);
                    world.crash(robot);
                }
            }
        }
        let runs = runs(&world, &starts);
        Aftermath {
            world,
            runs,
            restarts: starts.len(),
        }
    }

    fn spread(&self, about: Duration, random: &mut Random) -> Duration {
        Duration::from_seconds_f64(about.seconds() * random.between(0.5, 1.5))
    }
}

impl Aftermath {
    /// The violation of the order, in time that grows with the number of deliveries, not with its
    /// square.
    pub fn violation(&self) -> Option<String> {
        let mut next: BTreeMap<Id, BTreeSet<Id>> = BTreeMap::new();
        let mut successor: BTreeMap<Id, Id> = BTreeMap::new();
        let mut sent = BTreeSet::new();
        for (_, steps) in &self.runs {
            sent.extend(steps.iter().filter_map(|(_, step)| match step {
                Step::Sent(id) => Some(*id),
                _ => None,
            }));
        }
        for (robot, steps) in &self.runs {
            let mut handed: BTreeSet<Id> = BTreeSet::new();
            let mut numbers: BTreeMap<(u32, u32), u32> = BTreeMap::new();
            let (mut last, mut is_gap) = (None, false);
            for (_, step) in steps {
                match step {
                    Step::Handed(id) => {
                        if !handed.insert(*id) {
                            return Some(format!("robot {robot} delivered {id:?} twice"));
                        }
                        if !sent.contains(id) {
                            return Some(format!("{id:?} was never sent"));
                        }
                        if numbers.insert((id.0, id.1), id.2) > Some(id.2) {
                            return Some(format!("{id:?} came late at robot {robot}"));
                        }
                        next.entry(*id).or_default();
                        if let Some(last) = last.replace(*id) {
                            next.entry(last).or_default().insert(*id);
                            if !is_gap && *successor.entry(last).or_insert(*id) != *id {
                                return Some(format!("robot {robot} has a gap after {last:?}"));
                            }
                        }
                        is_gap = false;
                    }
                    Step::Gap => is_gap = true,
                    _ => {}
                }
            }
        }
        has_cycle(&next).then(|| "there is no order that all were handed".into())
    }

    /// The number of messages delivered to all robots that were up from then on.
    pub fn handed_to_all(&self, since: Time) -> usize {
        let mut count: BTreeMap<Id, usize> = BTreeMap::new();
        let mut fresh = BTreeSet::new();
        for (_, steps) in &self.runs {
            for (place, step) in steps {
                match step {
                    Step::Sent(id) if self.world.records[*place].0 >= since => {
                        fresh.insert(*id);
                    }
                    Step::Handed(id) => *count.entry(*id).or_default() += 1,
                    _ => {}
                }
            }
        }
        let robots = self.world.size();
        fresh
            .iter()
            .filter(|id| count.get(id) == Some(&robots))
            .count()
    }
}

/// Whether there is a way along arrows back to where it begins (Kahn 1962).
fn has_cycle(next: &BTreeMap<Id, BTreeSet<Id>>) -> bool {
    let mut waiting: BTreeMap<Id, usize> = next.keys().map(|id| (*id, 0)).collect();
    for id in next.values().flatten() {
        *waiting.entry(*id).or_default() += 1;
    }
    let free = waiting.iter().filter(|(_, count)| **count == 0);
    let mut free: Vec<Id> = free.map(|(id, _)| *id).collect();
    let mut left = waiting.len();
    while let Some(id) = free.pop() {
        left -= 1;
        for after in &next[&id] {
            let count = waiting.get_mut(after).expect("all are known");
            *count -= 1;
            if *count == 0 {
                free.push(*after);
            }
        }
    }
    left > 0
}
