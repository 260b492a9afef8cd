//! Clocks that are hours apart do not lose writes: a robot that knew a write when it wrote wins over
//! it. Of writes without knowledge of each other all robots take the one with the later clock, then the
//! one of the greater number.

use crate::harness::sharer::{Sharer, memory, read, write};
use crate::harness::{Wire, World};
use starl_core::{Duration, Time};
use starl_primitives::shared_memory::Options;

/// Until a write has been sent, 1 ms, and has arrived everywhere.
const DATAGRAM: Duration = Duration::from_millis(2);
const HOUR: i64 = 3_600_000_000_000;

fn world(seed: u64, wire: Wire, ahead: [i64; 3]) -> World {
    let mut world = World::new(0, seed, wire, None, Sharer::boxed(Options::default()));
    for nanos in ahead {
        let robot = world.add();
        world.set_clock_ahead(robot, nanos);
        world.begin(robot);
    }
    world
}

#[test]
fn a_later_write_by_a_slower_clock_wins() {
    for seed in 0..20 {
        let mut world = world(seed, Wire::bad(), [0, 5 * HOUR, 48 * HOUR]);
        for round in 0..30 {
            let robot = [2, 0, 1][round as usize % 3];
            let before = memory(&world, robot).stamp("x0");
            world.command(robot, write(0, round));
            assert!(memory(&world, robot).stamp("x0") > before);
            world.run_for(Duration::from_seconds(15));
            for robot in 0..3 {
                assert_eq!(read(&world, robot, 0), Some(round), "seed {seed}");
            }
        }
    }
}

#[test]
fn an_unknown_concurrent_write_may_win() {
    let mut world = world(1, Wire::perfect(), [0, HOUR, 0]);
    world.wire.loss = 1.0;
    world.command(1, write(0, 1));
    world.run_for(Duration::from_millis(50));
    world.command(0, write(0, 2));
    world.run_for(Duration::from_millis(1));
    world.wire.loss = 0.0;
    world.run_for(Duration::from_seconds(5));
    for robot in 0..3 {
        assert_eq!(read(&world, robot, 0), Some(1));
    }
    // Now that it knows it, it does not.
    world.command(0, write(0, 3));
    world.run_for(DATAGRAM);
    for robot in 0..3 {
        assert_eq!(read(&world, robot, 0), Some(3));
    }
}

#[test]
fn of_writes_at_the_same_time_that_of_the_greatest_number_wins() {
    for order in [[0, 1, 2], [2, 1, 0], [1, 2, 0]] {
        let mut world = world(1, Wire::perfect(), [0; 3]);
        world.run_for(Duration::from_seconds(1));
        for robot in order {
            world.command(robot, write(0, robot as u32));
        }
        world.run_for(DATAGRAM);
        for robot in 0..3 {
            assert_eq!(read(&world, robot, 0), Some(2));
        }
    }
}

#[test]
fn the_clock_goes_no_further_ahead_than_the_fastest() {
    let mut world = world(1, Wire::perfect(), [0, HOUR, 0]);
    for round in 0..2000 {
        world.command(round % 3, write(0, round as u32));
        world.run_for(Duration::from_millis(2));
        let stamp = memory(&world, round % 3).stamp("x0").unwrap();
        assert!(stamp.time <= Time(world.now.0 + HOUR as u64));
        assert!(stamp.count < 10, "{stamp:?}");
    }
}

#[test]
fn clocks_beyond_all_reason_do_no_harm() {
    let mut world = world(1, Wire::perfect(), [0, i64::MAX, 0]);
    world.set_clock_ahead(1, i64::MAX);
    for round in 0..30 {
        let robot = round % 3;
        world.command(robot, write(0, round as u32));
        world.run_for(Duration::from_millis(5));
        for robot in 0..3 {
            assert_eq!(read(&world, robot, 0), Some(round as u32));
        }
    }
}
