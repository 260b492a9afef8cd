//! No resource is held by two robots at once, whatever the network does; and every request of a robot is eventually
//! granted.

use crate::harness::locker::{
    ALGORITHMS, Locker, RESOURCES, acquire, entries, mutex, release, set,
};
use crate::harness::{self, Wire, World};
use starl_core::{Duration, Random};
use starl_primitives::mutex::Algorithm;

const SECOND: Duration = Duration::from_seconds(1);
const PERIOD: Option<Duration> = Some(Duration::from_millis(100));

fn busy(algorithm: Algorithm, count: usize, seed: u64, wire: Wire) -> World {
    World::new(count, seed, wire, PERIOD, Locker::boxed(algorithm, true))
}

/// Robots that follow their orders, once they can.
fn calm(algorithm: Algorithm, count: usize) -> World {
    let boxed = Locker::boxed(algorithm, false);
    let mut world = World::new(count, 1, Wire::perfect(), PERIOD, boxed);
    world.run_for(SECOND * 5);
    world
}

#[test]
fn busy_robots_take_turns() {
    for algorithm in ALGORITHMS {
        for seed in 0..15 {
            for (wire, least) in [(Wire::perfect(), 20), (Wire::bad(), 4)] {
                let mut world = busy(algorithm, 4, seed, wire);
                world.run_for(SECOND * 120);
                let entries = entries(&world, &[]);
                for robot in 0..4 {
                    let count = *entries.get(&robot).unwrap_or(&0);
                    assert!(count >= least, "{algorithm:?} seed {seed}: {entries:?}");
                }
            }
        }
    }
}

#[test]
fn crashes_and_restarts_do_not_break_it() {
    for (algorithm, seed) in ALGORITHMS
        .into_iter()
        .flat_map(|a| (0..30).map(move |s| (a, s)))
    {
        let mut random = Random::keyed(seed, &[7]);
        let mut world = busy(algorithm, 4, seed, Wire::bad());
        let mut crashes = Vec::new();
        for _ in 0..60 {
            let robot = random.below(4) as usize;
            world.run_for(Duration::from_millis(u64::from(random.below(5000))));
            world.crash(robot);
            crashes.push((world.now, robot as u32));
            world.run_for(Duration::from_millis(u64::from(random.below(2000))));
            world.start(robot);
        }
        let before = entries(&world, &crashes);
        world.run_for(SECOND * 120);
        let after = entries(&world, &crashes);
        for robot in 0..4 {
            let more = after.get(&robot).unwrap_or(&0) - before.get(&robot).unwrap_or(&0);
            assert!(
                more >= 2,
                "{algorithm:?} seed {seed}: {before:?}, then {after:?}"
            );
        }
    }
}

#[test]
fn robots_may_join_late() {
    for (algorithm, seed) in ALGORITHMS
        .into_iter()
        .flat_map(|a| (0..15).map(move |s| (a, s)))
    {
        let mut world = busy(algorithm, 2, seed, Wire::bad());
        for _ in 0..3 {
            world.run_for(SECOND * 20);
            world.join();
        }
        world.run_for(SECOND * 200);
        let entries = entries(&world, &[]);
        let count = *entries.get(&4).unwrap_or(&0);
        assert!(count >= 5, "{algorithm:?} seed {seed}: {entries:?}");
    }
}

#[test]
fn earlier_requests_are_granted_first() {
    for algorithm in ALGORITHMS {
        let mut world = calm(algorithm, 3);
        world.command(0, acquire(&["a", "b"]));
        world.run_for(SECOND);
        world.command(2, acquire(&["b", "c"]));
        world.run_for(SECOND);
        world.command(1, acquire(&["b", "d"]));
        world.run_for(SECOND);
        assert!(mutex(&world, 0).holds(&set(&["a", "b"])));
        assert!(mutex(&world, 2).held().is_empty() && mutex(&world, 1).held().is_empty());
        world.command(0, release(&["b"]));
        world.run_for(SECOND);
        assert!(mutex(&world, 0).holds(&set(&["a"])) && !mutex(&world, 0).holds(&set(&["b"])));
        assert!(mutex(&world, 2).holds(&set(&["b", "c"])));
        assert!(mutex(&world, 1).held().is_empty());
        world.command(2, release(&RESOURCES));
        world.run_for(SECOND);
        assert!(mutex(&world, 1).holds(&set(&["b", "d"])));
    }
}

