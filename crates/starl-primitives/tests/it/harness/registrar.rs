//! A program that registers and leaves, on command or at random repeatedly; and the shown lists with
//! their times, from its events.

use super::World;
use starl_core::{
    Area, Duration, Primitives, Program, Random, Robot, RobotId, Time, TimerKey, Value, timers,
};
use starl_primitives::registration::Options;
use starl_primitives::{FailureDetector, Registration, failure_detector};
use std::any::Any;
use std::collections::BTreeMap;

#[derive(Clone, Primitives)]
pub struct Registrar {
    detector: Option<FailureDetector>,
    pub registration: Registration,
    /// Whether it registers and leaves by itself.
    is_busy: bool,
    next_change: Time,
}

impl Registrar {
    pub fn boxed(is_busy: bool, options: Options) -> impl Fn() -> Box<dyn Program> {
        Registrar::made(is_busy, true, options)
    }

    /// Robots that register on command, with the registration as their only primitive.
    #[allow(dead_code, reason = "the benchmarks use it")]
    pub fn bare(options: Options) -> impl Fn() -> Box<dyn Program> {
        Registrar::made(false, false, options)
    }

    fn made(is_busy: bool, has_detector: bool, options: Options) -> impl Fn() -> Box<dyn Program> {
        move || {
            Box::new(Registrar {
                registration: Registration::new("who", options),
                detector: has_detector.then(watch),
                is_busy,
                next_change: Time::ZERO,
            })
        }
    }
}

timers! {
    pub enum Command {
        Register,
        RegisterWithin(u32),
        Unregister,
    }
}

/// Tells a robot to register with the whole fleet.
pub fn register() -> Command {
    Command::Register
}

/// Tells a robot to register with those this near to it, metres.
pub fn register_within(radius: u32) -> Command {
    Command::RegisterWithin(radius)
}

pub fn unregister() -> Command {
    Command::Unregister
}

fn watch() -> FailureDetector {
    FailureDetector::new("watch", failure_detector::Options::default())
}

impl Program for Registrar {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        if !self.is_busy || robot.now() < self.next_change {
            return;
        }
        let long = robot.random().chance(0.5);
        let most = if long { 20_000 } else { 1000 };
        let pause = Duration::from_millis(u64::from(robot.random().below(most)));
        self.next_change = robot.now() + pause;
        match self.registration.is_registered() {
            false => self.registration.register(robot, None),
            true => self.registration.unregister(robot),
        }
    }

    fn timer(&mut self, robot: &mut Robot<'_>, key: TimerKey) {
        match key.read().expect("a command") {
            Command::Register => self.registration.register(robot, None),
            Command::RegisterWithin(radius) => {
                let area = Area::Circle {
                    center: robot.position(),
                    radius: f64::from(radius),
                };
                self.registration.register(robot, Some(area));
            }
            Command::Unregister => self.registration.unregister(robot),
        }
    }

    fn corrupt(&mut self, random: &mut Random) {
        self.registration.corrupt(random);
    }

    fn inspect(&self) -> Option<&dyn Any> {
        Some(self)
    }
}

/// The registration of a robot that is up.
pub fn registration(world: &World, robot: usize) -> &Registration {
    &world.inspect::<Registrar>(robot).registration
}

/// The list that a robot shows.
pub fn list(world: &World, robot: usize) -> Option<Vec<u32>> {
    let members = registration(world, robot).members()?;
    Some(members.iter().map(|RobotId(number)| *number).collect())
}

/// Whether these robots show the list of just these, all with the same time.
pub fn agree(world: &World, robots: &[u32]) -> bool {
    let time = registration(world, robots[0] as usize).agreed_at();
    robots.iter().all(|&robot| {
        let shown = list(world, robot as usize);
        shown.as_deref() == Some(robots) && registration(world, robot as usize).agreed_at() == time
    })
}

