//! The checkers of registration and barrier and the primitives agree on simulated robots: the primitives
//! keep their promises under every fault.

use crate::engine_support::weather::{WEATHERS, fleet};
use starl_core::{Duration, Event, Primitive, Program, Random, Robot, Time};
use starl_primitives::failure_detector::{self, FailureDetector};
use starl_primitives::{Barrier, Registration, barrier, registration};
use starl_sim::Run;

/// Registers and leaves at random for the first minute, and comes to the barrier again and again.
#[derive(Clone)]
struct Visitor {
    detector: FailureDetector,
    registration: Registration,
    barrier: Barrier,
    begun: Option<Time>,
}

impl Visitor {
    fn boxed() -> Box<dyn Program> {
        Box::new(Visitor {
            detector: FailureDetector::new("watch", failure_detector::Options::default()),
            registration: Registration::new("who", registration::Options::default()),
            barrier: Barrier::new("gate", None, barrier::Options::default()),
            begun: None,
        })
    }
}

impl Program for Visitor {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        let begun = *self.begun.get_or_insert(robot.now());
        let is_late = robot.now().since(begun) > Duration::from_seconds(60);
        match self.registration.is_registered() {
            false if is_late || robot.random().chance(0.02) => {
                self.registration.register(robot, None);
            }
            true if !is_late && robot.random().chance(0.01) => self.registration.unregister(robot),
            _ => {}
        }
        if !self.barrier.is_waiting() && robot.random().chance(0.1) {
            self.barrier.arrive(robot);
        }
    }

    fn primitives(&mut self, visit: &mut dyn FnMut(&mut dyn Primitive)) {
        visit(&mut self.detector);
        visit(&mut self.registration);
        visit(&mut self.barrier);
    }

    fn corrupt(&mut self, random: &mut Random) {
        self.registration.corrupt(random);
        self.barrier.corrupt(random);
    }
}

#[test]
fn the_primitives_keep_their_promises_under_every_fault() {
    for seed in 0..15 {
        for weather in WEATHERS {
            let mut scenario = fleet(5, seed);
            weather(&mut scenario);
            let make_program = |_: &_| Ok(Visitor::boxed());
            let mut run = Run::new(scenario, &make_program).expect("the run starts");
            let (mut lists, mut crossings) = (0, 0);
            while !run.is_over() {
                for record in run.step() {
                    match &record.event {
                        Event::Primitive { name, .. } if name == "agree" => lists += 1,
                        Event::Primitive { name, .. } if name == "pass" => crossings += 1,
                        _ => {}
                    }
                }
            }
            for violation in run.violations() {
                let (at, text) = (violation.at, &violation.text);
                println!("seed {seed} {at} {}: {text}", violation.property);
            }
            assert!(run.violations().is_empty(), "seed {seed}");
            assert!(
                lists > 30 && crossings > 30,
                "{lists} lists, {crossings} crossings"
            );
        }
    }
}
