//! A program that elects as a test tells it to; and what its events say of who led when.

use super::{World, int, robot};
use starl_core::event::Value;
use starl_core::{Event, Primitive, Program, Random, Robot, RobotId, TimerKey, timers};
use starl_primitives::election::{Algorithm, Options};
use starl_primitives::{FailureDetector, LeaderElection, failure_detector};
use std::any::Any;
use std::collections::{BTreeMap, BTreeSet};

#[derive(Clone)]
pub struct Elector {
    pub election: LeaderElection,
    detector: FailureDetector,
    has_detector: bool,
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
                detector: FailureDetector::new("watch", failure_detector::Options::default()),
                has_detector,
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

/// Tells a robot to stand for election.
pub const ELECT: Command = Command::Elect;

/// Tells a robot to resign.
pub const RESIGN: Command = Command::Resign;

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

    fn primitives(&mut self, visit: &mut dyn FnMut(&mut dyn Primitive)) {
        if self.has_detector {
            visit(&mut self.detector);
        }
        visit(&mut self.election);
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

/// Whom these robots show as leader.
pub fn leaders(world: &World, robots: &[usize]) -> Vec<Option<u32>> {
    let shown = robots.iter().map(|&robot| election(world, robot).leader());
    shown.map(|leader| leader.map(|leader| leader.0)).collect()
}

/// The leader on whom these robots agree.
pub fn agreed(world: &World, robots: &[usize]) -> Option<u32> {
    let leaders = leaders(world, robots);
    let first = *leaders.first()?;
    leaders
        .iter()
        .all(|&leader| leader == first)
        .then_some(first?)
}

/// Judges a run by its events, as long as it is about leases: each epoch has one leader, epochs grow from
/// leader to leader, no two robots lead at once, and who leads has called for an election. Crashes are given,
/// since they leave no event, by the number of events before. Gives the epochs in which someone led, with the leaders, in the order of time.
pub fn judge(world: &World, crashes: &[(usize, u32)]) -> Vec<(i64, u32)> {
    let mut crashes = crashes.iter().copied().peekable();
    let mut leads: BTreeMap<u32, i64> = BTreeMap::new();
    let mut called: BTreeSet<u32> = BTreeSet::new();
    let mut names: BTreeMap<i64, u32> = BTreeMap::new();
    let mut history: Vec<(i64, u32)> = Vec::new();
    for (index, (at, RobotId(me), event)) in world.records.iter().enumerate() {
        while let Some((_, crashed)) = crashes.next_if(|&(before, _)| before <= index) {
            leads.remove(&crashed);
            called.remove(&crashed);
        }
        let Event::Primitive {
            primitive,
            name,
            fields,
            ..
        } = event
        else {
            continue;
        };
        if primitive != "election" {
            continue;
        }
        let field = |wanted: &str| -> &Value {
            let found = fields.iter().find(|(name, _)| name == wanted);
            &found.unwrap_or_else(|| panic!("{name} has no {wanted}")).1
        };
        match &**name {
            "elect" => _ = called.insert(*me),
            "resign" => _ = called.remove(me),
            "lost" => _ = leads.remove(me),
            "leader" => {
                let (leader, epoch) = (robot(field("leader")), int(field("epoch")));
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
