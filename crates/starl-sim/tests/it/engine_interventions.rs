//! A run that is steered from outside: each intervention takes effect, is recorded, and can be repeated.

use crate::engine_support::{Wander, count, exact_delay, obstacle, run, scenario, simulate};
use crate::reading;
use starl_core::event::Value;
use starl_core::intervention::NetworkKnob;
use starl_core::{
    Command, ConvexPolygon, Duration, Event, FaultKind, Intervention, Obstacle, Order, Point, Pose,
    Primitives, Program, Record, Robot, RobotId, Time, WayPoint,
};
use starl_sim::engine::InterventionError;
use starl_sim::scenario::{Bounds, Occasion, ScenarioEvent};
use starl_sim::{Scenario, Simulation, write};

const R0: RobotId = RobotId(0);

fn at(millis: u64) -> Time {
    Time(millis * 1_000_000)
}

fn wall(x: f64) -> Obstacle {
    let low = Point::planar(x, -1.0);
    let high = Point::planar(x + 0.1, 1.0);
    Obstacle::polygon(ConvexPolygon::rectangle(low, high).expect("a rectangle"))
}

/// Reports its orders, and obeys them: an order `take` or `put_down` moves the gripper.
#[derive(Clone, Primitives)]
struct Listener;

impl Program for Listener {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        let holding = robot.sensors().holding.map_or(-1, i64::from);
        let way_points = robot.way_points().len() as i64;
        let obstacles = robot.obstacles().len() as i64;
        let fleet = robot.fleet().len() as i64;
        let fields = [
            ("holding", holding.into()),
            ("way_points", way_points.into()),
            ("obstacles", obstacles.into()),
            ("fleet", fleet.into()),
        ];
        robot.emit("state", fields);
    }

    fn told(&mut self, robot: &mut Robot<'_>, order: &Order) {
        match &*order.name {
            "take" => robot.take(0),
            "put_down" => robot.put_down(),
            "drive" => robot.drive(Command::Straight { speed: 0.2 }),
            _ => {}
        }
        robot.emit_fields(format!("told {}", order.name), order.fields.clone());
    }
}

fn tell(name: &'static str) -> Intervention {
    let (name, fields) = (name.into(), Default::default());
    Intervention::Tell {
        robots: vec![R0],
        order: Order { name, fields },
    }
}

fn told(records: &[Record], wanted: &str) -> Vec<(Time, RobotId)> {
    let told = records.iter().filter_map(|record| match &record.event {
        Event::Program { name, .. } if name == wanted => Some((record.at, record.robot?)),
        _ => None,
    });
    told.collect()
}

/// The last value of a field that a robot has reported of itself.
fn state(records: &[Record], robot: RobotId, field: &str) -> i64 {
    let of_robot = records
        .iter()
        .rev()
        .filter(|record| record.robot == Some(robot));
    let value = of_robot.filter_map(|record| match &record.event {
        Event::Program { name, fields } if name == "state" => fields
            .iter()
            .find(|(name, _)| name == field)
            .map(|(_, value)| value.clone()),
        _ => None,
    });
    match value.into_iter().next() {
        Some(starl_core::Value::Int(number)) => number,
        other => panic!("{field} is {other:?}"),
    }
}

fn pair() -> Scenario {
    let mut scenario = scenario("create", &[(0.0, 0.0), (5.0, 0.0)]);
    exact_delay(&mut scenario, 10);
    scenario
}

fn listeners() -> Simulation {
    simulate(pair(), Listener)
}

#[test]
fn an_order_is_heard_at_its_time_by_the_robots_it_is_for() {
    let mut simulation = listeners();
    simulation
        .apply(at(1013), tell("drive"))
        .expect("it is fine");
    let records = run(&mut simulation, 2.0);
    assert_eq!(told(&records, "told drive"), [(at(1013), R0)]);
    assert!(simulation.state(R0).pose.position.x > 0.1);
    assert_eq!(simulation.state(RobotId(1)).pose.position.x, 5.0);
}

#[test]
fn a_robot_that_is_down_hears_no_order() {
    let mut simulation = listeners();
    let crash = Intervention::Fault(FaultKind::Crash(vec![R0]));
    let restart = Intervention::Fault(FaultKind::Restart(vec![R0]));
    for (millis, what) in [(500, crash), (1000, tell("drive")), (1500, restart)] {
        simulation.apply(at(millis), what).expect("it is fine");
    }
    assert_eq!(told(&run(&mut simulation, 3.0), "told drive"), []);
}

