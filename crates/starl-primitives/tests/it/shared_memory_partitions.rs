//! The memories of separated parts of a fleet converge after the partition.

use crate::harness::sharer::{Sharer, all, read, write, write_own};
use crate::harness::{Wire, World};
use starl_core::{Duration, Random};
use starl_primitives::shared_memory::Options;

const ROBOTS: u32 = 8;

/// The first half and the second do not hear each other.
fn cut(world: &mut World) {
    for one in 0..ROBOTS / 2 {
        for other in ROBOTS / 2..ROBOTS {
            world.wire.cut.insert((one, other));
            world.wire.cut.insert((other, one));
        }
    }
}

fn partitioned(seed: u64, wire: Wire) -> World {
    let make = Sharer::boxed(Options::default());
    let mut world = World::new(ROBOTS as usize, seed, wire, None, make);
    world.command(0, write(0, 1));
    world.run_for(Duration::from_seconds(20));
    cut(&mut world);
    world.command(0, write(0, 2));
    world.run_for(Duration::from_millis(10));
    world.command(7, write(0, 3));
    for robot in 0..ROBOTS {
        world.command(robot as usize, write_own(0, 100 + robot));
    }
    world.run_for(Duration::from_seconds(60));
    world
}

#[test]
fn each_part_continues_by_itself() {
    let world = partitioned(1, Wire::perfect());
    for robot in 0..ROBOTS as usize {
        let second = robot >= ROBOTS as usize / 2;
        assert_eq!(read(&world, robot, 0), Some(if second { 3 } else { 2 }));
        assert_eq!(all(&world, robot, 0).len(), ROBOTS as usize / 2);
    }
}

#[test]
fn the_parts_become_one() {
    for seed in 0..20 {
        for wire in [Wire::perfect(), Wire::bad()] {
            let mut world = partitioned(seed, wire);
            world.wire.cut.clear();
            world.run_for(Duration::from_seconds(20));
            let everyone: Vec<_> = (0..ROBOTS).map(|robot| (robot, 100 + robot)).collect();
            for robot in 0..ROBOTS as usize {
                assert_eq!(read(&world, robot, 0), Some(3), "seed {seed}");
                assert_eq!(all(&world, robot, 0), everyone, "seed {seed}");
            }
        }
    }
}

#[test]
fn one_link_between_the_parts_is_enough() {
    for seed in 0..20 {
        let mut world = partitioned(seed, Wire::perfect());
        world.wire.cut.remove(&(3, 4));
        world.wire.cut.remove(&(4, 3));
        world.run_for(Duration::from_seconds(20));
        for robot in 0..ROBOTS as usize {
            assert_eq!(read(&world, robot, 0), Some(3), "seed {seed}");
            assert_eq!(all(&world, robot, 0).len(), ROBOTS as usize, "seed {seed}");
        }
    }
}

#[test]
fn one_way_links_are_bypassed() {
    for seed in 0..40 {
        let robots = [4, 5, 8, 12][seed as usize % 4];
        let make = Sharer::boxed(Options::default());
        let mut world = World::new(robots, seed, Wire::perfect(), None, make);
        let mut random = Random::keyed(seed, &[3]);
        // Everything that two robots say does not reach some other: the same one, every other time.
        let mut to = random.below(robots as u32);
        for _ in 0..2 {
            let from = random.below(robots as u32);
            world.wire.cut.insert((from, to));
            if seed % 2 == 0 {
                to = random.below(robots as u32);
            }
        }
        for round in 0..20 {
            for robot in 0..robots {
                world.command(robot, write(robot as u8, round));
                world.command(robot, write_own(0, round));
            }
            world.run_for(Duration::from_millis(500));
        }
        world.run_for(Duration::from_seconds(25));
        for robot in 0..robots {
            for variable in 0..robots as u8 {
                let cut = &world.wire.cut;
                assert_eq!(
                    read(&world, robot, variable.into()),
                    Some(19),
                    "seed {seed}, {cut:?}"
                );
            }
            let everyone: Vec<_> = (0..robots as u32).map(|robot| (robot, 19)).collect();
            assert_eq!(all(&world, robot, 0), everyone, "seed {seed}");
        }
    }
}

#[test]
fn a_robot_that_cannot_answer_those_that_it_hears_is_reached() {
    // Robot 0 hears 2 alone, and is heard by 1 alone: no two robots can compare their memories with it.
    for seed in 0..20 {
        let make = Sharer::boxed(Options::default());
        let mut wire = Wire::perfect();
        wire.loss = if seed % 2 == 0 { 0.0 } else { 0.2 };
        let mut world = World::new(3, seed, wire, None, make);
        world.wire.cut.extend([(1, 0), (0, 2)]);
        for round in 0..40 {
            for robot in 0..3 {
                world.command(robot, write(robot as u8, round));
                world.command(robot, write_own(0, round));
            }
            world.run_for(Duration::from_millis(500));
        }
        world.run_for(Duration::from_seconds(20));
        for robot in 0..3 {
            for variable in 0..3 {
                assert_eq!(read(&world, robot, variable), Some(39), "seed {seed}");
            }
            let everyone: Vec<_> = (0..3).map(|robot| (robot, 39)).collect();
            assert_eq!(all(&world, robot, 0), everyone, "seed {seed}");
        }
    }
}
