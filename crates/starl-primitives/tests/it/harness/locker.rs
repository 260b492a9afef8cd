//! A program that requests resources, uses them for a while and releases them, repeatedly; and the
//! holders with their times, from its events.

use super::World;
use starl_core::event::{MutexEvent, PrimitiveEvent};
use starl_core::{
    Duration, Event, Primitives, Program, Random, Robot, RobotId, Time, TimerKey, timers,
};
use starl_primitives::mutex::{Algorithm, Options, Resources};
use starl_primitives::{FailureDetector, Mutex, failure_detector};
use std::any::Any;
use std::collections::{BTreeMap, BTreeSet};

/// The resources that there are.
pub const RESOURCES: [&str; 4] = ["a", "b", "c", "d"];

#[derive(Clone, Primitives)]
pub struct Locker {
    detector: Option<FailureDetector>,
    pub mutex: Mutex,
    /// Whether it asks by itself.
    is_busy: bool,
    /// When it gives back the next resource.
    next_release: Option<Time>,
    /// When it asks again.
    next_request: Time,
}

/// All algorithms.
pub const ALGORITHMS: [Algorithm; 3] = [Algorithm::Permission, Algorithm::Quorum, Algorithm::Lease];

impl Locker {
    /// Robots that ask by themselves, at random, if they are busy.
    pub fn boxed(algorithm: Algorithm, is_busy: bool) -> impl Fn() -> Box<dyn Program> {
        Locker::made(algorithm, is_busy, true)
    }

    /// Robots that request on command, with the mutex as their only primitive.
    #[allow(dead_code, reason = "the benchmarks use it")]
    pub fn bare(algorithm: Algorithm) -> impl Fn() -> Box<dyn Program> {
        Locker::made(algorithm, false, false)
    }

    fn made(
        algorithm: Algorithm,
        is_busy: bool,
        has_detector: bool,
    ) -> impl Fn() -> Box<dyn Program> {
        move || {
            let options = Options {
                algorithm,
                ..Options::default()
            };
            Box::new(Locker {
                mutex: Mutex::new("lock", None, options),
                detector: has_detector.then(watch),
                is_busy,
                next_release: None,
                next_request: Time::ZERO,
            })
        }
    }
}

/// The set of these.
pub fn set(resources: &[&str]) -> Resources {
    resources.iter().map(|&resource| resource.into()).collect()
}

/// The resources with the bits of this number.
fn numbered(bits: u32) -> Resources {
    let chosen = RESOURCES.iter().enumerate();
    let chosen = chosen.filter(|(index, _)| bits >> index & 1 == 1);
    chosen.map(|(_, &resource)| resource.into()).collect()
}

timers! {
    /// Sets are the bits of numbers.
    pub enum Command {
        Acquire(u32),
        Release(u32),
        AskOnly(u32),
    }
}

fn bits(resources: &[&str]) -> u32 {
    let bit = |resource: &&str| RESOURCES.iter().position(|name| name == resource);
    resources.iter().filter_map(bit).map(|bit| 1 << bit).sum()
}

/// Makes a robot request these.
pub fn acquire(resources: &[&str]) -> Command {
    Command::Acquire(bits(resources))
}

/// Makes a robot release these.
pub fn release(resources: &[&str]) -> Command {
    Command::Release(bits(resources))
}

/// Sets a robot's participants from its next request on.
pub fn ask_only(robots: &[u32]) -> Command {
    Command::AskOnly(robots.iter().map(|robot| 1 << robot).sum())
}

fn pause(random: &mut Random) -> Duration {
    Duration::from_millis(u64::from(random.below(1500)))
}

fn watch() -> FailureDetector {
    FailureDetector::new("watch", failure_detector::Options::default())
}

impl Program for Locker {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        if !self.is_busy {
            return;
        }
        let now = robot.now();
        if !self.mutex.held().is_empty() {
            let due = *self
                .next_release
                .get_or_insert_with(|| now + pause(robot.random()));
            if now >= due {
                let count = self.mutex.held().len() as u32;
                let first = robot.random().below(count) as usize;
                let some = self.mutex.held().iter().skip(first).cloned().collect();
                self.mutex.release(robot, &some);
                self.next_release = None;
                self.next_request = now + pause(robot.random());
            }
        } else if !self.mutex.is_waiting() && now >= self.next_request {
            self.next_release = None;
            let wanted = numbered(1 + robot.random().below(15));
            self.mutex.acquire(robot, wanted).expect("it holds nothing");
        }
    }

    fn timer(&mut self, robot: &mut Robot<'_>, key: TimerKey) {
        match key.read().expect("a command") {
            Command::Acquire(bits) => {
                let acquired = self.mutex.acquire(robot, numbered(bits));
                acquired.expect("it holds nothing");
            }
            Command::Release(bits) => self.mutex.release(robot, &numbered(bits)),
            Command::AskOnly(bits) => {
                let robots = (0..32).filter(|robot| bits >> robot & 1 == 1);
                let participants = robots.map(RobotId).collect();
                self.mutex.set_participants(Some(participants));
            }
        }
    }

    fn corrupt(&mut self, random: &mut Random) {
        self.mutex.corrupt(random, &set(&RESOURCES));
    }

    fn inspect(&self) -> Option<&dyn Any> {
        Some(self)
    }
}

