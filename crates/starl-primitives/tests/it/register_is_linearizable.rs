//! Registers behave like a single copy, whatever the network does and whichever robots crash and restart, as long as no
//! majority is down or recovering at once; and every operation ends.

use crate::harness::keeper::{Keeper, judge, keeper};
use crate::harness::{Wire, World};
use starl_core::{Duration, Random, RobotId};

const SECOND: Duration = Duration::from_seconds(1);
const PERIOD: Option<Duration> = Some(Duration::from_millis(100));

fn busy(count: usize, seed: u64, wire: Wire) -> World {
    World::new(count, seed, wire, PERIOD, Keeper::boxed(true, None))
}

#[test]
fn busy_robots_agree() {
    for seed in 0..100 {
        for wire in [Wire::perfect(), Wire::bad()] {
            let mut world = busy(4, seed, wire);
            world.run_for(SECOND * 60);
            let count = judge(&world).unwrap_or_else(|text| panic!("seed {seed}: {text}"));
            for robot in 0..4 {
                assert!(count[&robot] >= 15, "seed {seed}: {count:?}");
            }
        }
    }
}

#[test]
fn crashes_and_restarts_do_not_break_it() {
    for seed in 0..300 {
        let count = 3 + (seed % 3) as usize;
        let mut random = Random::keyed(seed, &[7]);
        let mut world = busy(count, seed, Wire::bad());
        world.run_for(SECOND * 20);
        for _ in 0..30 {
            // One after the other: before the next crashes, this one has recovered.
            let robot = random.below(count as u32) as usize;
            world.crash(robot);
            world.run_for(Duration::from_millis(u64::from(random.below(2000))));
            world.start(robot);
            while !keeper(&world, robot).register.is_up() {
                world.run_for(Duration::from_millis(50));
                assert!(
                    world.now.seconds() < 1000.0,
                    "seed {seed}: it does not recover"
                );
            }
            world.run_for(Duration::from_millis(u64::from(random.below(1000))));
        }
        let before = judge(&world).unwrap_or_else(|text| panic!("seed {seed}: {text}"));
        world.run_for(SECOND * 30);
        let after = judge(&world).unwrap_or_else(|text| panic!("seed {seed}: {text}"));
        for robot in 0..count as u32 {
            let more = after[&robot] - before.get(&robot).unwrap_or(&0);
            assert!(more >= 5, "seed {seed}: {before:?}, then {after:?}");
        }
    }
}

#[test]
fn partitions_do_not_break_it() {
    for seed in 0..100 {
        let mut random = Random::keyed(seed, &[8]);
        let mut world = busy(5, seed, Wire::bad());
        world.run_for(SECOND * 5);
        for _ in 0..10 {
            world.fall_apart(&mut random, SECOND * 5);
            world.run_for(SECOND * 3);
        }
        judge(&world).unwrap_or_else(|text| panic!("seed {seed}: {text}"));
    }
}

#[test]
fn robots_that_keep_no_copies_read_and_write_too() {
    for seed in 0..50 {
        let keepers = (0..3).map(RobotId).collect();
        let make = Keeper::boxed(true, Some(keepers));
        let mut world = World::new(6, seed, Wire::bad(), PERIOD, make);
        world.run_for(SECOND * 60);
        let count = judge(&world).unwrap_or_else(|text| panic!("seed {seed}: {text}"));
        for robot in 0..6 {
            assert!(count[&robot] >= 15, "seed {seed}: {count:?}");
        }
    }
}
