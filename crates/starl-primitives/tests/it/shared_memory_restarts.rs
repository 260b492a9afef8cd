//! A robot that restarts, or joins late, learns the written values; and its writes are later than those of its earlier
//! life, even if its clock is reset.

use crate::harness::sharer::{Sharer, all, memory, read, read_of, write, write_own};
use crate::harness::{Wire, World};
use starl_core::Duration;
use starl_primitives::shared_memory::{Options, Stamp};

fn world(seed: u64, wire: Wire) -> World {
    World::new(3, seed, wire, None, Sharer::boxed(Options::default()))
}

#[test]
fn a_restarted_robot_learns_its_own_and_other_writes() {
    for seed in 0..20 {
        let mut world = world(seed, Wire::bad());
        world.command(0, write_own(0, 1));
        world.command(1, write(0, 2));
        world.run_for(Duration::from_seconds(20));
        world.crash(0);
        world.command(2, write_own(0, 3));
        world.run_for(Duration::from_seconds(20));
        world.start(0);
        assert_eq!(read_of(&world, 0, 0, 0), None);
        world.run_for(Duration::from_seconds(20));
        assert_eq!(all(&world, 0, 0), [(0, 1), (2, 3)], "seed {seed}");
        assert_eq!(read(&world, 0, 0), Some(2), "seed {seed}");
    }
}

#[test]
fn writes_after_a_restart_win_despite_a_reset_clock() {
    for seed in 0..20 {
        for wire in [Wire::perfect(), Wire::bad()] {
            let mut world = world(seed, wire);
            world.run_for(Duration::from_seconds(1000));
            world.command(0, write_own(0, 1));
            world.command(0, write(0, 2));
            world.run_for(Duration::from_seconds(20));
            world.crash(0);
            world.set_clock_ahead(0, -(world.now.0 as i64));
            world.start(0);
            world.command(0, write_own(0, 11));
            world.command(0, write(0, 12));
            world.run_for(Duration::from_seconds(20));
            for robot in 0..3 {
                assert_eq!(read_of(&world, robot, 0, 0), Some(11), "seed {seed}");
                assert_eq!(read(&world, robot, 0), Some(12), "seed {seed}");
            }
            assert!(!world.events("write_again").is_empty());
        }
    }
}

#[test]
fn with_a_continuing_clock_nothing_is_written_again() {
    let mut world = world(1, Wire::perfect());
    world.command(0, write_own(0, 1));
    world.run_for(Duration::from_seconds(20));
    world.crash(0);
    world.start(0);
    world.command(0, write_own(0, 11));
    world.run_for(Duration::from_seconds(20));
    assert_eq!(read_of(&world, 2, 0, 0), Some(11));
    assert_eq!(world.events("write_again"), []);
}

#[test]
fn a_robot_that_joins_late_reads_everything_within_two_seconds() {
    for seed in 0..20 {
        let mut world = world(seed, Wire::perfect());
        world.crash(2);
        for array in 0..10 {
            world.command(0, write_own(array, 1));
            world.command(1, write(array, 2));
        }
        world.run_for(Duration::from_seconds(300));
        world.start(2);
        world.run_for(Duration::from_seconds(2));
        for variable in 0..10 {
            assert_eq!(read_of(&world, 2, variable, 0), Some(1), "seed {seed}");
            assert_eq!(read(&world, 2, variable), Some(2), "seed {seed}");
        }
    }
}

#[test]
fn values_known_only_to_a_crashed_robot_are_lost() {
    let mut world = world(1, Wire::perfect());
    world.wire.loss = 1.0;
    world.command(0, write(0, 1));
    world.run_for(Duration::from_millis(1));
    world.crash(0);
    world.wire.loss = 0.0;
    world.start(0);
    world.run_for(Duration::from_seconds(20));
    for robot in 0..3 {
        assert_eq!(read(&world, robot, 0), None);
    }
}

/// It reads an old write of its own and writes the same again. A later one of its own, from before the
/// crash, that comes after that counts as earlier.
#[test]
fn writing_the_read_value_after_a_restart_is_a_write() {
    let mut world = world(1, Wire::perfect());
    world.wire.cut.extend([(0, 2), (1, 2), (2, 1)]);
    world.command(0, write_own(0, 1));
    world.run_for(Duration::from_seconds(5));
    world.wire.cut.clear();
    world.wire.cut.extend([(0, 1), (1, 2), (2, 1)]);
    world.command(0, write_own(0, 2));
    world.run_for(Duration::from_seconds(5));
    world.crash(0);
    world.wire.cut.clear();
    world.wire.cut.extend([(0, 2), (2, 0), (1, 2), (2, 1)]);
    world.set_clock_ahead(0, -(world.now.0 as i64));
    world.start(0);
    world.run_for(Duration::from_seconds(5));
    assert_eq!(read_of(&world, 0, 0, 0), Some(1));
    world.command(0, write_own(0, 1));
    world.run_for(Duration::from_seconds(5));
    assert_eq!(read_of(&world, 2, 0, 0), Some(2));
    world.wire.cut.clear();
    world.run_for(Duration::from_seconds(10));
    for robot in 0..3 {
        assert_eq!(read_of(&world, robot, 0, 0), Some(1));
    }
}

/// In both of its lives a robot whose clock is behind receives the same reading of another clock, and continues from
/// there. The first life's write is known to one robot, which the second life does not hear.
#[test]
fn two_lives_that_continue_from_one_reading_have_different_stamps() {
    let mut world = world(1, Wire::perfect());
    world.set_clock_ahead(1, 3_600_000_000_000);
    world.command(1, write(0, 1));
    world.run_for(Duration::from_seconds(5));
    world.crash(1);
    let told = memory(&world, 2).stamp("x0");
    let write_in_a_life = |world: &mut World, value| {
        world.command(0, write(0, value));
        memory(world, 0).stamp("x0").expect("it has just written")
    };
    world.join();
    world.run_for(Duration::from_seconds(5));
    world.wire.cut.extend([(0, 2), (2, 3), (3, 2)]);
    let first = write_in_a_life(&mut world, 9);
    world.run_for(Duration::from_seconds(1));
    world.crash(0);
    world.wire.cut.remove(&(0, 2));
    world.wire.cut.extend([(0, 3), (3, 0)]);
    world.start(0);
    world.run_for(Duration::from_seconds(5));
    assert_eq!(memory(&world, 0).stamp("x0"), told);
    let second = write_in_a_life(&mut world, 2);
    let clock = |stamp: Stamp| (stamp.time, stamp.count, stamp.writer);
    assert_eq!(clock(first), clock(second));
    assert_ne!(first, second);
    world.wire.cut.clear();
    world.run_for(Duration::from_seconds(20));
    for robot in [0, 2, 3] {
        assert_eq!(read(&world, robot, 0), Some(2));
    }
}
