//! Every robot of a simulation can be replayed from its journal alone: over crashes, restarts and corruption, with all
//! sensors, and while obstacles expire and are discovered.

use crate::engine_support::{exact_delay, obstacle, scenario, simulate};
use crate::journal_support::{Replay, recorded, replay};
use starl_core::motion::{PlanRequest, Planner};
use starl_core::{
    Command, Destination, Duration, Input, Intervention, Message, Obstacle, Point, Port, Pose,
    Primitive, Primitives, Program, Random, Robot, RobotId, Time, WayPoint,
};
use starl_sim::Scenario;
use starl_sim::scenario::{Clock, Detector, Fault, FaultKind, Proximity, Thing};

/// Reports everything that it knows, whenever it is called: a replay that shows it anything else differs.
#[derive(Clone, Default)]
struct Reporter {
    calls: u64,
}

impl Reporter {
    fn report(&mut self, robot: &mut Robot<'_>, what: &str) {
        self.calls += 1;
        let drawn = robot.random().bits();
        let text = format!(
            "{what} {} {drawn}: {:?} {:?} {:?} {:?} {:?} {:?} {:?} {:?}",
            self.calls,
            robot.id(),
            robot.now(),
            robot.estimate(),
            robot.body(),
            robot.sensors(),
            robot.fleet(),
            robot.way_points(),
            robot.known_obstacles(),
        );
        robot.log(starl_core::event::Level::Info, text);
    }
}

impl Primitive for Reporter {
    fn port(&self) -> Port {
        Port::named("reporter")
    }

    fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) {
        self.report(robot, &format!("{input:?}"));
    }
}

/// Drives about, asks for paths, sends messages and arms timers, and reports all the while.
#[derive(Clone, Default, Primitives)]
struct Busy {
    reporter: Reporter,
}

impl Program for Busy {
    fn start(&mut self, robot: &mut Robot<'_>) {
        let target = Point::planar(2.0, 2.0);
        robot.plan(PlanRequest {
            ticket: 5,
            target,
            vicinity: 0.1,
            unsafe_set: robot.obstacles(),
            around_robots: false,
            planner: Planner::RrtConnect,
            most_nodes: 2_000,
            seed: 1,
        });
    }

    fn activate(&mut self, robot: &mut Robot<'_>) {
        let left = robot.random().between(-0.1, 0.3);
        robot.drive(Command::Wheels { left, right: 0.2 });
        if robot.random().chance(0.3) {
            robot.transmit(Destination::All, Port::PROGRAM, &self.reporter.calls);
        }
        self.reporter.report(robot, "activated");
    }

    fn receive(&mut self, robot: &mut Robot<'_>, message: &Message) {
        self.reporter.report(robot, &format!("{message:?}"));
    }

    fn corrupt(&mut self, random: &mut Random) {
        self.reporter.calls = u64::from(random.bits());
    }
}

/// Four robots with all sensors among obstacles, one of which vanishes and one of which is hidden.
fn crowded() -> Scenario {
    let places = [(0.0, 0.0), (0.3, 0.0), (0.0, 0.4), (1.0, 1.0)];
    let mut scenario = scenario("differential", &places);
    exact_delay(&mut scenario, 20);
    scenario.network.link.loss = 0.2;
    let group = &mut scenario.fleet.groups[0];
    group.sensors.bumper = true;
    group.sensors.proximity = Some(Proximity {
        rays: 8,
        range: 0.5,
    });
    group.sensors.detector = Some(Detector { range: 2.0 });
    group.sensors.discovery_range = 0.4;
    group.clock = Clock {
        offset: Duration::from_seconds(1),
        drift_ppm: 200.0,
    };
    scenario.positioning.position_noise = 0.01;
    let world = &mut scenario.world;
    world.things.push(Thing {
        name: "cup".into(),
        position: Point::planar(0.5, 0.5),
    });
    world.way_points.push(WayPoint {
        name: "A".into(),
        position: Point::planar(3.0, 3.0),
        group: 1,
    });
    world
        .obstacles
        .push(obstacle(Obstacle::circle(Point::planar(0.7, 0.0), 0.1)));
    let mut vanishing = obstacle(Obstacle::circle(Point::planar(0.0, 1.0), 0.2));
    vanishing.expires = moment(3.0);
    world.obstacles.push(vanishing);
    let mut hidden = obstacle(Obstacle::circle(Point::planar(0.5, 0.3), 0.05));
    hidden.hidden = true;
    world.obstacles.push(hidden);
    scenario
}

fn moment(seconds: f64) -> Time {
    Time::ZERO + Duration::from_seconds_f64(seconds)
}

fn fault(scenario: &mut Scenario, seconds: f64, kind: FaultKind) {
    let at = moment(seconds);
    scenario.faults.schedule.push(Fault { at, kind });
}

/// Replays all robots.
fn replay_all(scenario: Scenario, seconds: f64) -> Vec<Replay> {
    let mut simulation = simulate(scenario, Busy::default());
    let messages = recorded(&mut simulation, seconds);
    let robots = simulation.robots().iter();
    robots
        .map(|&robot| replay(&messages, robot, Box::new(Busy::default())))
        .collect()
}

