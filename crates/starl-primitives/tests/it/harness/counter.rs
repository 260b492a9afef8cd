//! A program that counts in a register by claiming and writing it, with nothing that keeps robots apart.

use super::World;
use starl_core::event::{PrimitiveEvent, RegisterEvent};
use starl_core::{Duration, Event, Payload, Primitives, Program, Random, Robot, RobotId, Time};
use starl_primitives::Register;
use starl_primitives::register::{OperationId, Options, Status};
use std::any::Any;
use std::collections::{BTreeMap, BTreeSet};

#[derive(Clone, Primitives)]
pub struct Counter {
    pub register: Register,
    /// The pending operation, and its value, if it writes.
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

    /// The value of this robot's own copy.
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

    fn corrupt(&mut self, random: &mut Random) {
        self.register.corrupt(random);
    }

    fn inspect(&self) -> Option<&dyn Any> {
        Some(self)
    }
}

/// The results of updates.
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
    let mut begun: BTreeMap<(u32, u32), Option<i64>> = BTreeMap::new();
    let mut replaced: BTreeMap<Option<i64>, u32> = BTreeMap::new();
    for (at, RobotId(robot), event) in &world.records {
        let Event::Primitive {
            event: PrimitiveEvent::Register(event),
            ..
        } = event
        else {
            continue;
        };
        match event {
            RegisterEvent::Update {
                operation, found, ..
            } => {
                let key = (*robot, operation.operation);
                // A restarted robot restarts its count; operations that were pending then never
                // end.
                tally.open += usize::from(begun.insert(key, *found).is_some());
            }
            RegisterEvent::Done { operation, .. } | RegisterEvent::Lost { operation, .. } => {
                let key = (*robot, operation.operation);
                let Some(found) = begun.remove(&key) else {
                    continue; // a claim
                };
                if matches!(event, RegisterEvent::Lost { .. }) {
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
