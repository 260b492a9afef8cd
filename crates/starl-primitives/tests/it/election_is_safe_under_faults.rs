//! With leases no epoch has two leaders, epochs grow, and no two robots lead at once, while datagrams are lost,
//! doubled and reordered, the network falls apart, robots crash and restart without memory, resign and stand
//! again, and clocks drift; and once that is over all agree.

use crate::harness::elector::{ELECT, Elector, RESIGN, agreed, by, election, judge};
use crate::harness::{Wire, World};
use starl_core::event::{ElectionEvent, PrimitiveEvent};
use starl_core::{Duration, Event, Random};
use starl_primitives::election::Algorithm;

const SECOND: Duration = Duration::from_seconds(1);

/// A fleet that faults happen to.
struct Troubled {
    world: World,
    random: Random,
    count: u32,
    /// The number of events before each crash, and the robot.
    crashes: Vec<(usize, u32)>,
    down: Vec<u32>,
    /// Whether a majority may forget at once.
    may_forget: bool,
}

impl Troubled {
    fn new(count: u32, seed: u64, may_forget: bool) -> Troubled {
        let make = Elector::eager(by(Algorithm::Leases));
        let mut world = World::new(count as usize, seed, Wire::bad(), None, make);
        let mut random = Random::keyed(seed, &[8]);
        for robot in 0..count {
            let drift = random.between(-0.01, 0.01);
            world.set_clock_drift(robot as usize, drift);
            if !may_forget {
                let ahead = i64::from(random.below(3600)) * 1_000_000_000;
                world.set_clock_ahead(robot as usize, ahead);
            }
        }
        Troubled {
            world,
            random,
            count,
            crashes: Vec::new(),
            down: Vec::new(),
            may_forget,
        }
    }

    /// How many robots that have crashed do not vote again yet.
    fn forgetful(&self) -> usize {
        let has_forgotten = |robot: &u32| {
            let crashed = self.crashes.iter().rfind(|(_, crashed)| crashed == robot);
            crashed.is_some_and(|&(crash, _)| {
                let votes = |event: &Event| {
                    let Event::Primitive { event, .. } = event else {
                        return false;
                    };
                    matches!(event, PrimitiveEvent::Election(ElectionEvent::Vote { .. }))
                };
                let mut since = self.world.records[crash..].iter();
                !since.any(|(_, who, event)| who.0 == *robot && votes(event))
            })
        };
        (0..self.count).filter(has_forgotten).count()
    }

    fn happen(&mut self) {
        let robot = self.random.below(self.count);
        match self.random.below(8) {
            0 | 1 => {
                let majority = self.count as usize / 2 + 1;
                let is_down = self.down.contains(&robot);
                if !is_down && (self.may_forget || self.forgetful() + 1 < majority) {
                    self.world.crash(robot as usize);
                    self.crashes.push((self.world.records.len(), robot));
                    self.down.push(robot);
                }
            }
            2..=4 => {
                if let Some(robot) = self.down.pop() {
                    self.world.start(robot as usize);
                }
            }
            5 => {
                let side: Vec<bool> = (0..self.count).map(|_| self.random.chance(0.5)).collect();
                for from in 0..self.count {
                    for to in 0..self.count {
                        if side[from as usize] != side[to as usize] {
                            self.world.wire.cut.insert((from, to));
                        }
                    }
                }
            }
            6 => self.world.wire.cut.clear(),
            _ => {
                self.world.command(robot as usize, RESIGN);
                self.world.command(robot as usize, ELECT);
            }
        }
    }

    fn run(mut self, happenings: u32, seed: u64) -> usize {
        for _ in 0..happenings {
            let pause = Duration::from_millis(u64::from(self.random.below(6000)));
            self.world.run_for(pause);
            self.happen();
        }
        self.world.wire.cut.clear();
        while let Some(robot) = self.down.pop() {
            self.world.start(robot as usize);
        }
        self.world.run_for(SECOND * 30);
        let all: Vec<usize> = (0..self.count as usize).collect();
        let mut patience = 20;
        while agreed(&self.world, &all).is_none() {
            self.world.run_for(SECOND);
            patience -= 1;
            assert!(patience > 0, "seed {seed}: no agreement");
        }
        assert!(
            all.iter()
                .all(|&robot| !election(&self.world, robot).failed())
        );
        judge(&self.world, &self.crashes).len()
    }
}

#[test]
fn with_any_crashes_if_no_majority_forgets_at_once_and_clocks_are_hours_apart() {
    let mut led = 0;
    for seed in 0..600 {
        let count = 3 + seed as u32 % 3;
        led += Troubled::new(count, seed, false).run(30, seed);
    }
    assert!(led > 600 * 5, "{led}");
}

#[test]
fn with_any_crashes_if_clocks_are_close() {
    let mut led = 0;
    for seed in 0..600 {
        let count = 1 + seed as u32 % 5;
        led += Troubled::new(count, seed, true).run(30, seed);
    }
    assert!(led > 600 * 4, "{led}");
}