#[test]
fn programs_are_notified_of_new_waypoints() {
    let mut simulation = listeners();
    let way_point = |x| {
        Intervention::SetWayPoint(WayPoint {
            name: "A".into(),
            position: Point::planar(x, 0.0),
            group: 0,
        })
    };
    simulation
        .apply(at(1000), way_point(1.0))
        .expect("it is fine");
    simulation
        .apply(at(2000), way_point(2.0))
        .expect("it is fine");
    let records = run(&mut simulation, 3.0);
    assert_eq!(told(&records, "told way_points").len(), 4);
    assert_eq!(state(&records, R0, "way_points"), 1);
    let name = "A".to_string();
    let remove = Intervention::RemoveWayPoint { name };
    simulation
        .apply(simulation.now(), remove)
        .expect("it is fine");
    assert_eq!(state(&run(&mut simulation, 1.0), R0, "way_points"), 0);
}

#[test]
fn a_push_moves_a_body_until_something_is_in_the_way() {
    let mut scenario = pair();
    scenario.world.obstacles.push(obstacle(wall(2.0)));
    let mut simulation = simulate(scenario, Listener);
    let push = |x: f64| Intervention::Push {
        robot: R0,
        by: Point::planar(x, 0.0),
    };
    simulation.apply(at(100), push(1.0)).expect("it is fine");
    run(&mut simulation, 0.5);
    assert!((simulation.state(R0).pose.position.x - 1.0).abs() < 1e-9);
    simulation.apply(at(600), push(8.0)).expect("it is fine");
    let records = run(&mut simulation, 0.5);
    let x = simulation.state(R0).pose.position.x;
    assert!(x < 2.0 - 0.16, "it stands in the wall, at {x}");
    assert_eq!(
        count(&records, |event| matches!(event, Event::Collided { .. })),
        0
    );
}

#[test]
fn obstacles_appear_stop_bodies_move_and_vanish() {
    let mut simulation = listeners();
    let add = Intervention::AddObstacle {
        obstacle: wall(1.0),
        hidden: false,
    };
    simulation.apply(at(0), add).expect("it is fine");
    simulation
        .apply(at(100), tell("drive"))
        .expect("it is fine");
    let records = run(&mut simulation, 10.0);
    assert_eq!(state(&records, R0, "obstacles"), 1);
    let x = simulation.state(R0).pose.position.x;
    assert!(x > 0.7 && x < 1.0 - 0.16, "the wall stops it, at {x}");
    let remove = Intervention::RemoveObstacle { index: 0 };
    simulation
        .apply(simulation.now(), remove)
        .expect("it is fine");
    let records = run(&mut simulation, 10.0);
    assert_eq!(state(&records, R0, "obstacles"), 0);
    assert!(simulation.state(R0).pose.position.x > 2.0);
}

#[test]
fn walls_around_the_world_keep_their_indices_when_obstacles_appear() {
    let mut scenario = pair();
    scenario.world.bounds = Some(Bounds {
        low: Point::planar(-1.0, -1.0),
        high: Point::planar(6.0, 1.0),
    });
    let mut simulation = simulate(scenario, Listener);
    let obstacle = wall(2.0);
    let add = Intervention::AddObstacle {
        obstacle: obstacle.clone(),
        hidden: false,
    };
    simulation.apply(at(0), add).expect("it is fine");
    run(&mut simulation, 0.1);
    let index = 4;
    let none = simulation.apply(simulation.now(), Intervention::RemoveObstacle { index: 0 });
    assert_eq!(none, Err(InterventionError::NoObstacle(0)));
    let moved = Intervention::MoveObstacle { index, obstacle };
    assert_eq!(simulation.apply(simulation.now(), moved), Ok(()));
}

#[test]
fn a_thing_is_taken_only_within_reach_and_by_one_robot_and_travels_with_it() {
    let mut simulation = listeners();
    let thing = |x| Intervention::SetThing {
        name: "parcel".into(),
        position: Point::planar(x, 0.0),
    };
    simulation.apply(at(0), thing(1.0)).expect("it is fine");
    simulation.apply(at(100), tell("take")).expect("it is fine");
    assert_eq!(state(&run(&mut simulation, 1.0), R0, "holding"), -1);
    simulation.apply(at(1000), thing(0.2)).expect("it is fine");
    simulation
        .apply(at(1100), tell("take"))
        .expect("it is fine");
    simulation
        .apply(at(1200), tell("drive"))
        .expect("it is fine");
    let records = run(&mut simulation, 4.0);
    assert_eq!(state(&records, R0, "holding"), 0);
    assert_eq!(count(&records, |event| *event == Event::Took(0)), 1);
    let (_, place, holder) = simulation.things().next().expect("a thing");
    assert_eq!(holder, Some(R0));
    assert_eq!(place, simulation.state(R0).pose.position);
    simulation
        .apply(simulation.now(), tell("put_down"))
        .expect("it is fine");
    assert_eq!(state(&run(&mut simulation, 1.0), R0, "holding"), -1);
    let (_, place, holder) = simulation.things().next().expect("a thing");
    assert_eq!(holder, None);
    assert!(place.x > 0.4, "it lies at {place:?}");
}

