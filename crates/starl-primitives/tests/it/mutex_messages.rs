//! The number of messages of an entry for 3 to 100 robots, compared with the theory of each algorithm. A message to all
//! counts once for each receiver. `cargo test -p starl-primitives --test mutex_messages -- --nocapture` shows the table
//! of docs/reference/primitives/mutex.md.

use crate::harness::locker::{ALGORITHMS, Locker, acquire, asked, mutex, release};
use crate::harness::{Wire, World};
use starl_core::{Duration, Input};
use starl_primitives::mutex::Algorithm;

const SIZES: [usize; 8] = [3, 4, 5, 9, 16, 25, 49, 100];

/// Robots that know each other.
fn world(algorithm: Algorithm, count: usize) -> World {
    let boxed = Locker::boxed(algorithm, false);
    let mut world = World::new(count, 1, Wire::perfect(), None, boxed);
    (0..count).for_each(|robot| world.input(robot, &Input::Activate));
    world.run_for(Duration::from_seconds(5));
    turns(&mut world, count);
    world
}

/// Each robot enters once, alone.
fn turns(world: &mut World, count: usize) {
    for robot in 0..count {
        world.command(robot, acquire(&["a"]));
        world.run_for(Duration::from_millis(20));
        assert!(mutex(world, robot).crit());
        world.command(robot, release(&["a"]));
        world.run_for(Duration::from_millis(20));
    }
}

/// All robots ask at once, and give back what they get at once.
fn crowd(world: &mut World, count: usize) {
    (0..count).for_each(|robot| world.command(robot, acquire(&["a"])));
    let mut left = count;
    while left > 0 {
        world.run_for(Duration::from_millis(1));
        for robot in 0..count {
            if mutex(world, robot).crit() {
                world.command(robot, release(&["a"]));
                left -= 1;
            }
        }
    }
}

/// Messages and datagrams for each entry.
fn counted(world: &mut World, count: usize, run: fn(&mut World, usize)) -> (f64, f64) {
    let before = world.traffic_on("lock");
    run(world, count);
    let after = world.traffic_on("lock");
    let share = |count_of: usize| count_of as f64 / count as f64;
    (share(after.1 - before.1), share(after.0 - before.0))
}

#[test]
fn an_entry_takes_the_messages_of_theory() {
    println!(
        "| algorithm | robots | asked | alone: messages | datagrams | crowd: messages | datagrams |"
    );
    for algorithm in ALGORITHMS {
        for count in SIZES {
            let mut world = world(algorithm, count);
            let alone = counted(&mut world, count, turns);
            world.run_for(Duration::from_seconds(3));
            let crowd = counted(&mut world, count, crowd);
            let asked = asked(algorithm, count);
            println!(
                "| {algorithm:?} | {count} | {asked:.1} | {:.1} | {:.1} | {:.1} | {:.1} |",
                alone.0, alone.1, crowd.0, crowd.1
            );
            // Request and permission; or request, grant and release.
            let each = match algorithm {
                Algorithm::Permission => 2.0,
                Algorithm::Quorum | Algorithm::Lease => 3.0,
            };
            assert!(
                (alone.0 - each * asked).abs() < 0.01,
                "{algorithm:?} {count}: {alone:?}"
            );
            // In addition, with quorums waiting robots are informed, asked to yield, and yield: at most twice as
            // many. A crowd of a hundred waits so long that requests are repeated.
            let most = match algorithm {
                Algorithm::Permission => 2.0,
                Algorithm::Quorum => 6.0,
                Algorithm::Lease => 3.01,
            };
            let repeated = if count < 49 { 1.0 } else { 1.5 };
            assert!(
                crowd.0 <= most * repeated * asked,
                "{algorithm:?} {count}: {crowd:?}"
            );
        }
    }
}

#[test]
fn quorums_take_six_roots_of_the_robots_at_most() {
    for count in SIZES {
        let mut world = world(Algorithm::Quorum, count);
        let (messages, _) = counted(&mut world, count, turns);
        assert!(
            messages <= 6.0 * (count as f64).sqrt(),
            "{count}: {messages}"
        );
    }
}
