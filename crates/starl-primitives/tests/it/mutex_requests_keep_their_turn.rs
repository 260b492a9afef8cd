//! If the participants of a pending request change, it stays the same request, and keeps its turn.

use crate::harness::locker::{Locker, acquire, ask_only, mutex, release, set};
use crate::harness::{Wire, World};
use starl_core::Duration;
use starl_primitives::mutex::Algorithm;

const SECOND: Duration = Duration::from_seconds(1);

fn world() -> World {
    let boxed = Locker::boxed(Algorithm::Permission, false);
    let period = Some(Duration::from_millis(100));
    let mut world = World::new(4, 1, Wire::perfect(), period, boxed);
    world.run_for(SECOND * 5);
    world
}

#[test]
fn robots_do_not_wait_for_a_robot_that_no_longer_takes_part() {
    let mut world = world();
    world.command(3, acquire(&["a"]));
    world.run_for(SECOND);
    world.crash(2);
    for robot in [0, 1] {
        world.command(robot, acquire(&["a"]));
        world.run_for(SECOND);
    }
    // Robot 1 leaves it out at once, and robot 0 when all others have asked already.
    for (robot, participants) in [(1, [0, 1, 3]), (0, [0, 1, 3])] {
        world.command(robot, ask_only(&participants));
        world.command(robot, acquire(&["a"]));
        world.run_for(SECOND * 5);
    }
    assert!(!mutex(&world, 0).holds(&set(&["a"])));
    world.command(3, release(&["a"]));
    world.run_for(SECOND * 5);
    assert!(mutex(&world, 0).holds(&set(&["a"])));
    assert!(!mutex(&world, 1).holds(&set(&["a"])));
    world.command(0, release(&["a"]));
    world.run_for(SECOND * 5);
    assert!(mutex(&world, 1).holds(&set(&["a"])));
}

#[test]
fn a_new_participant_is_asked() {
    let mut world = world();
    world.command(2, acquire(&["a"]));
    world.run_for(SECOND);
    world.crash(1);
    world.command(0, ask_only(&[0, 1]));
    world.command(0, acquire(&["a"]));
    world.run_for(SECOND);
    // Robot 1 is waited for no longer, but robot 2 is.
    world.command(0, ask_only(&[0, 2]));
    world.command(0, acquire(&["a"]));
    world.run_for(SECOND * 5);
    assert!(mutex(&world, 0).is_waiting());
    world.command(2, release(&["a"]));
    world.run_for(SECOND);
    assert!(mutex(&world, 0).holds(&set(&["a"])));
}
