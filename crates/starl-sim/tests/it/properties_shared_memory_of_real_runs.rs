//! The checker of shared memory and the primitive agree on simulated robots: the primitive keeps its
//! promises under every fault, and memories that are made worse are found out.

use crate::engine_support::weather::{WEATHERS, fleet, judge};
use starl_core::event::SharedMemoryEvent;
use starl_core::event::storing::Written;
use starl_core::{
    Destination, Duration, Input, Message, Payload, Port, Primitive, Primitives, Program, Random,
    Robot, RobotId, Time, message,
};
use starl_primitives::SharedMemory;
use starl_primitives::shared_memory::Options;
use starl_sim::Scenario;

/// Writes now and then.
#[derive(Clone, Primitives)]
struct Writer<M: Memory> {
    memory: M,
    activations: u32,
}

trait Memory: Primitive + Clone + Send + Sync + 'static {
    fn write(&mut self, robot: &mut Robot<'_>, variable: &'static str, value: u32);
    fn write_own(&mut self, robot: &mut Robot<'_>, variable: &'static str, value: u32);
    fn corrupt(&mut self, random: &mut Random);
}

impl<M: Memory> Program for Writer<M> {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        self.activations += 1;
        if self.activations > 600 {
            return;
        }
        let (draw, value) = (robot.random().below(100), robot.random().bits());
        match draw {
            0..3 => self
                .memory
                .write(robot, ["x", "y", "z"][draw as usize], value),
            3..6 => self
                .memory
                .write_own(robot, ["x", "y", "z"][draw as usize - 3], value),
            _ => {}
        }
    }

    fn corrupt(&mut self, random: &mut Random) {
        self.memory.corrupt(random);
    }
}

impl Memory for SharedMemory {
    fn write(&mut self, robot: &mut Robot<'_>, variable: &'static str, value: u32) {
        let value = value.to_le_bytes().as_slice().into();
        SharedMemory::write(self, robot, variable, value).expect("it is short");
    }

    fn write_own(&mut self, robot: &mut Robot<'_>, variable: &'static str, value: u32) {
        let value = value.to_le_bytes().as_slice().into();
        SharedMemory::write_own(self, robot, variable, value).expect("it is short");
    }

    fn corrupt(&mut self, random: &mut Random) {
        SharedMemory::corrupt(self, random);
    }
}

/// The original's shared memory, roughly: one variable, stamped with the robot's own clock and sent once.
/// It may spoil the values it gets.
#[derive(Clone, Default)]
struct Naive {
    held: Option<(Time, RobotId, u32)>,
    spoils: bool,
}

const NAIVE: Port = Port::named("naive");

impl Naive {
    fn report(&self, robot: &mut Robot<'_>, event: fn(Written) -> SharedMemoryEvent) {
        let Some((time, writer, value)) = self.held else {
            return;
        };
        let written = Written {
            variable: "x".into(),
            single_writer: false,
            time,
            count: 0,
            writer,
            incarnation: 0,
            value: value.into(),
        };
        robot.report(NAIVE, event(written));
    }
}

impl Primitive for Naive {
    fn port(&self) -> Port {
        NAIVE
    }

    fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) {
        match input {
            Input::Start => robot.report(NAIVE, SharedMemoryEvent::Start),
            Input::Message(message) => self.take(robot, message),
            _ => {}
        }
    }
}

impl Naive {
    fn take(&mut self, robot: &mut Robot<'_>, message: &Message) {
        let Some((time, writer, value)) = message.read::<(Time, RobotId, u32)>() else {
            return;
        };
        let key = |(time, writer, _): (Time, RobotId, u32)| (time, writer);
        if self.held.is_none_or(|held| key(held) < (time, writer)) {
            let value = if self.spoils { value ^ 1 } else { value };
            self.held = Some((time, writer, value));
            self.report(robot, |written| SharedMemoryEvent::Update { written });
        }
    }
}

impl Memory for Naive {
    fn write(&mut self, robot: &mut Robot<'_>, _: &'static str, value: u32) {
        let write = (robot.now(), robot.id(), value);
        self.held = Some(write);
        self.report(robot, |written| SharedMemoryEvent::Write { written });
        let datagram: Payload = message::encode(&write);
        robot.transmit_bytes(Destination::All, NAIVE, datagram);
    }

    fn write_own(&mut self, _: &mut Robot<'_>, _: &'static str, _: u32) {}

    fn corrupt(&mut self, _: &mut Random) {}
}

/// The properties that are violated, and how many times memories changed.
fn violated(scenario: Scenario, memory: impl Memory) -> (Vec<String>, usize) {
    let activations = 0;
    judge(
        scenario,
        Writer {
            memory,
            activations,
        },
        "update",
    )
}

fn shared_memory() -> SharedMemory {
    SharedMemory::new("memory", Options::default())
}

#[test]
fn the_primitive_keeps_its_promises_under_every_fault() {
    for seed in 0..12 {
        for weather in WEATHERS {
            let mut scenario = fleet(6, seed);
            weather(&mut scenario);
            scenario.properties.shared_memory_bound = Duration::from_seconds(20);
            let (violated, changes) = violated(scenario, shared_memory());
            assert_eq!(violated, [] as [&str; 0], "seed {seed}");
            assert!(changes > 500, "{changes}");
        }
    }
}

#[test]
fn a_memory_that_sends_once_does_not_converge_if_datagrams_are_lost() {
    let (found, _) = violated(fleet(6, 1), Naive::default());
    assert_eq!(found, [] as [&str; 0]);
    let mut lossy = fleet(6, 1);
    lossy.network.link.loss = 0.6;
    let (found, _) = violated(lossy, Naive::default());
    assert_eq!(found, ["shared_memory.convergence"]);
}

#[test]
fn a_memory_that_uses_raw_clocks_loses_later_writes() {
    let mut scenario = fleet(6, 1);
    scenario.fleet.groups[0].clock.offset = Duration::from_seconds(3600);
    let (found, _) = violated(scenario, Naive::default());
    assert!(
        found.contains(&"shared_memory.order".to_string()),
        "{found:?}"
    );
}

#[test]
fn a_memory_that_changes_values_is_detected() {
    let spoiling = Naive {
        spoils: true,
        ..Naive::default()
    };
    let (found, _) = violated(fleet(6, 1), spoiling);
    assert_eq!(found, ["shared_memory.integrity"]);
}