#[test]
fn with_all_sensors() {
    let scenario = crowded();
    let mut simulation = simulate(scenario.clone(), Busy::default());
    let records = crate::engine_support::run(&mut simulation, 6.0);
    // The run has in it what is to be repeated.
    let said = |text: &str| {
        let of_event = |event: &starl_core::Event| format!("{event:?}").contains(text);
        crate::engine_support::count(&records, of_event)
    };
    for what in [
        "bumper: Some",
        "Detection",
        "Thing(0)",
        "nearness",
        "Planned { ticket: 5, path: Some",
        "Discovered",
        "Message {",
    ] {
        assert!(said(what) > 0, "{what}");
    }
    for replay in replay_all(scenario, 6.0) {
        assert_eq!((replay.lives, replay.corruptions), (1, 0));
        assert!(replay.entries > 100, "{replay:?}");
    }
}

#[test]
fn over_faults_of_all_kinds() {
    let mut scenario = crowded();
    let one = |robot| vec![RobotId(robot)];
    // In the middle of a step too, and before a robot that restarts has started.
    fault(&mut scenario, 1.0007, FaultKind::CorruptState(one(0)));
    fault(&mut scenario, 1.5, FaultKind::Crash(one(1)));
    fault(&mut scenario, 1.6, FaultKind::CorruptState(one(1)));
    fault(&mut scenario, 2.0003, FaultKind::Restart(one(1)));
    fault(&mut scenario, 2.0004, FaultKind::CorruptState(one(1)));
    fault(&mut scenario, 2.0005, FaultKind::CorruptState(one(1)));
    fault(&mut scenario, 2.1, FaultKind::FrozenSensor(one(2)));
    fault(&mut scenario, 3.1, FaultKind::Repair(one(2)));
    fault(&mut scenario, 3.2, FaultKind::StuckMotor(one(3)));
    fault(&mut scenario, 3.3, FaultKind::Crash(one(3)));
    let lives: Vec<(u32, u32)> = replay_all(scenario, 5.0)
        .iter()
        .map(|replay| (replay.lives, replay.corruptions))
        .collect();
    assert_eq!(lives, [(1, 1), (2, 2), (1, 0), (1, 0)]);
}

#[test]
fn at_any_number_of_threads_the_journal_is_the_same() {
    let places: Vec<(f64, f64)> = (0..300)
        .map(|i| (f64::from(i % 30), f64::from(i / 30)))
        .collect();
    let mut scenario = scenario("differential", &places);
    scenario.network.link.loss = 0.1;
    let mut one = simulate(scenario.clone(), Busy::default());
    let mut many = simulate(scenario, Busy::default());
    many.set_parallel(true);
    let recording = recorded(&mut one, 0.25);
    assert_eq!(recording, recorded(&mut many, 0.25));
    for robot in [0, 255, 256, 299] {
        replay(&recording, RobotId(robot), Box::new(Busy::default()));
    }
}

/// The digest is that of a run without a journal, and a journal that is not wanted is empty.
#[test]
fn a_journal_changes_nothing() {
    let mut with = simulate(crowded(), Busy::default());
    let mut without = simulate(crowded(), Busy::default());
    recorded(&mut with, 2.0);
    crate::engine_support::run(&mut without, 2.0);
    assert_eq!(with.digest(), without.digest());
    assert!(without.journal().entries().is_empty());
}

#[test]
fn entries_are_in_the_order_of_their_times() {
    let mut scenario = crowded();
    fault(
        &mut scenario,
        0.0155,
        FaultKind::CorruptState(vec![RobotId(3), RobotId(1)]),
    );
    let mut simulation = simulate(scenario, Busy::default());
    simulation.set_journal(true);
    let mut last = (Time::ZERO, RobotId(0));
    let mut entries = 0;
    for _ in 0..50 {
        simulation.step();
        for entry in simulation.journal().entries() {
            assert!(last <= (entry.at, entry.robot));
            last = (entry.at, entry.robot);
            entries += 1;
        }
    }
    assert!(entries > 20, "{entries}");
}

/// Robots that join have journals too, also the first of a shard.
#[test]
fn robots_that_join_are_replayed() {
    let places: Vec<(f64, f64)> = (0..255)
        .map(|i| (f64::from(i % 30), f64::from(i / 30)))
        .collect();
    let mut simulation = simulate(scenario("differential", &places), Busy::default());
    simulation.set_journal(true);
    for (x, milliseconds) in [(-5.0, 100), (-6.0, 300)] {
        let join = Intervention::Join {
            like: RobotId(0),
            name: format!("late at {x}"),
            pose: Pose::level(Point::planar(x, 0.0), 0.0),
        };
        let at = Time::ZERO + Duration::from_millis(milliseconds);
        simulation.apply(at, join).expect("there is room");
    }
    let recording = recorded(&mut simulation, 1.0);
    for robot in [0, 254, 255, 256] {
        let replay = replay(&recording, RobotId(robot), Box::new(Busy::default()));
        assert_eq!(replay.lives, 1, "robot {robot}");
        assert!(replay.entries > 5, "robot {robot}: {replay:?}");
    }
}
