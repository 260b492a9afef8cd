//! How fast fleets run whose robots all write shared memory every second.
//!
//! `cargo bench -p starl-sim --bench shared_memory`
//!
//! Squares of 4 m hold ten robots each, that drive in small circles. The ten share a memory, in which each
//! writes its position every second and reads those of the others ten times a second. The radio reaches
//! 6.5 m: across a square, and far into those around it, whose robots hear the datagrams and ignore them.
//! For comparison: fleets whose robots all reach each other and share one memory.

#![allow(
    clippy::disallowed_methods,
    reason = "a benchmark reads the clock, nothing else does"
)]

use starl_core::{Command, Duration, Point, Pose, Primitives, Program, Robot, message};
use starl_motion::models;
use starl_primitives::SharedMemory;
use starl_primitives::shared_memory::Options;
use starl_sim::scenario::{Clock, DelayDistribution, Goal, Group, SensorSuite};
use starl_sim::{Scenario, Simulation};
use std::any::Any;
use std::time::Instant;

/// Robots of a square.
const SQUAD: u32 = 10;

/// Side of a square, metres.
const SIDE: f64 = 4.0;

/// Simulated seconds: to start and settle, and to measure.
const SETTLING: u64 = 5;
const MEASURED: u64 = 10;

#[derive(Clone, Primitives)]
struct Sharer {
    /// The number of robots in a row that share a memory.
    members: u32,
    memory: SharedMemory,
    activations: u32,
    /// Robots whose positions were read in the last activation.
    known: usize,
}

impl Program for Sharer {
    fn start(&mut self, robot: &mut Robot<'_>) {
        let name = format!("squad/{}", robot.id().0 / self.members);
        self.memory = SharedMemory::new(&name, Options::default());
    }

    fn activate(&mut self, robot: &mut Robot<'_>) {
        robot.drive(Command::Wheels {
            left: 0.05,
            right: 0.025,
        });
        if self.activations % 10 == robot.id().0 % 10 {
            let position = message::encode(&robot.position());
            let written = self.memory.write_own(robot, "position", position);
            written.expect("it is short");
        }
        self.activations += 1;
        let positions = self.memory.all("position");
        let read = positions.filter_map(|(_, value)| message::decode::<Point>(value));
        self.known = read.count();
    }

    fn inspect(&self) -> Option<&dyn Any> {
        Some(self)
    }
}

/// Robots in squares.
fn scenario(robots: u32, range: Option<f64>) -> Scenario {
    let squares = robots.div_ceil(SQUAD);
    let row = f64::from(squares).sqrt().ceil() as u32;
    let start = |robot: u32| {
        let (square, place) = (robot / SQUAD, robot % SQUAD);
        let corner = (f64::from(square % row), f64::from(square / row));
        let place = (f64::from(place % 4), f64::from(place / 4));
        let at = |corner: f64, place: f64| (corner * SIDE) + 0.5 + place;
        Pose::level(
            Point::planar(at(corner.0, place.0), at(corner.1, place.1)),
            0.0,
        )
    };
    let mut scenario = Scenario {
        goal: Goal::Duration,
        duration: Duration::from_seconds(SETTLING + MEASURED),
        ..Scenario::default()
    };
    scenario.fleet.groups.push(Group {
        name: "robot".into(),
        numbered: true,
        first_number: 0,
        model: models::by_name("differential").expect("a model"),
        program: "sharer".into(),
        parameters: Default::default(),
        starts: (0..robots).map(start).collect(),
        control_period: Duration::from_millis(100),
        sensors: SensorSuite::default(),
        clock: Clock::default(),
    });
    scenario.physics.step = Duration::from_millis(25);
    scenario.motion.avoidance = None;
    scenario.network.range = range;
    scenario.network.link.delay = Duration::from_millis(15);
    scenario.network.link.distribution = DelayDistribution::Constant;
    scenario
}

/// Seconds for which this process's first thread has computed; of the clock where nothing tells.
fn cpu_seconds(begun: Instant) -> f64 {
    let text = std::fs::read_to_string("/proc/self/schedstat").unwrap_or_default();
    let nanos = text
        .split(' ')
        .next()
        .and_then(|nanos| nanos.parse::<f64>().ok());
    nanos.map_or_else(|| begun.elapsed().as_secs_f64(), |nanos| nanos * 1e-9)
}

fn run(simulation: &mut Simulation, seconds: u64) {
    let end = simulation.now() + Duration::from_seconds(seconds);
    while simulation.now() < end {
        simulation.step();
    }
}

fn measure(robots: u32, members: u32, range: Option<f64>) {
    let begun = Instant::now();
    let sharer = Sharer {
        members,
        memory: SharedMemory::new("", Options::default()),
        activations: 0,
        known: 0,
    };
    let mut simulation =
        Simulation::new(scenario(robots, range), &|_| Ok(Box::new(sharer.clone())))
            .expect("it starts");
    run(&mut simulation, SETTLING);
    let (cpu, delivered) = (cpu_seconds(begun), simulation.tally().delivered);
    run(&mut simulation, MEASURED);
    let cpu = cpu_seconds(begun) - cpu;
    let delivered = simulation.tally().delivered - delivered;
    println!(
        "{robots:>6} robots, {members:>5} a memory: {:>5.2} times real time, {:>9.0} datagrams delivered a second, {:>4.0} ns each",
        MEASURED as f64 / cpu,
        delivered as f64 / MEASURED as f64,
        cpu * 1e9 / delivered as f64,
    );
    for &robot in simulation.robots() {
        let program = simulation.program(robot).inspect();
        let sharer = program.and_then(|any| any.downcast_ref::<Sharer>());
        assert_eq!(sharer.map(|sharer| sharer.known), Some(members as usize));
    }
}

fn main() {
    for robots in [1000, 10_000] {
        measure(robots, SQUAD, Some(6.5));
    }
    for robots in [100, 300] {
        measure(robots, robots, None);
    }
}
