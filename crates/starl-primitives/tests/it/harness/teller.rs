//! A program that broadcasts in some order, by itself and on command; and judges of the deliveries in its
//! events.

use super::World;
use starl_core::event::messaging::MessageNumber;
use starl_core::event::{BroadcastEvent, PrimitiveEvent, TransferEvent};
use starl_core::{
    Duration, Event, Message, Primitives, Program, Random, Robot, RobotId, Time, TimerKey, message,
    timers,
};
use starl_primitives::broadcast::Order;
use starl_primitives::reliable::Options;
use starl_primitives::{Broadcast, FailureDetector, failure_detector};
use std::any::Any;
use std::collections::{BTreeMap, BTreeSet};

#[derive(Clone, Primitives)]
pub struct Teller {
    detector: FailureDetector,
    pub broadcast: Broadcast,
    /// Messages of its own that it sends, and how likely in each activation.
    left: u32,
    likelihood: f64,
}

impl Teller {
    /// Robots that send this number of messages after each start, with this probability in each activation.
    pub fn boxed(order: Order, count: u32, likelihood: f64) -> impl Fn() -> Box<dyn Program> {
        move || {
            Box::new(Teller {
                broadcast: Broadcast::in_order("news", order, Options::default()),
                detector: FailureDetector::new("watch", failure_detector::Options::default()),
                left: count,
                likelihood,
            })
        }
    }
}

timers! {
    pub enum Command {
        Tell(u32),
    }
}

/// Tells a robot to broadcast a number.
pub fn tell(value: u32) -> Command {
    Command::Tell(value)
}

impl Program for Teller {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        if self.left > 0 && robot.random().chance(self.likelihood) {
            self.left -= 1;
            self.broadcast.broadcast(robot, &self.left);
        }
    }

    fn receive(&mut self, robot: &mut Robot<'_>, message: &Message) {
        // Tests garble what travels.
        let value: u32 = message::decode(&message.payload).unwrap_or(u32::MAX);
        robot.emit(
            "got",
            [("from", message.from.into()), ("value", value.into())],
        );
    }

    fn timer(&mut self, robot: &mut Robot<'_>, key: TimerKey) {
        let Command::Tell(value) = key.read().expect("a command");
        self.broadcast.broadcast(robot, &value);
    }

    fn corrupt(&mut self, random: &mut Random) {
        self.broadcast.corrupt(random);
    }

    fn inspect(&self) -> Option<&dyn Any> {
        Some(self)
    }
}

/// The broadcast of a robot that is up.
pub fn teller(world: &World, robot: usize) -> &Broadcast {
    &world.inspect::<Teller>(robot).broadcast
}

/// A message: its sender, the sender's incarnation, its number.
pub type Id = (u32, u32, u32);

/// A step of a robot from one start to the next.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    Sent(Id),
    Handed(Id),
    /// All up to this one, of the same sender and incarnation, are passed over.
    Passed(Id),
    /// Any may be missing here.
    Gap,
}

/// All runs of all robots, as steps in the order of time with their places in the records. `starts` are
/// when robots started again.
pub fn runs(world: &World, starts: &[(Time, u32)]) -> Vec<(u32, Vec<(usize, Step)>)> {
    let mut present: BTreeMap<u32, usize> = BTreeMap::new();
    let mut runs: Vec<(u32, Vec<(usize, Step)>)> = Vec::new();
    let mut starts = starts.iter().copied().peekable();
    for (place, (at, RobotId(number), event)) in world.records.iter().enumerate() {
        while let Some((_, started)) = starts.next_if(|(time, _)| time <= at) {
            present.remove(&started);
        }
        let Event::Primitive {
            event: PrimitiveEvent::Broadcast(event),
            ..
        } = event
        else {
            continue;
        };
        let id = |from: u32, message: &MessageNumber| (from, message.incarnation, message.number);
        let step = match event {
            BroadcastEvent::Broadcast { message, .. } => Step::Sent(id(*number, message)),
            BroadcastEvent::Transfer(TransferEvent::Deliver { from, message }) => {
                Step::Handed(id(from.0, message))
            }
            BroadcastEvent::PassOver { from, message } => Step::Passed(id(from.0, message)),
            BroadcastEvent::Gap => Step::Gap,
            _ => continue,
        };
        let run = *present.entry(*number).or_insert_with(|| {
            runs.push((*number, Vec::new()));
            runs.len() - 1
        });
        runs[run].1.push((place, step));
    }
    runs
}