/// Robots asked by an entry besides oneself, on average: for quorums the robot's row and column in a grid.
pub fn asked(algorithm: Algorithm, count: usize) -> f64 {
    if algorithm != Algorithm::Quorum {
        return (count - 1) as f64;
    }
    let root = (count as f64).sqrt().ceil() as usize;
    let columns = if count < 4 { root } else { root.min(count / 2) };
    let heights = (0..columns).map(|column| (count - column).div_ceil(columns));
    let sizes = heights.map(|height| height * (height + columns - 2));
    sizes.sum::<usize>() as f64 / count as f64
}

/// All robots request random sets whenever they hold none, and hold them for 150 ms. Returns the number of entries of
/// each robot.
pub fn contend(world: &mut World, span: Duration) -> Vec<usize> {
    const STEP: Duration = Duration::from_millis(50);
    let robots = world.size();
    let mut random = Random::keyed(7, &[world.now.0]);
    let (mut held, mut entries) = (vec![0; robots], vec![0; robots]);
    let end = world.now + span;
    while world.now < end {
        for robot in 0..robots {
            if mutex(world, robot).crit() {
                entries[robot] += usize::from(held[robot] == 0);
                held[robot] += 1;
                if held[robot] > 3 {
                    world.command(robot, release(&RESOURCES));
                }
            } else {
                held[robot] = 0;
                if !mutex(world, robot).is_waiting() {
                    world.command(robot, Command::Acquire(1 + random.below(15)));
                }
            }
        }
        world.run_for(STEP);
    }
    entries
}

/// The mutex of a robot that is up.
pub fn mutex(world: &World, robot: usize) -> &Mutex {
    &world.inspect::<Locker>(robot).mutex
}

/// Judges a run by its events: at no time two robots hold the same resource, and the numbers of successive
/// holders grow if they have any. Crashes leave no event, so they are given. Returns how many requests of
/// each robot were granted.
pub fn entries(world: &World, crashes: &[(Time, u32)]) -> BTreeMap<u32, usize> {
    let mut holders: BTreeMap<String, u32> = BTreeMap::new();
    let mut numbers: BTreeMap<String, u64> = BTreeMap::new();
    let mut entries: BTreeMap<u32, BTreeSet<Time>> = BTreeMap::new();
    let mut crashes = crashes.iter().copied().peekable();
    for (at, RobotId(robot), event) in &world.records {
        while let Some((_, crashed)) = crashes.next_if(|(time, _)| time < at) {
            holders.retain(|_, holder| *holder != crashed);
        }
        let Event::Primitive {
            event: PrimitiveEvent::Mutex(event),
            ..
        } = event
        else {
            continue;
        };
        match event {
            MutexEvent::Enter {
                resource, fencing, ..
            } => {
                let before = holders.insert(resource.to_string(), *robot);
                assert_eq!(before, None, "{robot} enters {resource} at {at:?}");
                if let Some(number) = fencing {
                    let before = numbers.insert(resource.to_string(), *number);
                    assert!(
                        before < Some(*number),
                        "{robot} enters {resource} with {number} after {before:?}"
                    );
                }
                entries.entry(*robot).or_default().insert(*at);
            }
            MutexEvent::Release { resource } | MutexEvent::Expire { resource } => {
                let before = holders.remove(&**resource);
                assert_eq!(
                    before,
                    Some(*robot),
                    "{robot} releases {resource} at {at:?}"
                );
            }
            MutexEvent::Acquire { .. } | MutexEvent::Withdraw { .. } | MutexEvent::Ready { .. } => {
            }
        }
    }
    let counted = entries
        .into_iter()
        .map(|(robot, times)| (robot, times.len()));
    counted.collect()
}

/// Judges only the numbers of a run by its events: no resource is entered with the same number twice. Returns
/// how often two robots held one resource at once.
pub fn numbers(world: &World) -> usize {
    let mut numbers: BTreeSet<(String, u64)> = BTreeSet::new();
    let mut holders: BTreeMap<String, BTreeSet<u32>> = BTreeMap::new();
    let mut at_once = 0;
    for (at, RobotId(robot), event) in &world.records {
        let Event::Primitive {
            event: PrimitiveEvent::Mutex(event),
            ..
        } = event
        else {
            continue;
        };
        let (resource, number) = match event {
            MutexEvent::Enter {
                resource, fencing, ..
            } => (resource, *fencing),
            MutexEvent::Acquire { resource }
            | MutexEvent::Withdraw { resource }
            | MutexEvent::Release { resource }
            | MutexEvent::Expire { resource } => (resource, None),
            MutexEvent::Ready { .. } => continue,
        };
        let holders = holders.entry(resource.to_string()).or_default();
        if let Some(number) = number {
            let is_new = numbers.insert((resource.to_string(), number));
            assert!(
                is_new,
                "{robot} enters {resource} with {number} at {at:?}, as one before"
            );
            holders.insert(*robot);
            at_once += usize::from(holders.len() > 1);
        } else {
            holders.remove(robot);
        }
    }
    at_once
}
