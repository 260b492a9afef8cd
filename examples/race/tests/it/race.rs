//! Race on a small host whose robots move as they like: the first to arrive tells the others, and all
//! finish.

use crate::harness::{Wire, World};
use starl_core::{Duration, Event, Point, WayPoint};
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

/// At how many waypoints a robot has arrived itself.
fn arrivals(world: &World, robot: u32) -> usize {
    let arrived = Event::Action("wait".into());
    let records = world.records.iter();
    records
        .filter(|(_, id, event)| id.0 == robot && *event == arrived)
        .count()
}

/// The waypoint that a robot goes to, counted from 0.
fn index(world: &World, robot: usize) -> u32 {
    world.inspect::<Race>(robot).current_index()
}

#[test]
fn the_fastest_arrives_everywhere_and_the_others_follow() {
    let mut world = race(4, 1, Wire::perfect());
    world.run_for(Duration::from_seconds(60));
    assert_eq!((arrivals(&world, 3), index(&world, 3)), (4, 4));
    for robot in 0..3 {
        let told = (arrivals(&world, robot), index(&world, robot as usize));
        assert_eq!(told, (0, 4));
    }
    assert_eq!(finished(&world), 4);
}

#[test]
fn all_finish_over_a_bad_wire_and_no_robot_goes_back() {
    for seed in 0..100 {
        let mut world = race(6, seed, Wire::bad());
        let mut before = [0; 6];
        while world.now.seconds() < 60.0 {
            world.run_for(Duration::from_millis(100));
            for (robot, before) in before.iter_mut().enumerate() {
                let now = index(&world, robot);
                assert!(*before <= now, "seed {seed}: from {before} to {now}");
                *before = now;
            }
        }
        assert_eq!(finished(&world), 6, "seed {seed}");
        assert_eq!(before, [4; 6], "seed {seed}");
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
    assert_eq!(arrivals(&world, 0), 4);
    assert_eq!(finished(&world), 3);
}

#[test]
fn the_last_message_of_a_finished_robot_still_arrives() {
    let mut world = race(2, 1, Wire::perfect());
    while finished(&world) == 0 {
        assert!(world.now.seconds() < 60.0);
        // Cut the wire just before the last message.
        if arrivals(&world, 1) == 3 {
            world.wire.cut.insert((1, 0));
        }
        world.run_for(Duration::from_millis(10));
    }
    let at = world.now;
    assert_eq!((arrivals(&world, 0), index(&world, 0)), (0, 3));
    world.wire.cut.clear();
    world.run_for(Duration::from_millis(400));
    assert_eq!(
        (arrivals(&world, 0), index(&world, 0)),
        (0, 4),
        "after {at}"
    );
    assert_eq!(finished(&world), 2);
}

#[test]
fn a_restarted_robot_runs_again_and_a_crashed_one_blocks_no_robot() {
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
