//! The checker of registers and the primitive agree on simulated robots: the primitive keeps its promise
//! under every fault, and one that leaves out a part of the algorithm is found out.

use crate::engine_support::weather::{calm, chaotic, fleet, judge, lossy};
use starl_core::event::RegisterEvent;
use starl_core::event::storing::Operation;
use starl_core::{
    Destination, Input, Message, Port, Primitive, Primitives, Program, Robot, RobotId,
};
use starl_primitives::Register;
use starl_primitives::register::Options;
use std::collections::BTreeSet;

/// Something with registers that robots read and write now and then.
trait Registers: Primitive + Clone + Send + Sync + 'static {
    fn is_idle(&self) -> bool;
    fn read(&mut self, robot: &mut Robot<'_>, register: &'static str);
    fn write(&mut self, robot: &mut Robot<'_>, register: &'static str, value: u32);
}

#[derive(Clone, Primitives)]
struct User<R: Registers>(R);

impl<R: Registers> Program for User<R> {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        let draw = robot.random().below(12);
        if !self.0.is_idle() || draw >= 6 {
            return;
        }
        let register = ["x", "y"][(draw % 2) as usize];
        // Few values, so that many writes write the same.
        let value = robot.random().below(8);
        match draw < 4 {
            true => self.0.read(robot, register),
            false => self.0.write(robot, register, value),
        }
    }
}

impl Registers for Register {
    fn is_idle(&self) -> bool {
        self.pending() == 0
    }

    fn read(&mut self, robot: &mut Robot<'_>, register: &'static str) {
        Register::read(self, robot, register).expect("few are under way");
    }

    fn write(&mut self, robot: &mut Robot<'_>, register: &'static str, value: u32) {
        let value = value.to_le_bytes().as_slice().into();
        Register::write(self, robot, register, value).expect("few are under way");
    }
}

const NAIVE: Port = Port::named("naive");

/// A register whose reads give the latest copy of a majority and do not have it stored.
#[derive(Clone, Default)]
struct Naive {
    copy: (u32, u32),
    number: u32,
    /// The pending operation: whether it is a write, the robots that have answered, and the latest
    /// copy.
    under_way: Option<(bool, BTreeSet<RobotId>, (u32, u32))>,
}

impl Naive {
    fn operation(&self) -> Operation {
        Operation {
            operation: self.number,
            register: "x".into(),
        }
    }

    fn report_done(&self, robot: &mut Robot<'_>, value: Option<u32>) {
        let done = RegisterEvent::Done {
            operation: self.operation(),
            value: value.map(i64::from),
        };
        robot.report(NAIVE, done);
    }

    fn begin(&mut self, robot: &mut Robot<'_>, is_write: bool, value: u32) {
        self.number += 1;
        match is_write {
            true => {
                let (operation, value) = (self.operation(), value.into());
                robot.report(NAIVE, RegisterEvent::Write { operation, value });
            }
            false => {
                let operation = self.operation();
                robot.report(NAIVE, RegisterEvent::Read { operation });
            }
        }
        let copy = match is_write {
            true => (self.copy.0 + 1, value),
            false => self.copy,
        };
        self.copy = copy;
        self.under_way = Some((is_write, BTreeSet::from([robot.id()]), copy));
        self.ask(robot);
    }

    fn ask(&self, robot: &mut Robot<'_>) {
        if let Some((is_write, _, copy)) = &self.under_way {
            robot.transmit(
                Destination::All,
                NAIVE,
                &(true, self.number, *is_write, *copy),
            );
        }
    }

    fn take(&mut self, robot: &mut Robot<'_>, message: &Message) {
        type Datagram = (bool, u32, bool, (u32, u32));
        let Some((is_question, number, is_write, copy)) = message.read::<Datagram>() else {
            return;
        };
        if is_question {
            if is_write {
                self.copy = self.copy.max(copy);
            }
            let answer: Datagram = (false, number, is_write, self.copy);
            return robot.transmit(Destination::Robot(message.from), NAIVE, &answer);
        }
        let Some((is_write, answers, latest)) = &mut self.under_way else {
            return;
        };
        if number != self.number {
            return;
        }
        answers.insert(message.from);
        if !*is_write {
            *latest = (*latest).max(copy);
        }
        if answers.len() > robot.fleet().len() / 2 {
            let value = (latest.0 > 0).then_some(latest.1);
            self.report_done(robot, value);
            self.under_way = None;
        }
    }
}

impl Primitive for Naive {
    fn port(&self) -> Port {
        NAIVE
    }

    fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) {
        match input {
            Input::Message(message) => self.take(robot, message),
            Input::Activate => self.ask(robot),
            _ => {}
        }
    }
}

impl Registers for Naive {
    fn is_idle(&self) -> bool {
        self.under_way.is_none()
    }

    fn read(&mut self, robot: &mut Robot<'_>, _: &'static str) {
        self.begin(robot, false, 0);
    }

    /// Robot 0 alone writes, so that there are no equal tags.
    fn write(&mut self, robot: &mut Robot<'_>, _: &'static str, value: u32) {
        if robot.id() == RobotId(0) {
            let value = 8 * robot.random().below(1 << 20) + value;
            self.begin(robot, true, value);
        }
    }
}

#[test]
fn the_primitive_keeps_its_promise_under_every_fault() {
    for seed in 0..12 {
        for weather in [calm, lossy, chaotic] {
            let mut scenario = fleet(5, seed);
            weather(&mut scenario);
            let register = Register::new("register", None, Options::default());
            let (violated, done) = judge(scenario, User(register), "done");
            assert_eq!(violated, [] as [&str; 0], "seed {seed}");
            assert!(done > 200, "seed {seed}: {done}");
        }
    }
}

#[test]
fn reads_that_do_not_have_their_value_stored_are_found_out() {
    let found = (0..20).any(|seed| {
        let mut scenario = fleet(5, seed);
        lossy(&mut scenario);
        let (violated, done) = judge(scenario, User(Naive::default()), "done");
        assert!(done > 200, "{done}");
        violated == ["register.linearizability"]
    });
    assert!(found);
}