#[test]
fn disjoint_requests_do_not_wait_for_each_other() {
    for algorithm in ALGORITHMS {
        let mut world = calm(algorithm, 4);
        // The first request of a robot may take another exchange.
        for robot in 0..4 {
            world.command(robot, acquire(&["a"]));
            world.run_for(SECOND);
            world.command(robot, release(&["a"]));
            world.run_for(SECOND);
        }
        for (robot, resource) in RESOURCES.into_iter().enumerate() {
            world.command(robot, acquire(&[resource]));
        }
        // A request and its grants take 1 ms each.
        world.run_for(Duration::from_millis(2));
        for (robot, resource) in RESOURCES.into_iter().enumerate() {
            assert!(
                mutex(&world, robot).holds(&set(&[resource])),
                "{algorithm:?}"
            );
        }
    }
}

#[test]
fn a_request_reports_that_it_waits_for_a_crashed_robot_and_continues_after_its_return() {
    let mut world = calm(Algorithm::Permission, 3);
    world.command(1, acquire(&["a"]));
    world.run_for(SECOND * 20);
    world.crash(1);
    world.command(0, acquire(&["a", "b"]));
    assert!(!mutex(&world, 0).failed());
    world.run_for(SECOND * 5);
    assert!(mutex(&world, 0).failed() && mutex(&world, 0).is_waiting());
    world.command(0, release(&["a"]));
    assert!(!mutex(&world, 0).failed() && !mutex(&world, 0).is_waiting());
    world.command(0, acquire(&["a", "b"]));
    world.run_for(SECOND);
    assert!(mutex(&world, 0).failed());
    world.start(1);
    world.run_for(SECOND * 2);
    assert!(!mutex(&world, 0).failed() && mutex(&world, 0).holds(&set(&["a", "b"])));
}

#[test]
fn more_is_refused_while_something_is_held() {
    use starl_primitives::mutex::AcquireError;
    let mut world = calm(Algorithm::Permission, 2);
    world.command(0, acquire(&["a"]));
    world.run_for(SECOND);
    let mut mutex = mutex(&world, 0).clone();
    harness::alone(0, |robot| {
        assert_eq!(mutex.acquire(robot, set(&["a"])), Ok(()));
        let refused = mutex.acquire(robot, set(&["a", "b"]));
        assert_eq!(refused, Err(AcquireError::HoldsOthers));
        assert!(mutex.holds(&set(&["a"])));
    });
}

#[test]
fn after_a_corruption_it_is_safe_again_once_all_was_given_back() {
    for (algorithm, seed) in ALGORITHMS
        .into_iter()
        .flat_map(|a| (0..40).map(move |s| (a, s)))
    {
        let mut world = busy(algorithm, 4, seed, Wire::perfect());
        world.run_for(SECOND * 10);
        (0..4).for_each(|robot| world.corrupt(robot));
        world.run_for(SECOND * 60);
        world.records.clear();
        // No robot holds anything from before when all have had a turn.
        let held: Vec<bool> = (0..4)
            .map(|robot| mutex(&world, robot).held().is_empty())
            .collect();
        if held.iter().all(|&nothing| nothing) {
            world.run_for(SECOND * 60);
            let entries = entries(&world, &[]);
            for robot in 0..4 {
                assert!(
                    entries.get(&robot) >= Some(&5),
                    "{algorithm:?} seed {seed}: {entries:?}"
                );
            }
        }
    }
}