/// The name of a list: its time, its coordinator, and the coordinator's incarnation.
type Id = (Time, RobotId, i64);

/// The reports of a robot in its present life.
#[derive(Default)]
struct Life {
    is_registered: bool,
    promised: Option<Id>,
    shown: Option<(Id, Vec<RobotId>)>,
    /// Counts the robot's lives.
    number: u32,
}

/// Judges a run by its events: agreement, exclusion, soundness and order, as the primitive promises them.
/// Crashes are given, since they leave no event, each with the number of records before it. Returns how many lists were
/// shown.
pub fn judge(world: &World, crashes: &[(usize, u32)], apart: Duration) -> usize {
    let mut lives: BTreeMap<RobotId, Life> = BTreeMap::new();
    // By name: the robots that have accepted a list, in which life, registered.
    let mut accepted: BTreeMap<Id, BTreeMap<RobotId, u32>> = BTreeMap::new();
    let mut lists: BTreeMap<Id, Vec<RobotId>> = BTreeMap::new();
    let mut crashes = crashes.iter().copied().peekable();
    let (mut events, mut count) = (Vec::new(), 0);
    for name in [
        "register",
        "unregister",
        "propose",
        "accept",
        "agree",
        "lose",
    ] {
        for (at, robot, fields) in world.indexed_events(name) {
            events.push((at, robot, name, fields));
        }
    }
    events.sort_by_key(|(index, ..)| *index);
    for (index, robot, name, fields) in events {
        let at = world.records[index].0;
        while let Some((_, crashed)) = crashes.next_if(|(before, _)| *before <= index) {
            let life = lives.entry(RobotId(crashed)).or_default();
            let number = life.number + 1;
            *life = Life {
                number,
                ..Life::default()
            };
        }
        let id = match (
            fields.get("time"),
            fields.get("coordinator"),
            fields.get("incarnation"),
        ) {
            (Some(Value::Time(time)), Some(Value::Robot(c)), Some(Value::Int(i))) => {
                Some((*time, *c, *i))
            }
            _ => None,
        };
        let life = lives.entry(robot).or_default();
        match (name, id) {
            ("register", _) => life.is_registered = true,
            ("unregister", _) => {
                life.is_registered = false;
                life.shown = None;
            }
            ("lose", _) => life.shown = None,
            ("propose" | "accept", Some(id)) => {
                assert!(life.is_registered, "{robot} accepts and is not registered");
                if let Some(promised) = life.promised {
                    let is_later = id.0 >= promised.0 + apart || id == promised;
                    assert!(is_later, "{robot} accepts {id:?} after {promised:?}");
                }
                life.promised = Some(id);
                life.shown = None;
                accepted.entry(id).or_default().insert(robot, life.number);
            }
            ("agree", Some(id)) => {
                let Some(Value::Robots(members)) = fields.get("members") else {
                    panic!("{fields:?}");
                };
                assert!(life.is_registered && members.contains(&robot));
                assert_eq!(
                    life.promised,
                    Some(id),
                    "{robot} shows what it did not accept"
                );
                let same = lists.entry(id).or_insert_with(|| members.clone());
                assert_eq!(same, members, "two lists called {id:?}");
                for member in members {
                    assert!(accepted[&id].contains_key(member), "{member} is in {id:?}");
                }
                life.shown = Some((id, members.clone()));
                count += 1;
                for &other in members {
                    let Some(life) = lives.get(&other).filter(|_| other != robot) else {
                        continue;
                    };
                    let in_this_life = accepted[&id].get(&other) == Some(&life.number);
                    let me = lives[&robot].number;
                    if let Some((shown, theirs)) = &life.shown
                        && in_this_life
                        && theirs.contains(&robot)
                        && accepted[shown].get(&robot) == Some(&me)
                    {
                        assert_eq!(*shown, id, "{robot} and {other} list each other at {at:?}");
                    }
                }
            }
            _ => panic!("{name} has no list"),
        }
    }
    count
}
