//! The cost of shared memory: little while nothing changes, however many robots there are; datagrams
//! of bounded length, however many variables.

use crate::harness::sharer::{Sharer, memory, read, write, write_many, write_own};
use crate::harness::{Wire, World};
use starl_core::Duration;
use starl_primitives::shared_memory::Options;

fn world(robots: usize, seed: u64, wire: Wire) -> World {
    World::new(robots, seed, wire, None, Sharer::boxed(Options::default()))
}

#[test]
fn quiet_memories_have_little_traffic_independent_of_the_fleet_size() {
    for robots in [2, 10, 50] {
        let mut world = world(robots, 1, Wire::perfect());
        world.command(0, write(0, 1));
        world.run_for(Duration::from_seconds(60));
        let (sent, bytes) = (world.sent_count(), world.sent_bytes());
        world.run_for(Duration::from_seconds(600));
        let rate = (world.sent_count() - sent) as f64 / 600.0;
        // Two in every half of four seconds, and those that cross.
        assert!(rate < 0.9, "{robots} robots: {rate} datagrams a second");
        assert!(rate > 0.1);
        assert!((world.sent_bytes() - bytes) < 22 * (world.sent_count() - sent));
    }
}

#[test]
fn many_variables_go_in_datagrams_that_a_network_carries() {
    for (count, seed) in [(50, 1), (3000, 2)] {
        let mut world = world(3, seed, Wire::bad());
        world.crash(2);
        world.command(0, write_many(count));
        world.run_for(Duration::from_seconds(60));
        world.start(2);
        world.run_for(Duration::from_seconds(60));
        for robot in 0..3 {
            for variable in 0..count {
                assert_eq!(read(&world, robot, variable as u16), Some(variable));
            }
        }
        let longest = world.sent().map(|sent| sent.payload.len()).max();
        assert!(longest <= Some(1200), "{longest:?}");
    }
}

#[test]
fn one_lost_write_among_thousands_is_found_in_few_datagrams() {
    let mut world = world(2, 3, Wire::perfect());
    world.command(0, write_many(5000));
    world.run_for(Duration::from_seconds(60));
    world.wire.loss = 1.0;
    world.command(0, write(77, 1));
    world.run_for(Duration::from_millis(1));
    world.wire.loss = 0.0;
    let (sent, bytes) = (world.sent_count(), world.sent_bytes());
    world.run_for(Duration::from_seconds(3));
    assert_eq!(read(&world, 1, 77), Some(1));
    assert!(
        world.sent_count() - sent <= 20,
        "{}",
        world.sent_count() - sent
    );
    assert!(
        world.sent_bytes() - bytes <= 4000,
        "{}",
        world.sent_bytes() - bytes
    );
}

#[test]
fn a_busy_memory_is_compared_seldom() {
    let mut world = world(20, 4, Wire::perfect());
    world.wire.delay_ms = (5, 50);
    let mut writes = 0;
    for step in 0..600u32 {
        for robot in 0..20 {
            if step % 10 == robot % 10 {
                world.command(robot as usize, write_own(0, step));
                writes += 1;
            }
        }
        world.run_for(Duration::from_millis(100));
    }
    let others = world.sent_count() - writes;
    assert!(
        others * 2 < writes,
        "{others} datagrams beside {writes} writes"
    );
    assert!(memory(&world, 0).elements() == 20);
}

#[test]
fn a_network_that_carries_no_repairs_is_not_flooded_with_them() {
    let mut world = world(2, 5, Wire::perfect());
    world.wire.longest = 40;
    world.command(0, write_many(40));
    world.run_for(Duration::from_seconds(60));
    let sent = world.sent_count();
    world.run_for(Duration::from_seconds(600));
    assert_eq!(read(&world, 1, 0), None);
    assert!(
        world.sent_count() - sent < 2 * 600,
        "{}",
        world.sent_count() - sent
    );
}

/// Two memories that share nothing, and one that joins them, are sent no faster than networks like it.
#[test]
fn large_differences_are_sent_piece_by_piece() {
    let mut world = world(3, 6, Wire::perfect());
    world.crash(2);
    for (one, other) in [(0, 1), (1, 0)] {
        world.wire.cut.insert((one, other));
    }
    world.command(0, write_many(8000));
    world.command(1, write_many(8000));
    world.run_for(Duration::from_seconds(10));
    world.wire.cut.clear();
    world.start(2);
    let mut most = 0;
    for _ in 0..10_000 {
        let sent = world.sent_count();
        world.run_for(Duration::from_millis(1));
        most = most.max(world.sent_count() - sent);
    }
    assert!(most <= 100, "{most} datagrams within a millisecond");
    world.run_for(Duration::from_seconds(50));
    let (one, other) = (memory(&world, 0), memory(&world, 2));
    assert_eq!(one.elements(), 8000);
    for variable in 0..8000 {
        let name = format!("x{variable}");
        assert_eq!(one.stamp(&name), other.stamp(&name));
        assert_eq!(one.stamp(&name), memory(&world, 1).stamp(&name));
    }
}

/// Many robots find a difference at once; a robot that hears another send the write does not send
/// it too.
#[test]
fn a_write_missed_by_many_robots_is_sent_again_about_once() {
    let mut bytes = 0;
    for seed in 0..20 {
        let mut world = world(30, seed, Wire::perfect());
        world.wire.delay_ms = (5, 60);
        world.run_for(Duration::from_seconds(60));
        world.wire.loss = 1.0;
        world.command(0, write_many(200));
        world.run_for(Duration::from_millis(1));
        world.wire.loss = 0.0;
        let before = world.sent_bytes();
        world.run_for(Duration::from_seconds(10));
        for robot in 0..30 {
            assert_eq!(read(&world, robot, 77), Some(77));
        }
        bytes += world.sent_bytes() - before;
    }
    // Each of the 200 takes about 20 bytes.
    assert!(bytes < 20 * 12_000, "{}", bytes / 20);
}
