//! A program that reads and writes registers at random, or on command; and a check that its events are linearizable.

use super::World;
use starl_core::event::{PrimitiveEvent, RegisterEvent};
use starl_core::{
    Duration, Event, Primitives, Program, Random, Robot, RobotId, Time, TimerKey, timers,
};
use starl_primitives::register::{OperationId, Options, Status};
use starl_primitives::{FailureDetector, Register, failure_detector};
use std::any::Any;
use std::collections::{BTreeMap, BTreeSet};

/// A crowd is through by then.
const LONGEST: Duration = Duration::from_seconds(600);

/// The registers that there are.
pub const REGISTERS: [&str; 2] = ["x", "y"];

#[derive(Clone, Primitives)]
pub struct Keeper {
    detector: FailureDetector,
    pub register: Register,
    /// Whether it begins operations by itself.
    is_busy: bool,
    pub last: Option<OperationId>,
    next: Time,
}

impl Keeper {
    /// Robots that read and write by themselves, if they are busy.
    pub fn boxed(
        is_busy: bool,
        participants: Option<BTreeSet<RobotId>>,
    ) -> impl Fn() -> Box<dyn Program> {
        move || {
            Box::new(Keeper {
                register: Register::new("register", participants.clone(), Options::default()),
                detector: FailureDetector::new("watch", failure_detector::Options::default()),
                is_busy,
                last: None,
                next: Time::ZERO,
            })
        }
    }
}

timers! {
    pub enum Command {
        Read,
        Write(u32),
        Claim,
        Update(u32),
        Withdraw,
    }
}

/// Tells a robot to read `x`.
pub fn read() -> Command {
    Command::Read
}

/// Tells a robot to write a number to `x`.
pub fn write(value: u32) -> Command {
    Command::Write(value)
}

/// Tells a robot to claim `x`.
pub fn claim() -> Command {
    Command::Claim
}

/// Tells a robot to write a number to `x`, which it has claimed.
pub fn update(value: u32) -> Command {
    Command::Update(value)
}

/// Tells a robot to withdraw its last operation.
pub fn withdraw() -> Command {
    Command::Withdraw
}

impl Program for Keeper {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        let now = robot.now();
        if !self.is_busy || self.register.pending() > 0 || now < self.next {
            return;
        }
        self.next = now + Duration::from_millis(u64::from(robot.random().below(600)));
        let name = REGISTERS[robot.random().below(2) as usize];
        if robot.random().chance(0.5) {
            self.register.read(robot, name).expect("few are under way");
            return;
        }
        // No two writes are of the same value.
        let value = now.0 << 8 | u64::from(robot.id().0);
        let value = value.to_le_bytes().as_slice().into();
        let begun = self.register.write(robot, name, value);
        begun.expect("few are under way");
    }

    fn timer(&mut self, robot: &mut Robot<'_>, key: TimerKey) {
        let content = |value: u32| value.to_le_bytes().as_slice().into();
        let begun = match key.read().expect("a command") {
            Command::Read => self.register.read(robot, "x"),
            Command::Write(value) => self.register.write(robot, "x", content(value)),
            Command::Claim => self.register.claim(robot, "x"),
            Command::Update(value) => self.register.write_claimed(robot, "x", content(value)),
            Command::Withdraw => {
                if let Some(last) = self.last.take() {
                    self.register.withdraw(robot, last);
                }
                return;
            }
        };
        self.last = Some(begun.expect("few are under way"));
    }

    fn corrupt(&mut self, random: &mut Random) {
        self.register.corrupt(random);
    }

    fn inspect(&self) -> Option<&dyn Any> {
        Some(self)
    }
}

/// The program of a robot that is up.
pub fn keeper(world: &World, robot: usize) -> &Keeper {
    world.inspect(robot)
}

/// Runs until what all robots began last is done.
pub fn until_done(world: &mut World) {
    let begun = world.now;
    let is_done = |world: &World, robot| matches!(status(world, robot), Status::Done(_));
    while !(0..world.size()).all(|robot| is_done(world, robot)) {
        world.run_for(Duration::from_millis(1));
        assert!(world.now < begun + LONGEST, "some are never done");
    }
}

/// All robots claim `x` at once and write it, and claim it again where that is lost, until each has written it.
pub fn all_count(world: &mut World) {
    let (robots, begun) = (world.size(), world.now);
    (0..robots).for_each(|robot| world.command(robot, claim()));
    let (mut writes, mut left) = (vec![false; robots], vec![true; robots]);
    while left.contains(&true) {
        world.run_for(Duration::from_millis(1));
        assert!(world.now < begun + LONGEST, "some are never through");
        for robot in (0..robots).filter(|&robot| left[robot]).collect::<Vec<_>>() {
            match status(world, robot) {
                Status::Done(_) if writes[robot] => left[robot] = false,
                Status::Done(_) => {
                    writes[robot] = true;
                    world.command(robot, update(robot as u32));
                }
                Status::Lost => {
                    writes[robot] = false;
                    world.command(robot, claim());
                }
                _ => {}
            }
        }
    }
}

