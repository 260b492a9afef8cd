//! A count that robots keep in a register by claiming and writing increases once for each write that is
//! reported as done, whatever the network does and whichever robots crash and restart; no lock and no clock
//! separates them.

use crate::harness::counter::{Counter, Tally, tally};
use crate::harness::{Wire, World};
use starl_core::{Duration, Random, RobotId};

const SECOND: Duration = Duration::from_seconds(1);
const PERIOD: Option<Duration> = Some(Duration::from_millis(100));

/// The count in the end, once all have the same copy.
fn count(world: &World, robots: usize) -> u64 {
    let counter = |robot| world.inspect::<Counter>(robot).known();
    (0..robots).map(counter).max().expect("there are robots")
}

fn check(world: &World, robots: usize, seed: u64) -> Tally {
    let tally = tally(world).unwrap_or_else(|text| panic!("seed {seed}: {text}"));
    let (done, count) = (tally.all_done(), count(world, robots) as usize);
    assert!(
        done <= count && count <= done + tally.open,
        "seed {seed}: {count} were counted, {tally:?}"
    );
    tally
}

#[test]
fn robots_that_count_at_once_count_all() {
    for seed in 0..100 {
        for wire in [Wire::perfect(), Wire::bad()] {
            let mut world = World::new(4, seed, wire, PERIOD, Counter::boxed(None, 3000));
            world.run_for(SECOND * 120);
            let tally = check(&world, 4, seed);
            for robot in 0..4 {
                assert!(tally.done.get(&robot) >= Some(&3), "seed {seed}: {tally:?}");
            }
        }
    }
}

#[test]
fn crashes_and_restarts_lose_none() {
    let (mut lost, mut open) = (0, 0);
    for seed in 0..200 {
        let robots = 3 + (seed % 3) as usize;
        let mut random = Random::keyed(seed, &[7]);
        let mut world = World::new(
            robots,
            seed,
            Wire::bad(),
            PERIOD,
            Counter::boxed(None, 1500),
        );
        world.run_for(SECOND * 10);
        for _ in 0..30 {
            // One after the other: before the next crashes, this one has recovered.
            let robot = random.below(robots as u32) as usize;
            world.crash(robot);
            world.run_for(Duration::from_millis(u64::from(random.below(2000))));
            world.start(robot);
            while !world.inspect::<Counter>(robot).register.is_up() {
                world.run_for(Duration::from_millis(50));
                assert!(
                    world.now.seconds() < 1000.0,
                    "seed {seed}: it does not recover"
                );
            }
            world.run_for(Duration::from_millis(u64::from(random.below(1000))));
        }
        let before = check(&world, robots, seed);
        world.run_for(SECOND * 60);
        let after = check(&world, robots, seed);
        assert!(after.all_done() >= before.all_done() + 5, "seed {seed}");
        lost += after.lost;
        open += after.open;
    }
    assert!(lost > 500 && open > 500, "{lost} lost, {open} left open");
}

#[test]
fn partitions_lose_none() {
    for seed in 0..60 {
        let mut random = Random::keyed(seed, &[8]);
        let mut world = World::new(5, seed, Wire::bad(), PERIOD, Counter::boxed(None, 1500));
        world.run_for(SECOND * 5);
        for _ in 0..10 {
            world.fall_apart(&mut random, SECOND * 5);
            world.run_for(SECOND * 3);
        }
        check(&world, 5, seed);
    }
}

#[test]
fn robots_that_keep_no_copies_count_too() {
    for seed in 0..40 {
        let keepers = (0..3).map(RobotId).collect();
        let make = Counter::boxed(Some(keepers), 4000);
        let mut world = World::new(5, seed, Wire::bad(), PERIOD, make);
        world.run_for(SECOND * 120);
        // A robot that is further away seldom has a turn, because nothing separates robots.
        let tally = check(&world, 5, seed);
        assert!(tally.all_done() >= 20, "seed {seed}: {tally:?}");
    }
}
