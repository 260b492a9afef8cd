//! A program that counts in a register by claiming and writing it, with nothing that keeps robots apart.

use super::World;
use starl_core::event::Value;
use starl_core::{Duration, Event, Payload, Primitive, Program, Random, Robot, RobotId, Time};
use starl_primitives::Register;
use starl_primitives::register::{OperationId, Options, Status};
use std::any::Any;
use std::collections::{BTreeMap, BTreeSet};

#[derive(Clone)]
pub struct Counter {
    pub register: Register,
    /// What is under way, and the value that is being written, if it is.
    under_way: Option<(OperationId, Option<u64>)>,
    next: Time,
    /// The longest pause between two, milliseconds.
    pause: u32,
}

impl Counter {
    pub fn boxed(
        participants: Option<BTreeSet<RobotId>>,
        pause: u32,
    ) -> impl Fn() -> Box<dyn Program> {
        move || {
            Box::new(Counter {
                register: Register::new("register", participants.clone(), Options::default()),
                under_way: None,
                next: Time::ZERO,
                pause,
            })
        }
    }

    /// What this robot's own copy shows.
    pub fn known(&self) -> u64 {
        number(self.register.known("x"))
    }
}

fn number(value: Option<&[u8]>) -> u64 {
    let bytes = value.and_then(|value| value.try_into().ok());
    bytes.map_or(0, u64::from_le_bytes)
}

impl Program for Counter {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        let now = robot.now();
        let Some((operation, written)) = self.under_way else {
            if now >= self.next {
                let claim = self.register.claim(robot, "x").expect("few are under way");
                self.under_way = Some((claim, None));
            }
            return;
        };
        match (self.register.status(operation), written) {
            (Status::Done(value), None) => {
                let value = number(value.as_deref()) + 1;
                let payload = Payload::from(value.to_le_bytes().as_slice());
                let write = self.register.write_claimed(robot, "x", payload);
                self.under_way = Some((write.expect("it is claimed"), Some(value)));
            }
            (Status::Pending | Status::NoQuorum, _) => {}
            _ => {
                self.under_way = None;
                let pause = robot.random().below(self.pause);
                self.next = now + Duration::from_millis(u64::from(pause));
            }
        }
    }

    fn primitives(&mut self, visit: &mut dyn FnMut(&mut dyn Primitive)) {
        visit(&mut self.register);
    }

    fn corrupt(&mut self, random: &mut Random) {
        self.register.corrupt(random);
    }

    fn inspect(&self) -> Option<&dyn Any> {
        Some(self)
    }
}

/// What became of updates.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// How many of each robot's are done.
    pub done: BTreeMap<u32, usize>,
    pub lost: usize,
    /// How many did not end, or have not yet.
    pub open: usize,
}

impl Tally {
    pub fn all_done(&self) -> usize {
        self.done.values().sum()
    }
}

/// Judges a run by its events: no two updates that are done have found the same value.
pub fn tally(world: &World) -> Result<Tally, String> {
    let mut tally = Tally::default();
    let mut begun: BTreeMap<(u32, String), Option<i64>> = BTreeMap::new();
    let mut replaced: BTreeMap<Option<i64>, u32> = BTreeMap::new();
    for (at, RobotId(robot), event) in &world.records {
        let Event::Primitive {
            primitive,
            name,
            fields,
            ..
        } = event
        else {
            continue;
        };
        let field = |wanted: &str| fields.iter().find(|(name, _)| name == wanted);
        let (true, Some((_, operation))) = (primitive == "register", field("operation")) else {
            continue;
        };
        let key = (*robot, format!("{operation:?}"));
        match &**name {
            "update" => {
                let found = match field("found") {
                    Some((_, Value::Int(found))) => Some(*found),
                    _ => None,
                };
                // Whoever starts anew counts anew; what was under way then never ends.
                tally.open += usize::from(begun.insert(key, found).is_some());
            }
            "done" | "lost" => {
                let Some(found) = begun.remove(&key) else {
                    continue; // a claim
                };
                if name == "lost" {
                    tally.lost += 1;
                } else {
                    *tally.done.entry(*robot).or_default() += 1;
                    if let Some(other) = replaced.insert(found, *robot) {
                        return Err(format!(
                            "{at:?}: robots {other} and {robot} have replaced the same value"
                        ));
                    }
                }
            }
            _ => {}
        }
    }
    tally.open += begun.len();
    Ok(tally)
}
