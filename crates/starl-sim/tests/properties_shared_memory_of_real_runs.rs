//! The checker of shared memory and the primitive agree on simulated robots: the primitive keeps its
//! promises under every fault, and memories that are made worse are found out.

mod engine_support;

use engine_support::scenario;
use starl_core::{
    Destination, Duration, Input, Message, Payload, Port, Primitive, Program, Random, Robot,
    RobotId, Time, Value, message,
};
use starl_primitives::SharedMemory;
use starl_primitives::shared_memory::Options;
use starl_sim::scenario::Clock;
use starl_sim::{Run, Scenario};

/// Six robots within reach of each other for two minutes, that write for the first.
fn six_robots(seed: u64) -> Scenario {
    let places: Vec<_> = (0..6).map(|robot| (f64::from(robot), 0.0)).collect();
    let mut scenario = scenario("create", &places);
    scenario.seed = seed;
    scenario.duration = Duration::from_seconds(120);
    scenario
}

/// Loses, repeats and reorders datagrams; clocks are up to an hour apart.
fn lossy(seed: u64) -> Scenario {
    let mut scenario = six_robots(seed);
    scenario.network.link.loss = 0.3;
    scenario.network.link.duplication = 0.2;
    scenario.network.link.reordering = 0.2;
    scenario.fleet.groups[0].clock = Clock {
        offset: Duration::from_seconds(3600),
        drift_ppm: 100.0,
    };
    scenario
}

/// And partitions and crashes.
fn chaotic(seed: u64) -> Scenario {
    let mut scenario = lossy(seed);
    let rates = &mut scenario.faults.rates;
    rates.crash = 0.02;
    rates.restart_after = Duration::from_seconds(3);
    rates.partition = 0.05;
    rates.heal_after = Duration::from_seconds(5);
    scenario
}

/// And overwrites the robots' state.
fn corrupting(seed: u64) -> Scenario {
    let mut scenario = chaotic(seed);
    scenario.faults.rates.corrupt_state = 0.02;
    scenario
}

/// Writes now and then.
#[derive(Clone)]
struct Writer<M> {
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

    fn primitives(&mut self, visit: &mut dyn FnMut(&mut dyn Primitive)) {
        visit(&mut self.memory);
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
    fn report(&self, robot: &mut Robot<'_>, name: &'static str) {
        let Some((time, writer, value)) = self.held else {
            return;
        };
        let fields = [
            ("variable", "x".into()),
            ("single_writer", false.into()),
            ("time", time.into()),
            ("count", 0u32.into()),
            ("writer", writer.into()),
            ("value", Value::Int(value.into())),
        ];
        robot.emit_primitive("shared_memory", NAIVE, name, fields);
    }
}

impl Primitive for Naive {
    fn port(&self) -> Port {
        NAIVE
    }

    fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) {
        match input {
            Input::Start => robot.emit_primitive("shared_memory", NAIVE, "start", []),
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
            self.report(robot, "update");
        }
    }
}

impl Memory for Naive {
    fn write(&mut self, robot: &mut Robot<'_>, _: &'static str, value: u32) {
        let write = (robot.now(), robot.id(), value);
        self.held = Some(write);
        self.report(robot, "write");
        let datagram: Payload = message::encode(&write);
        robot.transmit_bytes(Destination::All, NAIVE, datagram);
    }

    fn write_own(&mut self, _: &mut Robot<'_>, _: &'static str, _: u32) {}

    fn corrupt(&mut self, _: &mut Random) {}
}

/// The properties that are violated, each once, and how many times memories changed.
fn violated(scenario: Scenario, memory: impl Memory) -> (Vec<String>, usize) {
    let writer = Writer {
        memory,
        activations: 0,
    };
    let mut run = Run::new(scenario, &|_| Ok(Box::new(writer.clone()))).expect("the run starts");
    let mut changes = 0;
    while !run.is_over() {
        let is_change = |record: &&starl_core::Record| matches!(&record.event, starl_core::Event::Primitive { name, .. } if name == "update");
        changes += run.step().iter().filter(is_change).count();
    }
    for violation in run.violations() {
        println!(
            "{} {}: {}",
            violation.at, violation.property, violation.text
        );
    }
    let verdicts = run.verdicts();
    let violated = verdicts
        .into_iter()
        .filter(|verdict| verdict.violations > 0);
    (
        violated
            .map(|verdict| verdict.property.to_string())
            .collect(),
        changes,
    )
}

fn shared_memory() -> SharedMemory {
    SharedMemory::new("memory", Options::default())
}

#[test]
fn the_primitive_keeps_its_promises_under_every_fault() {
    for seed in 0..12 {
        for make in [six_robots, lossy, chaotic, corrupting] {
            let mut scenario = make(seed);
            scenario.properties.no_collision = false;
            scenario.properties.shared_memory_bound = Duration::from_seconds(20);
            let (violated, changes) = violated(scenario, shared_memory());
            assert_eq!(violated, [] as [&str; 0], "seed {seed}");
            assert!(changes > 500, "{changes}");
        }
    }
}

#[test]
fn one_that_sends_once_does_not_converge_where_datagrams_are_lost() {
    let (found, _) = violated(six_robots(1), Naive::default());
    assert_eq!(found, [] as [&str; 0]);
    let mut lossy = six_robots(1);
    lossy.network.link.loss = 0.6;
    let (found, _) = violated(lossy, Naive::default());
    assert_eq!(found, ["shared_memory.convergence"]);
}

#[test]
fn one_that_goes_by_raw_clocks_loses_later_writes() {
    let mut scenario = six_robots(1);
    scenario.fleet.groups[0].clock.offset = Duration::from_seconds(3600);
    let (found, _) = violated(scenario, Naive::default());
    assert!(
        found.contains(&"shared_memory.order".to_string()),
        "{found:?}"
    );
}

#[test]
fn one_that_spoils_values_is_found_out() {
    let spoiling = Naive {
        spoils: true,
        ..Naive::default()
    };
    let (found, _) = violated(six_robots(1), spoiling);
    assert_eq!(found, ["shared_memory.integrity"]);
}
