//! The cost of operations where all robots begin one on the same register at once: 2 n datagrams in a fleet of n for
//! reads and writes, several times that for claims without a lock; and all of them end.
//! `cargo test -p starl-primitives --test it register_under_contention -- --nocapture` prints the table of
//! docs/reference/primitives/register.md.

use crate::harness::keeper::{Keeper, all_count, keeper, read, until_done, write};
use crate::harness::{Wire, World};
use starl_core::Duration;

const SECOND: Duration = Duration::from_seconds(1);

/// Robots whose registers are up, and quiet.
fn world(count: usize, loss: f64) -> World {
    let wire = Wire {
        loss,
        delay_ms: (10, 20),
        ..Wire::perfect()
    };
    let mut world = World::new(count, 1, wire, None, Keeper::boxed(false, None));
    world.run_for(SECOND * 20);
    assert!((0..count).all(|robot| keeper(&world, robot).register.is_up()));
    world
}

/// The datagrams for each robot until all have done something, and the time.
fn count(world: &mut World, run: impl FnOnce(&mut World)) -> (f64, Duration) {
    let (before, begun) = (world.traffic_on("register").0, world.now);
    run(world);
    let sent = world.traffic_on("register").0 - before;
    (sent as f64 / world.size() as f64, world.now.since(begun))
}

#[test]
fn concurrent_operations_end_with_few_datagrams() {
    println!("| robots | lost | write | read | claim and update |");
    for robots in [10, 30, 100] {
        for loss in [0.0, 0.2] {
            let mut world = world(robots, loss);
            let written = count(&mut world, |world| {
                (0..robots).for_each(|robot| world.command(robot, write(robot as u32)));
                until_done(world);
            });
            let read = count(&mut world, |world| {
                (0..robots).for_each(|robot| world.command(robot, read()));
                until_done(world);
            });
            let counted = count(&mut world, all_count);
            let all = robots as f64;
            let at_most = |(sent, _): (f64, Duration), times: f64| assert!(sent <= times * all);
            at_most(written, 3.0);
            at_most(read, 3.0);
            // Two operations, with nothing that keeps robots from refusing each other.
            at_most(counted, 10.0);
            let show =
                |(sent, time): (f64, Duration)| format!("{sent:.0} in {:.1} s", time.seconds());
            println!(
                "| {robots} | {loss} | {} | {} | {} |",
                show(written),
                show(read),
                show(counted)
            );
        }
    }
}