fn handed(steps: &[(usize, Step)]) -> Vec<Id> {
    let handed = steps.iter().filter_map(|(_, step)| match step {
        Step::Handed(id) => Some(*id),
        _ => None,
    });
    handed.collect()
}

/// The deliveries of each run, after a check that nothing was delivered twice or invented.
pub fn sequences(runs: &[(u32, Vec<(usize, Step)>)], seed: u64) -> Vec<(u32, Vec<Id>)> {
    let steps = runs.iter().flat_map(|(_, steps)| steps);
    let sent: BTreeSet<Id> = steps
        .filter_map(|(_, step)| match step {
            Step::Sent(id) => Some(*id),
            _ => None,
        })
        .collect();
    let mut all = Vec::new();
    for (robot, steps) in runs {
        let handed = handed(steps);
        let distinct: BTreeSet<Id> = handed.iter().copied().collect();
        assert_eq!(
            distinct.len(),
            handed.len(),
            "seed {seed}: twice at {robot}"
        );
        assert!(distinct.is_subset(&sent), "seed {seed}: made up");
        all.push((*robot, handed));
    }
    all
}

/// Whether each sender's messages are delivered in the order of sending, and the messages of its lives do not
/// alternate.
pub fn is_fifo(sequence: &[Id]) -> bool {
    let mut last: BTreeMap<u32, (u32, u32)> = BTreeMap::new();
    let mut over: BTreeSet<(u32, u32)> = BTreeSet::new();
    sequence.iter().all(|&(from, incarnation, number)| {
        match last.insert(from, (incarnation, number)) {
            Some((life, before)) if life == incarnation => return before < number,
            Some((life, _)) => drop(over.insert((from, life))),
            None => {}
        }
        !over.contains(&(from, incarnation))
    })
}

/// Two messages of which one was delivered before one that precedes it, if any. Messages of a robot's earlier life
/// must not be delivered after one of a later life.
pub fn causal_violation(runs: &[(u32, Vec<(usize, Step)>)]) -> Option<String> {
    let mut steps: Vec<(usize, usize, &Step)> = Vec::new();
    for (run, (_, of_run)) in runs.iter().enumerate() {
        steps.extend(of_run.iter().map(|(place, step)| (*place, run, step)));
    }
    steps.sort_by_key(|step| step.0);
    let mut past: BTreeMap<Id, BTreeSet<Id>> = BTreeMap::new();
    let mut known: Vec<BTreeSet<Id>> = vec![BTreeSet::new(); runs.len()];
    let mut passed: Vec<BTreeMap<(u32, u32), u32>> = vec![BTreeMap::new(); runs.len()];
    let mut lives: BTreeMap<(u32, u32), usize> = BTreeMap::new();
    let mut latest: Vec<BTreeMap<u32, usize>> = vec![BTreeMap::new(); runs.len()];
    for (_, run, step) in steps {
        let me = runs[run].0;
        if let Step::Handed(id) | Step::Passed(id) = step {
            let life = lives.get(&(id.0, id.1)).copied().unwrap_or(0);
            let latest = latest[run].entry(id.0).or_insert(life);
            *latest = life.max(*latest);
        }
        let is_over = |id: &Id| {
            let latest = latest[run].get(&id.0);
            latest.is_some_and(|latest| lives.get(&(id.0, id.1)).is_some_and(|life| life < latest))
        };
        match step {
            Step::Sent(id) => {
                let count = lives.len();
                lives.entry((id.0, id.1)).or_insert(count);
                past.insert(*id, known[run].clone());
                known[run].insert(*id);
            }
            Step::Passed((from, incarnation, number)) => {
                let mark = passed[run].entry((*from, *incarnation)).or_default();
                *mark = (*mark).max(*number);
            }
            Step::Gap => {}
            Step::Handed(id) => {
                let is_passed = |id: &Id| {
                    let mark = passed[run].get(&(id.0, id.1));
                    mark.is_some_and(|mark| *mark >= id.2)
                };
                if is_over(id) {
                    return Some(format!("{id:?} was delivered by {me} after a later life's"));
                }
                if is_passed(id) {
                    return Some(format!("{id:?} was passed over and handed to {me}"));
                }
                let mut before = past[id].iter();
                let missing = before
                    .find(|b| b.0 != me && !known[run].contains(b) && !is_passed(b) && !is_over(b));
                if let Some(missing) = missing {
                    return Some(format!("{id:?} was delivered by {me} before {missing:?}"));
                }
                let before = past[id].clone();
                known[run].extend(before);
                known[run].insert(*id);
            }
        }
    }
    None
}

