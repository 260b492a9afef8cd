//! A robot that has not heard from any other, because it has just restarted, is not served before those that
//! wait already. Otherwise a stream of new robots would starve them.

use crate::harness::locker::{ALGORITHMS, Locker, acquire, mutex, release, set};
use crate::harness::{Wire, World};
use starl_core::Duration;

const SECOND: Duration = Duration::from_seconds(1);

#[test]
fn a_restarted_robot_gets_its_turn_after_waiting_robots() {
    for algorithm in ALGORITHMS {
        let boxed = Locker::boxed(algorithm, false);
        let period = Some(Duration::from_millis(100));
        let mut world = World::new(4, 1, Wire::perfect(), period, boxed);
        world.run_for(SECOND * 5);
        // Requests drive Lamport's clock on.
        for _ in 0..5 {
            world.command(1, acquire(&["b"]));
            world.run_for(SECOND);
            world.command(1, release(&["b"]));
            world.run_for(SECOND);
        }
        world.command(0, acquire(&["a"]));
        world.run_for(SECOND);
        world.command(1, acquire(&["a"]));
        world.run_for(SECOND);
        world.crash(2);
        world.run_for(SECOND);
        world.start(2);
        world.command(2, acquire(&["a"]));
        world.run_for(SECOND);
        world.command(0, release(&["a"]));
        world.run_for(SECOND);
        assert!(mutex(&world, 1).holds(&set(&["a"])), "{algorithm:?}");
        world.command(1, release(&["a"]));
        world.run_for(SECOND * 5);
        assert!(mutex(&world, 2).holds(&set(&["a"])), "{algorithm:?}");
    }
}
