//! Every write reaches every robot, with any loss, delay or reordering of datagrams, and all robots choose the same
//! among concurrent writes.

use crate::harness::sharer::{self, Sharer, all, read, read_of, write, write_own};
use crate::harness::{Wire, World};
use starl_core::{Duration, Random};
use starl_primitives::shared_memory::Options;

/// Until a write has been sent, 1 ms, and has arrived everywhere, if nothing delays it.
const DATAGRAM: Duration = Duration::from_millis(2);

fn world(robots: usize, seed: u64, wire: Wire) -> World {
    World::new(robots, seed, wire, None, Sharer::boxed(Options::default()))
}

#[test]
fn a_write_is_read_at_once_here_and_after_one_delay_elsewhere() {
    let mut world = world(4, 1, Wire::perfect());
    assert_eq!(read(&world, 0, 0), None);
    world.command(0, write(0, 7));
    assert_eq!(read(&world, 0, 0), Some(7));
    world.run_for(DATAGRAM);
    for robot in 1..4 {
        assert_eq!(read(&world, robot, 0), Some(7));
    }
    assert_eq!(world.sent_count(), 1, "one datagram told all");
}

#[test]
fn variables_and_arrays_of_one_name_are_apart() {
    let mut world = world(3, 1, Wire::perfect());
    for robot in [2, 0, 1] {
        world.command(robot, write_own(0, 10 + robot as u32));
    }
    world.command(1, write(0, 99));
    world.run_for(Duration::from_millis(5));
    for robot in 0..3 {
        assert_eq!(all(&world, robot, 0), [(0, 10), (1, 11), (2, 12)]);
        assert_eq!(read_of(&world, robot, 0, 2), Some(12));
        assert_eq!(read_of(&world, robot, 0, 3), None);
        assert_eq!(read(&world, robot, 0), Some(99));
        assert_eq!(read(&world, robot, 1), None);
    }
}

#[test]
fn writes_of_one_activation_share_a_datagram() {
    let mut world = world(2, 1, Wire::perfect());
    for variable in 0..10 {
        world.command(0, write(variable, 5));
        world.command(0, write_own(variable, 6));
    }
    world.run_for(DATAGRAM);
    // Each command flushes what the one before wrote.
    let before = world.sent_count();
    assert!(before <= 20);
    world.command(0, sharer::write_many(20));
    world.run_for(DATAGRAM);
    assert_eq!(world.sent_count(), before + 1);
    for variable in 0..20 {
        assert_eq!(read(&world, 1, variable), Some(u32::from(variable)));
    }
}

#[test]
fn writing_ones_element_again_with_the_same_value_costs_nothing() {
    let mut world = world(2, 1, Wire::perfect());
    world.command(0, write_own(0, 5));
    world.run_for(Duration::from_millis(10));
    let (sent, stamp) = (
        world.sent_count(),
        sharer::memory(&world, 0).stamp_of("x0", starl_core::RobotId(0)),
    );
    world.command(0, write_own(0, 5));
    world.run_for(Duration::from_millis(10));
    assert_eq!(world.sent_count(), sent);
    assert_eq!(
        sharer::memory(&world, 0).stamp_of("x0", starl_core::RobotId(0)),
        stamp
    );
}

#[test]
fn copies_become_equal_over_a_network_that_loses_repeats_and_reorders() {
    for seed in 0..60 {
        let mut world = world(5, seed, Wire::bad());
        let mut random = Random::keyed(seed, &[9]);
        let mut value = 0;
        for _ in 0..40 {
            value += 1;
            let robot = random.below(5) as usize;
            let variable = random.below(4) as u8;
            world.command(robot, write(variable, value));
            world.command(robot, write_own(variable, value));
            world.run_for(Duration::from_millis(u64::from(random.below(300))));
        }
        world.run_for(Duration::from_seconds(20));
        for variable in 0..4 {
            let read_first = read(&world, 0, variable);
            let all_first = all(&world, 0, variable);
            for robot in 1..5 {
                assert_eq!(read(&world, robot, variable), read_first, "seed {seed}");
                assert_eq!(all(&world, robot, variable), all_first, "seed {seed}");
            }
            for (owner, value) in all_first {
                assert_eq!(
                    read_of(&world, owner as usize, variable, owner),
                    Some(value)
                );
            }
        }
    }
}

#[test]
fn a_write_that_no_robot_heard_is_repaired() {
    for seed in 0..20 {
        let mut world = world(3, seed, Wire::perfect());
        world.run_for(Duration::from_seconds(60));
        world.wire.loss = 1.0;
        world.command(0, write(0, 7));
        world.run_for(DATAGRAM);
        world.wire.loss = 0.0;
        world.run_for(Duration::from_millis(1050));
        for robot in 1..3 {
            assert_eq!(read(&world, robot, 0), Some(7), "seed {seed}");
        }
    }
}
