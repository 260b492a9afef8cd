//! Small worlds and programs for the engine's tests.

pub mod weather;

use starl_core::{
    Command, Destination, Duration, Event, Message, Payload, Point, Port, Pose, Primitives,
    Program, Random, Record, Robot,
};
use starl_motion::models;
use starl_sim::Simulation;
use starl_sim::scenario::{
    Clock, DelayDistribution, Goal, Group, Scenario, SensorSuite, WorldObstacle,
};

/// Robots of one model at these places, heading along x, in an empty world that lasts a minute.
pub fn scenario(model: &str, places: &[(f64, f64)]) -> Scenario {
    let starts = places
        .iter()
        .map(|&(x, y)| Pose::level(Point::planar(x, y), 0.0))
        .collect();
    let mut scenario = Scenario {
        goal: Goal::Duration,
        duration: Duration::from_seconds(60),
        ..Scenario::default()
    };
    scenario.fleet.groups.push(Group {
        name: model.into(),
        numbered: true,
        first_number: 0,
        model: models::by_name(model).expect("a model"),
        program: "test".into(),
        parameters: Default::default(),
        starts,
        control_period: Duration::from_millis(100),
        sensors: SensorSuite::default(),
        clock: Clock::default(),
    });
    scenario
}

/// A network without chance.
pub fn exact_delay(scenario: &mut Scenario, millis: u64) {
    scenario.network.link.delay = Duration::from_millis(millis);
    scenario.network.link.distribution = DelayDistribution::Constant;
}

pub fn obstacle(shape: starl_core::Obstacle) -> WorldObstacle {
    WorldObstacle {
        obstacle: shape,
        hidden: false,
        expires: starl_core::Time::NEVER,
    }
}

/// A recording simulation in which every robot runs `program`.
pub fn simulate(scenario: Scenario, program: impl Program + Clone + 'static) -> Simulation {
    let mut simulation =
        Simulation::new(scenario, &|_| Ok(Box::new(program.clone()))).expect("it starts");
    simulation.set_recording(true);
    simulation
}

/// Runs for some seconds and returns all records.
pub fn run(simulation: &mut Simulation, seconds: f64) -> Vec<Record> {
    let end = simulation.now() + Duration::from_seconds_f64(seconds);
    let mut records = Vec::new();
    while simulation.now() < end {
        simulation.step();
        records.extend_from_slice(simulation.records());
    }
    records
}

/// How many records satisfy a test.
pub fn count(records: &[Record], test: impl Fn(&Event) -> bool) -> usize {
    records.iter().filter(|record| test(&record.event)).count()
}

/// Gives its command at every activation.
#[derive(Clone, Primitives)]
pub struct Drive(pub Command);

impl Program for Drive {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        robot.drive(self.0);
    }
}

/// Robot 0 broadcasts a counter at every activation; all report the numbers that they receive.
#[derive(Clone, Default, Primitives)]
pub struct Chatter {
    pub count: u32,
}

impl Program for Chatter {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        if robot.id().0 == 0 {
            let payload = Payload::from_slice(&self.count.to_le_bytes());
            robot.transmit_bytes(Destination::All, Port::PROGRAM, payload);
            self.count += 1;
        }
    }

    fn receive(&mut self, robot: &mut Robot<'_>, message: &Message) {
        let heard = message.payload[0];
        robot.emit("heard", [("first_byte", u32::from(heard).into())]);
    }

    fn corrupt(&mut self, random: &mut Random) {
        self.count = 1_000_000 + random.below(1000);
    }
}

/// Draws from its random stream, drives about and chats: something that differs with every seed.
#[derive(Clone, Default, Primitives)]
pub struct Wander {
    heard: u32,
}

impl Program for Wander {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        let (left, right) = (
            robot.random().between(0.0, 0.2),
            robot.random().between(0.0, 0.2),
        );
        robot.drive(Command::Wheels { left, right });
        if robot.random().chance(0.3) {
            robot.transmit(Destination::All, Port::PROGRAM, &self.heard);
        }
        let nearness: f64 = robot
            .sensors()
            .proximity
            .iter()
            .map(|ray| ray.nearness)
            .sum();
        if nearness > 0.0 {
            robot.emit("near", [("nearness", nearness.into())]);
        }
    }

    fn receive(&mut self, robot: &mut Robot<'_>, message: &Message) {
        self.heard += 1;
        robot.emit("heard", [("from", message.from.into())]);
    }
}
