//! What an operation takes where all robots begin one on the same register at once: 2 n datagrams in a fleet of n for
//! reads and writes, some times that for claims that no lock keeps from refusing each other; and all come to an end. `cargo test -p starl-primitives --test it
//! register_under_contention -- --nocapture` shows the table of docs/reference/primitives/register.md.

use crate::harness::keeper::{Keeper, claim, keeper, read, status, update, write};
use crate::harness::{Wire, World};
use starl_core::Duration;
use starl_primitives::register::Status;

const SECOND: Duration = Duration::from_seconds(1);
const STEP: Duration = Duration::from_millis(10);

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

/// Runs until all robots are through, and gives the datagrams and the time.
fn count(world: &mut World, mut step: impl FnMut(&mut World) -> bool) -> (f64, Duration) {
    let before = world.traffic_on("register").0;
    let begun = world.now;
    while !step(world) {
        world.run_for(STEP);
        assert!(world.now < begun + SECOND * 600, "they get nowhere");
    }
    let sent = world.traffic_on("register").0 - before;
    (sent as f64 / world.size() as f64, world.now.since(begun))
}

fn is_done(world: &World, robot: usize) -> bool {
    matches!(status(world, robot), Status::Done(_))
}

/// Each robot claims the register and writes it, and claims it again until its write is not lost.
fn counting(world: &mut World) -> (f64, Duration) {
    let robots = world.size();
    (0..robots).for_each(|robot| world.command(robot, claim()));
    let mut writes = vec![false; robots];
    let mut through = vec![false; robots];
    count(world, |world| {
        for robot in 0..robots {
            match status(world, robot) {
                Status::Done(_) if through[robot] => {}
                Status::Done(_) if writes[robot] => through[robot] = true,
                Status::Done(_) => {
                    writes[robot] = true;
                    world.command(robot, update(robot as u32));
                }
                Status::Lost => {
                    writes[robot] = false;
                    world.command(robot, claim());
                }
                _ => {}
            }
        }
        through.iter().all(|&is_through| is_through)
    })
}

#[test]
fn operations_at_once_come_to_an_end_with_few_datagrams() {
    println!("| robots | lost | write | read | claim and update |");
    for robots in [10, 30, 100] {
        for loss in [0.0, 0.2] {
            let mut world = world(robots, loss);
            (0..robots).for_each(|robot| world.command(robot, write(robot as u32)));
            let all = |world: &mut World| (0..robots).all(|robot| is_done(world, robot));
            let written = count(&mut world, all);
            (0..robots).for_each(|robot| world.command(robot, read()));
            let read = count(&mut world, all);
            let counted = counting(&mut world);
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
