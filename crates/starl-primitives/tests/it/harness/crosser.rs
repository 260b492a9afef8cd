//! A program that arrives at a barrier, on command or by itself repeatedly; and the passes of all robots
//! with their times, from its events.

use super::World;
use starl_core::event::{BarrierEvent, PrimitiveEvent};
use starl_core::{
    Duration, Event, Primitives, Program, Random, Robot, RobotId, Time, TimerKey, timers,
};
use starl_primitives::barrier::Options;
use starl_primitives::{Barrier, FailureDetector, failure_detector};
use std::any::Any;
use std::collections::{BTreeMap, BTreeSet};

#[derive(Clone, Primitives)]
pub struct Crosser {
    detector: Option<FailureDetector>,
    pub barrier: Barrier,
    /// Whether it comes by itself, and with which pauses at most, milliseconds.
    pause_ms: Option<u32>,
    next_arrival: Option<Time>,
    pub crossings: u32,
}

impl Crosser {
    pub fn boxed(
        participants: Option<&[u32]>,
        pause_ms: Option<u32>,
    ) -> impl Fn() -> Box<dyn Program> + use<> {
        let participants =
            participants.map(|robots| robots.iter().map(|&id| RobotId(id)).collect());
        Crosser::made(participants, pause_ms, true)
    }

    /// Robots that arrive on command, with the barrier as their only primitive.
    #[allow(dead_code, reason = "the benchmarks use it")]
    pub fn bare() -> impl Fn() -> Box<dyn Program> {
        Crosser::made(None, None, false)
    }

    fn made(
        participants: Option<BTreeSet<RobotId>>,
        pause_ms: Option<u32>,
        has_detector: bool,
    ) -> impl Fn() -> Box<dyn Program> {
        move || {
            Box::new(Crosser {
                barrier: Barrier::new("gate", participants.clone(), Options::default()),
                detector: has_detector.then(watch),
                pause_ms,
                next_arrival: Some(Time::ZERO),
                crossings: 0,
            })
        }
    }
}

timers! {
    pub enum Command {
        Arrive,
    }
}

/// Makes a robot arrive at the barrier.
pub fn arrive() -> Command {
    Command::Arrive
}

fn watch() -> FailureDetector {
    FailureDetector::new("watch", failure_detector::Options::default())
}

impl Program for Crosser {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        let Some(pause) = self.pause_ms else { return };
        match self.next_arrival {
            Some(at) if robot.now() >= at => {
                self.next_arrival = None;
                self.barrier.arrive(robot);
            }
            None if self.barrier.passed() => {
                self.crossings += 1;
                let pause = Duration::from_millis(u64::from(robot.random().below(pause)));
                self.next_arrival = Some(robot.now() + pause);
            }
            _ => {}
        }
    }

    fn timer(&mut self, robot: &mut Robot<'_>, key: TimerKey) {
        assert_eq!(key.read(), Some(Command::Arrive));
        self.barrier.arrive(robot);
    }

    fn corrupt(&mut self, random: &mut Random) {
        self.barrier.corrupt(random);
    }

    fn inspect(&self) -> Option<&dyn Any> {
        Some(self)
    }
}

/// The program of a robot that is up.
pub fn crosser(world: &World, robot: usize) -> &Crosser {
    world.inspect(robot)
}

/// The barrier of a robot that is up.
pub fn barrier(world: &World, robot: usize) -> &Barrier {
    &crosser(world, robot).barrier
}

/// Judges a run by its events: no robot passes a generation before all have arrived at it or a later
/// one, and the generations that a robot passes in one life rise. Crashes are given with the number of
/// records before each; when all have crashed generations start again. Returns how often each robot
/// passed.
pub fn crossings(world: &World, crashes: &[(usize, u32)]) -> BTreeMap<u32, u32> {
    let mut come: BTreeMap<RobotId, u64> = BTreeMap::new();
    // Robots that have come and do not know yet to which generation.
    let mut unsure: BTreeSet<RobotId> = BTreeSet::new();
    let mut passed: BTreeMap<RobotId, u64> = BTreeMap::new();
    let mut counts: BTreeMap<u32, u32> = BTreeMap::new();
    let mut crashes = crashes.iter().copied().peekable();
    // Those that have not crashed since they last came.
    let mut rememberers: BTreeSet<RobotId> = BTreeSet::new();
    for (index, (at, robot, event)) in world.records.iter().enumerate() {
        while let Some((_, crashed)) = crashes.next_if(|(before, _)| *before <= index) {
            passed.remove(&RobotId(crashed));
            rememberers.remove(&RobotId(crashed));
            if rememberers.is_empty() {
                come.clear();
            }
        }
        let Event::Primitive {
            event: PrimitiveEvent::Barrier(event),
            ..
        } = event
        else {
            continue;
        };
        match event {
            BarrierEvent::Arrive { .. } => {
                unsure.insert(*robot);
                rememberers.insert(*robot);
            }
            BarrierEvent::Wait { generation } => {
                unsure.remove(robot);
                let known = come.entry(*robot).or_default();
                *known = (*known).max(*generation);
            }
            BarrierEvent::Pass {
                generation,
                participants,
            } => {
                for peer in participants {
                    let has_come = come.get(peer) >= Some(generation) || unsure.contains(peer);
                    assert!(
                        has_come,
                        "{robot} passes {generation} at {at:?} before {peer} came"
                    );
                }
                let before = passed.insert(*robot, *generation);
                assert!(
                    before < Some(*generation),
                    "{robot} passes {generation} again"
                );
                *counts.entry(robot.0).or_default() += 1;
            }
        }
    }
    counts
}