#[test]
fn the_network_changes_from_one_moment_to_the_next() {
    let mut simulation = simulate(pair(), Wander::default());
    run(&mut simulation, 2.0);
    let before = simulation.tally();
    assert_eq!(before.lost, 0);
    let deaf = Intervention::Network(vec![NetworkKnob::Loss(1.0)]);
    simulation
        .apply(simulation.now(), deaf)
        .expect("it is fine");
    run(&mut simulation, 2.0);
    let after = simulation.tally();
    assert!(after.sent > before.sent + 5);
    assert_eq!(after.lost, after.sent - before.sent);
}

#[test]
fn robots_join_and_leave() {
    let mut simulation = listeners();
    let join = |x| Intervention::Join {
        like: R0,
        name: "late".into(),
        pose: Pose::level(Point::planar(x, 0.0), 0.0),
    };
    let taken = simulation.apply(at(0), join(0.1));
    assert_eq!(taken, Err(InterventionError::Occupied));
    simulation.apply(at(1000), join(2.0)).expect("it is fine");
    let records = run(&mut simulation, 2.0);
    let late = RobotId(2);
    for robot in [R0, RobotId(1), late] {
        assert_eq!(state(&records, robot, "fleet"), 3);
    }
    assert_eq!(simulation.scenario().fleet.name(late), "late");
    let leave = Intervention::Leave(vec![late]);
    simulation
        .apply(simulation.now(), leave)
        .expect("it is fine");
    simulation
        .apply(simulation.now(), tell("drive"))
        .expect("it is fine");
    let records = run(&mut simulation, 20.0);
    assert!(simulation.has_left(late) && simulation.progress().up == 2);
    let x = simulation.state(R0).pose.position.x;
    assert!(x > 2.0, "it is stopped at {x}");
    assert_eq!(
        count(&records, |event| matches!(event, Event::Collided { .. })),
        0
    );
    let join = join(2.0);
    simulation
        .apply(simulation.now(), join)
        .expect("the place is free");
}

#[test]
fn impossible_interventions_are_rejected_with_a_reason_and_change_nothing() {
    let mut simulation = listeners();
    let digest = simulation.digest();
    let loss = Intervention::Network(vec![NetworkKnob::Loss(1.5)]);
    let nobody = Intervention::Fault(FaultKind::Crash(vec![RobotId(7)]));
    let name = || "C".to_string();
    for (what, expected) in [
        (
            loss,
            "a number in it is not finite or out of its range, a name is blank, or it names no robot, or one twice",
        ),
        (nobody, "there is no robot 7; the fleet has 2"),
        (
            Intervention::RemoveThing { name: name() },
            "there is no thing C",
        ),
        (
            Intervention::RemoveWayPoint { name: name() },
            "there is no waypoint C",
        ),
    ] {
        let refused = simulation.apply(at(0), what).expect_err(expected);
        assert_eq!(refused.to_string(), expected);
    }
    assert_eq!(simulation.digest(), digest);
    // A missing target of a later intervention causes a warning.
    let later = Intervention::RemoveThing { name: name() };
    simulation
        .apply(at(1000), later)
        .expect("it may be there then");
    let warns = |event: &Event| matches!(event, Event::Log { .. });
    assert_eq!(count(&run(&mut simulation, 2.0), warns), 1);
}

/// Steers a run by one of everything.
fn steer(simulation: &mut Simulation) -> Vec<Record> {
    let mut records = run(simulation, 1.0);
    let now = simulation.now();
    let pose = Pose::level(Point::planar(2.0, 2.0), 0.0);
    let name = "late".to_string();
    for what in [
        Intervention::Fault(FaultKind::Partition(vec![vec![R0]])),
        Intervention::Network(vec![NetworkKnob::Loss(0.3)]),
        Intervention::Join {
            like: R0,
            name,
            pose,
        },
        Intervention::Push {
            robot: R0,
            by: Point::planar(0.0, 0.5),
        },
        Intervention::AddObstacle {
            obstacle: wall(1.0),
            hidden: true,
        },
    ] {
        simulation.apply(now, what).expect("it is fine");
    }
    records.extend(run(simulation, 1.0));
    let now = simulation.now();
    for what in [
        Intervention::Fault(FaultKind::Heal),
        Intervention::Fault(FaultKind::CorruptState(vec![R0])),
        Intervention::Leave(vec![RobotId(1)]),
    ] {
        simulation.apply(now, what).expect("it is fine");
    }
    records.extend(run(simulation, 1.0));
    let now = simulation.now();
    for (count, what) in (0..).zip(orders()) {
        let at = now + Duration::from_millis(10 * count);
        simulation.apply(at, what).expect("it is fine");
    }
    records.extend(run(simulation, 2.0));
    records
}

