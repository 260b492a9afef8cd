//! A program that elects on command of a test; and the leaders with their times, from its events.

use super::World;
use starl_core::event::{ElectionEvent, PrimitiveEvent};
use starl_core::{Event, Primitives, Program, Random, Robot, RobotId, TimerKey, timers};
use starl_primitives::election::{Algorithm, Options};
use starl_primitives::{FailureDetector, LeaderElection, failure_detector};
use std::any::Any;
use std::collections::{BTreeMap, BTreeSet};

#[derive(Clone, Primitives)]
pub struct Elector {
    detector: Option<FailureDetector>,
    pub election: LeaderElection,
    /// Whether it stands as soon as it starts.
    is_eager: bool,
}

impl Elector {
    /// Robots that stand as soon as they start, and that have a failure detector.
    pub fn eager(options: Options) -> impl Fn() -> Box<dyn Program> {
        Elector::boxed(options, None, true, true)
    }

    pub fn boxed(
        options: Options,
        participants: Option<BTreeSet<RobotId>>,
        is_eager: bool,
        has_detector: bool,
    ) -> impl Fn() -> Box<dyn Program> {
        move || {
            Box::new(Elector {
                election: LeaderElection::new("election", participants.clone(), options),
                detector: has_detector.then(watch),
                is_eager,
            })
        }
    }
}

/// Default settings with this algorithm.
pub fn by(algorithm: Algorithm) -> Options {
    Options {
        algorithm,
        ..Options::default()
    }
}

/// All algorithms.
pub const ALGORITHMS: [Algorithm; 3] = [Algorithm::Leases, Algorithm::Ballots, Algorithm::Bully];

timers! {
    pub enum Command {
        Elect,
        Resign,
    }
}

/// Makes a robot a candidate.
pub const ELECT: Command = Command::Elect;

/// Makes a robot resign.
pub const RESIGN: Command = Command::Resign;

fn watch() -> FailureDetector {
    FailureDetector::new("watch", failure_detector::Options::default())
}

impl Program for Elector {
    fn start(&mut self, robot: &mut Robot<'_>) {
        if self.is_eager {
            self.election.elect(robot);
        }
    }

    fn activate(&mut self, _: &mut Robot<'_>) {}

    fn timer(&mut self, robot: &mut Robot<'_>, key: TimerKey) {
        match key.read().expect("a command") {
            Command::Elect => self.election.elect(robot),
            Command::Resign => self.election.resign(robot),
        }
    }

    fn corrupt(&mut self, random: &mut Random) {
        self.election.corrupt(random);
    }

    fn inspect(&self) -> Option<&dyn Any> {
        Some(self)
    }
}

/// The election of a robot that is up.
pub fn election(world: &World, robot: usize) -> &LeaderElection {
    &world.inspect::<Elector>(robot).election
}

/// The leader that these robots show.
pub fn leaders(world: &World, robots: &[usize]) -> Vec<Option<u32>> {
    let shown = robots.iter().map(|&robot| election(world, robot).leader());
    shown.map(|leader| leader.map(|leader| leader.0)).collect()
}

/// The leader on which these robots agree.
pub fn agreed(world: &World, robots: &[usize]) -> Option<u32> {
    let leaders = leaders(world, robots);
    let first = *leaders.first()?;
    leaders
        .iter()
        .all(|&leader| leader == first)
        .then_some(first?)
}

/// Judges a run with leases by its events: each epoch has one leader, epochs grow from leader to leader, no two robots
/// lead at once, and a leader has called for an election. Crashes leave no event, so they are given by the number of
/// events before. Returns the epochs with a leader, with the leaders, in the order of time.
pub fn judge(world: &World, crashes: &[(usize, u32)]) -> Vec<(u64, u32)> {
    let mut crashes = crashes.iter().copied().peekable();
    let mut leads: BTreeMap<u32, u64> = BTreeMap::new();
    let mut called: BTreeSet<u32> = BTreeSet::new();
    let mut names: BTreeMap<u64, u32> = BTreeMap::new();
    let mut history: Vec<(u64, u32)> = Vec::new();
    for (index, (at, RobotId(me), event)) in world.records.iter().enumerate() {
        while let Some((_, crashed)) = crashes.next_if(|&(before, _)| before <= index) {
            leads.remove(&crashed);
            called.remove(&crashed);
        }
        let Event::Primitive {
            event: PrimitiveEvent::Election(event),
            ..
        } = event
        else {
            continue;
        };
        match event {
            ElectionEvent::Elect => _ = called.insert(*me),
            ElectionEvent::Resign => _ = called.remove(me),
            ElectionEvent::Lost => _ = leads.remove(me),
            ElectionEvent::Leader {
                leader: RobotId(leader),
                epoch,
                ..
            } => {
                let (leader, epoch) = (*leader, epoch.expect("leases have epochs"));
                let named = *names.entry(epoch).or_insert(leader);
                assert_eq!(named, leader, "{epoch} has two leaders at {at:?}");
                leads.remove(me);
                if leader != *me {
                    continue;
                }
                assert!(called.contains(me), "{me} leads uncalled at {at:?}");
                assert!(leads.is_empty(), "{me} and {leads:?} lead at {at:?}");
                if let Some((last, _)) = history.last() {
                    assert!(epoch > *last, "epoch {epoch} after {last} at {at:?}");
                }
                leads.insert(*me, epoch);
                history.push((epoch, *me));
            }
            _ => {}
        }
    }
    history
}
