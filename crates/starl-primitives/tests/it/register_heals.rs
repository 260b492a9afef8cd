//! After any corruption of state copies agree again, and later writes are read.

use crate::harness::keeper::{Keeper, keeper, known, read, result, write};
use crate::harness::{Wire, World};
use starl_core::Duration;

const SECOND: Duration = Duration::from_seconds(1);

#[test]
fn after_a_corruption_of_all_robots_writes_are_read_again() {
    let mut times = Vec::new();
    for seed in 0..500 {
        let make = Keeper::boxed(false, None);
        let mut world = World::new(4, seed, Wire::bad(), None, make);
        world.run_for(SECOND * 20);
        for robot in 0..4 {
            world.command(robot, write(robot as u32));
            world.run_for(SECOND);
        }
        (0..4).for_each(|robot| world.corrupt(robot));
        let corrupted = world.now;
        // Invented copies may have greater tags than the next write; once all robots know them, its tag is
        // greater still. Pending operations may store such values too.
        let copy = |world: &World, robot: usize| {
            let copy = keeper(world, robot).register.known("x");
            copy.map(<[u8]>::to_vec)
        };
        let is_unsettled = |world: &World, robot: usize| {
            keeper(world, robot).register.pending() > 0 || copy(world, robot) != copy(world, 0)
        };
        while (0..4).any(|robot| is_unsettled(&world, robot)) {
            world.run_for(Duration::from_millis(100));
            let since = world.now.since(corrupted).seconds();
            assert!(since < 60.0, "seed {seed}: copies still differ");
        }
        times.push(world.now.since(corrupted).seconds());
        for (value, writer) in [(100, 0), (101, 1), (102, 2)] {
            world.command(writer, write(value));
            world.run_for(SECOND * 20);
            for robot in 0..4 {
                world.command(robot, read());
            }
            world.run_for(SECOND * 20);
            for robot in 0..4 {
                assert_eq!(result(&world, robot), Some(value), "seed {seed}");
            }
        }
        world.run_for(SECOND * 20);
        for robot in 0..4 {
            assert_eq!(known(&world, robot), Some(102), "seed {seed}");
        }
    }
    let longest = times.iter().copied().fold(0.0, f64::max);
    let mean = times.iter().sum::<f64>() / times.len() as f64;
    println!("copies agreed after {mean:.1} s on average, {longest:.1} s at most");
    assert!(mean < 5.0 && longest < 30.0, "{mean}, {longest}");
}
