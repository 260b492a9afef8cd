//! Quorums avoid suspected robots, and a restarted arbiter grants nothing before it knows its earlier grants.

use crate::harness::locker::{Locker, acquire, mutex, release, set};
use crate::harness::{Wire, World};
use starl_core::Duration;
use starl_primitives::mutex::Algorithm;

const SECOND: Duration = Duration::from_seconds(1);
const PERIOD: Option<Duration> = Some(Duration::from_millis(100));

fn calm(count: usize) -> World {
    let boxed = Locker::boxed(Algorithm::Quorum, false);
    let mut world = World::new(count, 1, Wire::perfect(), PERIOD, boxed);
    world.run_for(SECOND * 20);
    world
}

#[test]
fn a_crashed_robot_is_left_out() {
    for dead in 1..9 {
        let mut world = calm(9);
        world.crash(dead);
        world.command(0, acquire(&["a"]));
        world.run_for(SECOND * 5);
        assert!(
            mutex(&world, 0).crit() && !mutex(&world, 0).failed(),
            "{dead}"
        );
    }
}

#[test]
fn waiting_for_a_crashed_holder_is_reported_and_ends_when_it_returns() {
    let mut world = calm(4);
    world.command(3, acquire(&["a", "b"]));
    world.run_for(SECOND);
    world.crash(3);
    world.command(0, acquire(&["b", "c"]));
    world.command(1, acquire(&["c", "d"]));
    world.run_for(SECOND * 10);
    assert!(!mutex(&world, 0).crit() && mutex(&world, 0).failed());
    world.command(0, release(&["b"]));
    world.run_for(SECOND * 5);
    // It waited only for the request that was withdrawn.
    assert!(mutex(&world, 1).crit() && !mutex(&world, 1).failed());
    world.command(0, acquire(&["b"]));
    world.run_for(SECOND * 5);
    assert!(mutex(&world, 0).failed());
    world.start(3);
    world.run_for(SECOND * 5);
    assert!(mutex(&world, 0).crit() && !mutex(&world, 0).failed());
}

#[test]
fn restarted_arbiters_ask_for_their_grants() {
    let mut world = calm(4);
    world.command(0, acquire(&["a"]));
    world.run_for(SECOND);
    // All arbiters of the grant but the holder forget it, one after the other.
    for robot in 1..4 {
        world.crash(robot);
        world.start(robot);
        world.run_for(SECOND);
    }
    world.command(3, acquire(&["a"]));
    world.command(2, acquire(&["b"]));
    world.run_for(SECOND * 5);
    assert!(mutex(&world, 0).holds(&set(&["a"])) && !mutex(&world, 3).crit());
    assert!(mutex(&world, 2).crit());
    world.command(0, release(&["a"]));
    world.run_for(SECOND * 5);
    assert!(mutex(&world, 3).crit());
}

#[test]
fn while_a_robot_cannot_be_asked_a_restarted_arbiter_grants_nothing_and_requests_say_so() {
    let mut world = calm(3);
    world.command(0, acquire(&["a"]));
    world.run_for(SECOND);
    world.wire.cut = [(0, 1), (1, 0), (0, 2), (2, 0)].into();
    world.crash(1);
    world.start(1);
    world.run_for(SECOND * 5);
    world.command(1, acquire(&["a"]));
    world.run_for(SECOND * 10);
    assert!(mutex(&world, 0).crit() && !mutex(&world, 1).crit());
    assert!(mutex(&world, 1).failed());
    world.wire.cut.clear();
    world.run_for(SECOND * 3);
    world.command(0, release(&["a"]));
    world.run_for(SECOND * 5);
    assert!(mutex(&world, 1).crit());
}

#[test]
fn sets_that_overlap_in_a_circle_do_not_deadlock() {
    let mut world = calm(16);
    let sets = [["a", "b"], ["b", "c"], ["c", "d"], ["d", "a"]];
    let mut left: Vec<usize> = (0..16).collect();
    for &robot in &left {
        world.command(robot, acquire(&sets[robot % 4]));
    }
    for _ in 0..1000 {
        world.run_for(Duration::from_millis(1));
        left.retain(|&robot| !mutex(&world, robot).crit());
        for robot in 0..16 {
            world.command(
                robot,
                release(if mutex(&world, robot).crit() {
                    &sets[robot % 4]
                } else {
                    &[]
                }),
            );
        }
    }
    assert_eq!(left, Vec::<usize>::new());
}