/// How far a robot's last operation is.
pub fn status(world: &World, robot: usize) -> Status {
    let keeper = keeper(world, robot);
    let last = keeper.last.expect("it has begun something");
    keeper.register.status(last)
}

/// The value that a robot has read or written, as a number.
pub fn result(world: &World, robot: usize) -> Option<u32> {
    match status(world, robot) {
        Status::Done(value) => value.map(|bytes| number(&bytes)),
        other => panic!("robot {robot} is not done but {other:?}"),
    }
}

/// The value of `x` in a robot's own copy.
pub fn known(world: &World, robot: usize) -> Option<u32> {
    let register = &keeper(world, robot).register;
    register.known("x").map(number)
}

fn number(value: &[u8]) -> u32 {
    value.try_into().map_or(u32::MAX, u32::from_le_bytes)
}

/// All operations of one value: its write and the reads that gave it.
#[derive(Clone, Debug, Default)]
struct Cluster {
    write: Option<(Time, Time)>,
    first_end: Option<Time>,
    last_begin: Option<Time>,
}

/// When an operation began, whether it is a write, of which register, and the value.
type Begun = (Time, bool, String, Option<i64>);

/// Judges a run by its events; gives how many operations each robot has done. No two writes of a register
/// are of the same value, so this is decided by the zones of values (Gibbons and Korach 1997, "Testing
/// Shared Memories"): in time between the first end and the last begin of its operations a register holds a
/// value.
pub fn judge(world: &World) -> Result<BTreeMap<u32, usize>, String> {
    let mut begun: BTreeMap<(u32, u32), Begun> = BTreeMap::new();
    let mut done = Vec::new();
    let mut count: BTreeMap<u32, usize> = BTreeMap::new();
    for (at, RobotId(robot), event) in &world.records {
        let Event::Primitive {
            event: PrimitiveEvent::Register(event),
            ..
        } = event
        else {
            continue;
        };
        let (operation, value) = match event {
            RegisterEvent::Read { operation } => (operation, None),
            RegisterEvent::Write { operation, value } => (operation, Some(*value)),
            RegisterEvent::Done { operation, value } => (operation, *value),
            _ => continue,
        };
        let key = (*robot, operation.operation);
        match event {
            RegisterEvent::Read { .. } | RegisterEvent::Write { .. } => {
                // A restarted robot restarts its count; operations that were pending then never
                // end.
                let is_write = matches!(event, RegisterEvent::Write { .. });
                let operation = (*at, is_write, operation.register.to_string(), value);
                if let Some(lost) = begun.insert(key, operation) {
                    done.push((lost, Time::NEVER));
                }
            }
            _ => {
                let mut operation = begun.remove(&key).expect("it was begun");
                operation.3 = value;
                done.push((operation, *at));
                *count.entry(*robot).or_default() += 1;
            }
        }
    }
    done.extend(begun.into_values().map(|lost| (lost, Time::NEVER)));
    let mut clusters: BTreeMap<(String, Option<i64>), Cluster> = BTreeMap::new();
    for register in REGISTERS {
        let none = clusters.entry((register.to_string(), None)).or_default();
        none.write = Some((Time::ZERO, Time::ZERO));
        none.first_end = Some(Time::ZERO);
    }
    for ((begin, is_write, register, value), end) in done {
        if end == Time::NEVER && !is_write {
            continue;
        }
        let cluster = clusters.entry((register, value)).or_default();
        if is_write {
            cluster.write = Some((begin, end));
        }
        let first = cluster.first_end.unwrap_or(Time::NEVER).min(end);
        cluster.first_end = Some(first);
        let last = cluster.last_begin.unwrap_or(Time::ZERO).max(begin);
        cluster.last_begin = Some(last);
    }
    let mut zones: BTreeMap<String, Vec<(Time, Time)>> = BTreeMap::new();
    for ((register, value), cluster) in clusters {
        let end = cluster.first_end.unwrap_or(Time::NEVER);
        let begin = cluster.last_begin.unwrap_or(Time::ZERO);
        let Some((written, _)) = cluster.write else {
            return Err(format!("{register}: {value:?} was read and never written"));
        };
        if end < written {
            return Err(format!(
                "{register}: {value:?} was read before it was written"
            ));
        }
        if end != Time::NEVER {
            zones.entry(register).or_default().push((end, begin));
        }
    }
    for (register, zones) in zones {
        for (index, &(end, begin)) in zones.iter().enumerate() {
            for (other, &(other_end, other_begin)) in zones.iter().enumerate() {
                let forward = end < begin;
                let other_forward = other_end < other_begin;
                let clash = match (forward, other_forward) {
                    (true, true) => index != other && end < other_begin && other_end < begin,
                    (true, false) => end < other_begin && other_end < begin,
                    _ => false,
                };
                if clash {
                    return Err(format!(
                        "{register}: a value is held from {end:?} to {begin:?}, another from \
                         {other_end:?} to {other_begin:?}"
                    ));
                }
            }
        }
    }
    Ok(count)
}