/// Interventions that programs hear of or that concern robots of the same name, one after the other.
fn orders() -> Vec<Intervention> {
    let late = RobotId(2);
    let fields = [
        ("text", Value::Text("go \"home\"".into())),
        ("number in words", Value::Text("5s".into())),
        ("for", Value::Time(at(5))),
        ("to", Value::Point(Point::new(0.1, -0.2, -0.0))),
        ("whole", Value::Float(3.0)),
        ("count", Value::Int(-3)),
        ("flag", Value::Bool(true)),
        ("robot", Value::Robot(late)),
        ("robots", Value::Robots(vec![late, R0])),
    ];
    let fields = fields.map(|(name, value)| (name.into(), value));
    let order = Order {
        name: "go".into(),
        fields: fields.into_iter().collect(),
    };
    let way_point = WayPoint {
        name: "A".into(),
        position: Point::planar(1.0, 0.3),
        group: 2,
    };
    let name = || "cup".to_string();
    let position = Point::planar(0.1, 0.2);
    let obstacle = Obstacle::circle(position * 30.0, 0.25);
    vec![
        Intervention::Tell {
            robots: vec![late, R0, late],
            order,
        },
        Intervention::SetWayPoint(way_point),
        Intervention::RemoveWayPoint { name: "A".into() },
        Intervention::SetThing {
            name: name(),
            position,
        },
        Intervention::RemoveThing { name: name() },
        Intervention::MoveObstacle { index: 0, obstacle },
        Intervention::RemoveObstacle { index: 0 },
        Intervention::Network(vec![
            NetworkKnob::Range(Some(3.0)),
            NetworkKnob::Delay(Duration::from_millis(20)),
            NetworkKnob::Range(None),
        ]),
        Intervention::Leave(vec![late]),
        // Another of the same name, and an event of the one that has left.
        Intervention::Join {
            like: R0,
            name: "late".into(),
            pose: Pose::level(Point::planar(2.5, 3.0), 0.7),
        },
        Intervention::Fault(FaultKind::Repair(vec![late])),
    ]
}

#[test]
fn the_scenario_of_a_steered_run_goes_as_the_run_went() {
    let mut steered = simulate(pair(), Wander::default());
    let records = steer(&mut steered);
    let mut again = simulate(steered.as_scenario(), Wander::default());
    assert_eq!(run(&mut again, 5.0), records);
    assert_eq!(again.digest(), steered.digest());
    let text = write::scenario(&steered.as_scenario());
    let read = reading::read(&text, &[]).unwrap_or_else(|problems| panic!("{problems}\n{text}"));
    let mut from_file = simulate(read.scenario, Wander::default());
    assert_eq!(run(&mut from_file, 5.0), records, "{text}");
    assert_eq!(from_file.digest(), steered.digest());
    let mut left_alone = simulate(pair(), Wander::default());
    run(&mut left_alone, 5.0);
    assert_ne!(left_alone.digest(), steered.digest());
}

#[test]
fn equal_interventions_on_a_snapshot_give_equal_runs() {
    let mut original = simulate(pair(), Wander::default());
    run(&mut original, 2.5);
    let mut copy = original.clone();
    let records = steer(&mut original);
    assert_eq!(steer(&mut copy), records);
    assert_eq!(copy.digest(), original.digest());
}

#[test]
fn the_seed_decides_times_and_places_of_events_at_a_rate() {
    let mut scenario = pair();
    scenario.events.push(ScenarioEvent {
        occasion: Occasion::Rate {
            per_second: 1.0,
            within: Some(Bounds {
                low: Point::planar(10.0, 0.0),
                high: Point::planar(20.0, 10.0),
            }),
        },
        what: Intervention::SetThing {
            name: "task".into(),
            position: Point::ZERO,
        },
    });
    let things = |seed| {
        let mut simulation = simulate(
            Scenario {
                seed,
                ..scenario.clone()
            },
            Listener,
        );
        run(&mut simulation, 30.0);
        let things = simulation.things();
        let things: Vec<(String, Point)> = things
            .map(|(name, place, _)| (name.to_string(), place))
            .collect();
        things
    };
    let found = things(1);
    assert!((15..50).contains(&found.len()), "{} things", found.len());
    assert_eq!(found[3].0, "task3");
    assert!(
        found
            .iter()
            .all(|(_, place)| (10.0..20.0).contains(&place.x))
    );
    assert_eq!(things(1), found);
    assert_ne!(things(2), found);
}
