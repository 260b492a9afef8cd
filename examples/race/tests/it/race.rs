//! Race on a small host whose robots move as they like: the first to arrive tells the others, and all
//! finish.

use crate::harness::{Wire, World, int};
use starl_core::{Duration, Event, Point, RobotId, Time, WayPoint};
use starl_race::Race;

const PERIOD: Option<Duration> = Some(Duration::from_millis(100));

fn race(robots: usize, seed: u64, wire: Wire) -> World {
    let mut world = World::new(robots, seed, wire, PERIOD, || Box::new(Race::default()));
    let way_point = |(name, x, y): (&str, f64, f64)| WayPoint {
        name: name.into(),
        position: Point::planar(x, y),
        group: 0,
    };
    let places = [
        ("A", 2.0, 0.0),
        ("B", 2.0, 3.0),
        ("C", 0.0, 3.0),
        ("D", 0.0, 1.0),
    ];
    world.way_points = places.map(way_point).into();
    world
}

fn finished(world: &World) -> usize {
    world
        .records
        .iter()
        .filter(|(_, _, event)| *event == Event::Finished)
        .count()
}

fn indices(world: &World, name: &str, robot: u32) -> Vec<i64> {
    let events = world.events(name);
    events
        .iter()
        .filter(|event| event.1.0 == robot)
        .map(|event| int(&event.2["index"]))
        .collect()
}

/// The waypoints that a robot arrived at or was told of, in the order of time.
fn steps(world: &World, robot: u32) -> Vec<i64> {
    let step = |(_, id, event): &(Time, RobotId, Event)| match event {
        Event::Program { fields, .. } if id.0 == robot => Some(int(&fields[0].1)),
        _ => None,
    };
    world.records.iter().filter_map(step).collect()
}

#[test]
fn the_fastest_arrives_everywhere_and_the_others_are_told() {
    let mut world = race(4, 1, Wire::perfect());
    world.run_for(Duration::from_seconds(60));
    assert_eq!(indices(&world, "arrived", 3), [0, 1, 2, 3]);
    for robot in 0..3 {
        assert_eq!(indices(&world, "arrived", robot), []);
        assert_eq!(indices(&world, "told", robot), [0, 1, 2, 3]);
    }
    assert_eq!(finished(&world), 4);
}

#[test]
fn all_finish_over_a_bad_wire_and_no_robot_goes_back() {
    for seed in 0..100 {
        let mut world = race(6, seed, Wire::bad());
        world.run_for(Duration::from_seconds(60));
        assert_eq!(finished(&world), 6, "seed {seed}");
        for robot in 0..6 {
            let steps = steps(&world, robot);
            assert!(
                steps.windows(2).all(|pair| pair[0] < pair[1]),
                "seed {seed}: {steps:?}"
            );
            assert_eq!(steps.last(), Some(&3), "seed {seed}");
        }
    }
}

#[test]
fn a_robot_that_hears_nothing_runs_the_whole_way() {
    let mut world = race(3, 1, Wire::perfect());
    for other in [1, 2] {
        world.wire.cut.insert((other, 0));
        world.wire.cut.insert((0, other));
    }
    world.run_for(Duration::from_seconds(60));
    assert_eq!(indices(&world, "arrived", 0), [0, 1, 2, 3]);
    assert_eq!(finished(&world), 3);
}

#[test]
fn what_a_finished_robot_said_last_still_gets_through() {
    let mut world = race(2, 1, Wire::perfect());
    while finished(&world) == 0 {
        assert!(world.now.seconds() < 60.0);
        // Cut the wire just before the last message.
        if indices(&world, "arrived", 1).len() == 3 {
            world.wire.cut.insert((1, 0));
        }
        world.run_for(Duration::from_millis(10));
    }
    let at = world.now;
    assert_eq!(indices(&world, "told", 0), [0, 1, 2]);
    world.wire.cut.clear();
    world.run_for(Duration::from_millis(400));
    assert_eq!(indices(&world, "told", 0), [0, 1, 2, 3], "after {at}");
    assert_eq!(finished(&world), 2);
}

#[test]
fn a_restarted_robot_runs_again_and_a_dead_one_blocks_no_robot() {
    let mut world = race(4, 1, Wire::perfect());
    world.crash(3);
    world.run_for(Duration::from_seconds(8));
    world.crash(2);
    world.start(2);
    world.run_for(Duration::from_seconds(100));
    assert_eq!(finished(&world), 3);
}

#[test]
fn it_finishes_after_its_variables_are_overwritten() {
    for seed in 0..200 {
        let mut world = race(3, seed, Wire::bad());
        world.run_for(Duration::from_millis(seed * 53 % 9_000));
        (0..3).for_each(|robot| world.corrupt(robot));
        world.run_for(Duration::from_seconds(60));
        assert!(finished(&world) >= 3, "seed {seed}");
    }
}