/// Two messages that two runs delivered in different orders, or one that a run should have delivered between two
/// others.
pub fn total_violation(runs: &[(u32, Vec<(usize, Step)>)]) -> Option<String> {
    let places: Vec<(u32, Vec<Id>, BTreeMap<Id, usize>)> = runs
        .iter()
        .map(|(robot, steps)| {
            let handed = handed(steps);
            let places = handed
                .iter()
                .enumerate()
                .map(|(at, id)| (*id, at))
                .collect();
            (*robot, handed, places)
        })
        .collect();
    for (robot, sequence, _) in &places {
        for (other, _, places) in &places {
            let common: Vec<usize> = sequence
                .iter()
                .filter_map(|id| places.get(id).copied())
                .collect();
            if !common.is_sorted() {
                return Some(format!("robots {robot} and {other} differ in order"));
            }
        }
    }
    let mut next: BTreeMap<Id, Id> = BTreeMap::new();
    for (robot, steps) in runs {
        let mut last = None;
        for (_, step) in steps {
            match step {
                Step::Handed(id) => {
                    if let Some(last) = last.replace(*id)
                        && *next.entry(last).or_insert(*id) != *id
                    {
                        return Some(format!("robot {robot} has a gap after {last:?}"));
                    }
                }
                Step::Gap => last = None,
                _ => {}
            }
        }
    }
    None
}

/// Runs a fleet of robots that each send for a while, while faults strike at random until `calm`, then
/// for `calm` more. Returns when robots restarted.
pub fn trouble(world: &mut World, robots: usize, seed: u64, span: Duration) -> Vec<(Time, u32)> {
    let mut random = Random::keyed(seed, &[77]);
    let mut starts = Vec::new();
    let mut down = BTreeSet::new();
    let end = world.now + span;
    while world.now < end {
        world.run_for(Duration::from_millis(300 + u64::from(random.below(2500))));
        let robot = random.below(robots as u32);
        match random.below(5) {
            0 | 1 if down.len() * 2 + 2 < robots || random.chance(0.1) => {
                world.crash(robot as usize);
                down.insert(robot);
            }
            2 => {
                if let Some(robot) = down.pop_first() {
                    starts.push((world.now, robot));
                    world.start(robot as usize);
                }
            }
            3 => {
                let side: Vec<bool> = (0..robots).map(|_| random.chance(0.5)).collect();
                for a in 0..robots {
                    for b in 0..robots {
                        if side[a] != side[b] {
                            world.wire.cut.insert((a as u32, b as u32));
                        }
                    }
                }
            }
            _ => world.wire.cut.clear(),
        }
    }
    world.wire.cut.clear();
    // Time distinguishes the actions of a robot at its start from those before its crash.
    world.run_for(Duration::from_millis(1));
    for robot in down {
        starts.push((world.now, robot));
        world.start(robot as usize);
    }
    starts
}
