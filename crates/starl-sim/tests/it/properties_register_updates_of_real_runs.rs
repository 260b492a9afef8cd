//! The checker of registers and claims agree on simulated robots: updates of claimed registers are done one
//! after the other under every fault, and robots that read and then write without a claim are found out.

use crate::engine_support::weather::{calm, chaotic, fleet, judge, lossy};
use starl_core::{Payload, Port, Primitive, Program, Robot};
use starl_primitives::Register;
use starl_primitives::register::{OperationId, Options, Status};

/// A program that reads a counter now and then, or counts it up.
#[derive(Clone)]
struct Counter {
    register: Register,
    /// Whether it claims what it counts up; else it reads it and then writes it.
    claims: bool,
    step: Step,
    /// Counts what it reports itself.
    number: u32,
}

#[derive(Clone, Copy, PartialEq)]
enum Step {
    Idle,
    Looking(OperationId),
    Claiming(OperationId),
    Writing(OperationId),
}

impl Counter {
    fn new(claims: bool) -> Counter {
        Counter {
            register: Register::new("register", None, Options::default()),
            claims,
            step: Step::Idle,
            number: 0,
        }
    }

    fn report(&self, robot: &mut Robot<'_>, name: &'static str, found: u32) {
        let fields = [
            ("operation", self.number.into()),
            ("register", "x".into()),
            ("found", found.into()),
            ("value", (found + 1).into()),
        ];
        match (name, found) {
            // Nothing was written before.
            ("update", 0) => {
                let [number, register, _, value] = fields;
                robot.emit_primitive("register", UNFENCED, name, [number, register, value]);
            }
            _ => robot.emit_primitive("register", UNFENCED, name, fields),
        }
    }

    fn write(&mut self, robot: &mut Robot<'_>, found: u32) -> OperationId {
        let value = Payload::from((found + 1).to_le_bytes().as_slice());
        let write = match self.claims {
            true => self.register.write_claimed(robot, "x", value),
            false => {
                self.number += 1;
                self.report(robot, "update", found);
                self.register.write(robot, "x", value)
            }
        };
        write.expect("few are under way")
    }
}

/// Where robots that claim nothing say what they do.
const UNFENCED: Port = Port::named("unfenced");

fn number(value: Option<Payload>) -> u32 {
    let bytes = value.and_then(|value| (&*value).try_into().ok());
    bytes.map_or(0, u32::from_le_bytes)
}

impl Program for Counter {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        let operation = match self.step {
            Step::Idle => {
                let begun = match (robot.random().below(12), self.claims) {
                    (0..2, _) => self.register.read(robot, "x").map(Step::Looking),
                    (2..6, true) => self.register.claim(robot, "x").map(Step::Claiming),
                    (2..6, false) => self.register.read(robot, "x").map(Step::Claiming),
                    _ => return,
                };
                self.step = begun.expect("few are under way");
                return;
            }
            Step::Looking(operation) | Step::Claiming(operation) | Step::Writing(operation) => {
                operation
            }
        };
        let value = match self.register.status(operation) {
            Status::Pending | Status::NoQuorum => return,
            Status::Done(value) => number(value),
            _ => 0,
        };
        self.step = match self.step {
            Step::Claiming(_) => Step::Writing(self.write(robot, value)),
            Step::Writing(_) if !self.claims => {
                self.report(robot, "done", value - 1);
                Step::Idle
            }
            _ => Step::Idle,
        };
    }

    fn primitives(&mut self, visit: &mut dyn FnMut(&mut dyn Primitive)) {
        visit(&mut self.register);
    }
}

#[test]
fn claims_keep_their_promise_under_every_fault() {
    for seed in 0..12 {
        for weather in [calm, lossy, chaotic] {
            let mut scenario = fleet(5, seed);
            weather(&mut scenario);
            let (violated, done) = judge(scenario, Counter::new(true), "done");
            assert_eq!(violated, [] as [&str; 0], "seed {seed}");
            assert!(done > 100, "seed {seed}: {done}");
        }
    }
}

#[test]
fn writes_without_a_claim_are_found_out() {
    let (violated, done) = judge(fleet(5, 1), Counter::new(false), "done");
    assert!(done > 100, "{done}");
    assert!(violated.contains(&"register.linearizability".into()));
}
