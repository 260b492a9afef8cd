//! From any state memories agree again, and later writes are read by all (self-stabilisation, Dijkstra 1974).

use crate::harness::sharer::{Sharer, all, busy_world, memory, read, read_of, write, write_own};
use crate::harness::{Wire, World};
use starl_core::Duration;
use starl_primitives::shared_memory::Options;

const PERIOD: Duration = Duration::from_millis(100);

fn corrupted(seed: u64, wire: Wire, whom: &[usize]) -> World {
    let mut world = busy_world(seed, wire, PERIOD);
    world.run_for(Duration::from_seconds(10));
    for _ in 0..3 {
        for &robot in whom {
            world.corrupt(robot);
            world.run_for(Duration::from_millis(37));
        }
    }
    world
}

fn assert_agreement(world: &World, seed: u64) {
    for variable in 0..8 {
        let name = format!("x{variable}");
        for robot in 1..4 {
            let (one, other) = (memory(world, 0), memory(world, robot));
            assert_eq!(one.read(&name), other.read(&name), "seed {seed}");
            assert!(one.all(&name).eq(other.all(&name)), "seed {seed}");
        }
    }
}

#[test]
fn corrupted_memories_agree_again() {
    for seed in 0..100 {
        for whom in [&[2][..], &[0, 1, 2, 3]] {
            let mut world = corrupted(seed, Wire::perfect(), whom);
            world.run_for(Duration::from_seconds(20));
            assert_agreement(&world, seed);
        }
    }
}

#[test]
fn writes_after_a_corruption_are_read_by_all() {
    for seed in 0..100 {
        for wire in [Wire::perfect(), Wire::bad()] {
            let mut world = corrupted(seed, wire, &[0, 1, 2, 3]);
            world.run_for(Duration::from_seconds(30));
            for robot in 0..4 {
                for variable in 0..8 {
                    let value = 100 * robot as u32;
                    world.command(robot, write(variable, value + 50));
                    world.command(robot, write_own(variable, value));
                }
                world.run_for(Duration::from_seconds(30));
            }
            for robot in 0..4 {
                for variable in 0..8 {
                    assert_eq!(read(&world, robot, variable), Some(350), "seed {seed}");
                    let known = all(&world, robot, variable);
                    assert_eq!(known, [(0, 0), (1, 100), (2, 200), (3, 300)], "seed {seed}");
                }
            }
        }
    }
}

/// An element that its owner still holds is its owner's word.
#[test]
fn an_owner_corrects_garbled_copies() {
    for seed in 0..100 {
        let mut world = corrupted(seed, Wire::bad(), &[1, 2, 3]);
        world.run_for(Duration::from_seconds(30));
        for robot in 0..4 {
            for variable in 0..8 {
                assert_eq!(read_of(&world, robot, variable, 0), Some(0), "seed {seed}");
            }
        }
    }
}

/// Whatever it believes of when it sent what.
#[test]
fn a_corrupted_memory_is_passed_on() {
    for seed in 0..100 {
        let make = Sharer::boxed(Options::default());
        let mut world = World::new(2, seed, Wire::perfect(), Some(PERIOD), make);
        for variable in 0..8 {
            world.command(0, write(variable, 5));
        }
        world.run_for(Duration::from_seconds(10));
        world.crash(1);
        world.corrupt(0);
        world.run_for(Duration::from_seconds(10));
        let kept = memory(&world, 0).elements();
        world.start(1);
        world.run_for(Duration::from_seconds(10));
        assert_eq!(memory(&world, 1).elements(), kept, "seed {seed}");
    }
}

#[test]
fn a_write_after_a_corruption_is_later_than_the_replaced_value() {
    for seed in 0..100 {
        let mut world = corrupted(seed, Wire::perfect(), &[0]);
        for variable in 0..8 {
            let name = format!("x{variable}");
            let before = memory(&world, 0).stamp(&name);
            world.command(0, write(variable, 77));
            let after = memory(&world, 0).stamp(&name);
            // No clock of ours shows more than 146 years.
            let is_possible = before.is_none_or(|stamp| stamp.time.0 <= u64::MAX >> 2);
            assert!(!is_possible || before < after, "seed {seed}");
            assert_eq!(read(&world, 0, variable.into()), Some(77));
        }
    }
}
