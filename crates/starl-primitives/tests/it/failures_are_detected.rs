//! A robot that stays down is eventually suspected by all robots that are up, without help of another primitive; one
//! that returns is trusted again, and every restart is detected.

use crate::harness::watcher::{Watcher, suspected, told, watcher};
use crate::harness::{Wire, World};
use starl_core::{Duration, Input, RobotId};
use starl_primitives::failure_detector::Options;

const SECOND: Duration = Duration::from_seconds(1);

fn world(count: usize, seed: u64, wire: Wire) -> World {
    World::new(count, seed, wire, None, Watcher::boxed(Options::default()))
}

#[test]
fn a_crashed_robot_is_suspected_within_the_bound() {
    for seed in 0..20 {
        for wire in [Wire::perfect(), Wire::bad()] {
            let longest_delay = wire.longest_delay();
            let mut world = world(4, seed, wire);
            world.run_for(SECOND * 60);
            world.crash(2);
            // The last heartbeat may still be on its way.
            world.run_for(longest_delay);
            let patience = [0, 1, 3].map(|robot| {
                let detector = &watcher(&world, robot).detector;
                detector.patience(RobotId(2)).expect("it is watched")
            });
            let longest = patience.into_iter().max().unwrap_or_default();
            world.run_for(longest + SECOND);
            for robot in [0, 1, 3] {
                assert!(suspected(&world, robot).contains(&2), "seed {seed}");
                let verdict = Input::Suspected(RobotId(2));
                assert!(told(&world, robot).contains(&verdict), "seed {seed}");
            }
        }
    }
}

#[test]
fn on_a_good_network_a_crash_is_noticed_in_two_seconds_and_no_other_robot_is_suspected() {
    for seed in 0..20 {
        let mut world = world(4, seed, Wire::perfect());
        world.run_for(SECOND * 60);
        world.crash(2);
        world.run_for(SECOND * 2);
        for robot in [0, 1, 3] {
            assert_eq!(told(&world, robot), [Input::Suspected(RobotId(2))]);
        }
    }
}

#[test]
fn a_robot_that_was_never_heard_is_suspected_in_time() {
    let mut wire = Wire::perfect();
    wire.cut = [(1, 0)].into();
    let mut world = world(2, 1, wire);
    world.run_for(SECOND * 2);
    assert_eq!(suspected(&world, 0), []);
    world.run_for(SECOND * 2);
    assert_eq!(suspected(&world, 0), [1]);
    assert_eq!(suspected(&world, 1), []);
}

#[test]
fn a_robot_that_returns_is_trusted_again() {
    for seed in 0..20 {
        let mut world = world(3, seed, Wire::perfect());
        world.run_for(SECOND * 20);
        world.crash(1);
        world.run_for(SECOND * 20);
        world.start(1);
        world.run_for(SECOND);
        for robot in [0, 2] {
            assert_eq!(suspected(&world, robot), [], "seed {seed}");
            assert_eq!(
                told(&world, robot),
                [Input::Suspected(RobotId(1)), Input::Trusted(RobotId(1))]
            );
        }
    }
}

#[test]
fn the_shortest_restart_is_detected() {
    for seed in 0..20 {
        let mut world = world(3, seed, Wire::perfect());
        world.run_for(SECOND * 20);
        world.crash(1);
        world.start(1);
        world.run_for(SECOND);
        for robot in [0, 2] {
            assert_eq!(
                told(&world, robot),
                [Input::Suspected(RobotId(1)), Input::Trusted(RobotId(1))],
                "seed {seed}"
            );
        }
    }
}

#[test]
fn a_robot_that_joins_is_watched_too() {
    let mut world = world(2, 1, Wire::perfect());
    world.run_for(SECOND * 20);
    world.join();
    world.run_for(SECOND * 5);
    assert_eq!(told(&world, 0), []);
    world.crash(2);
    world.run_for(SECOND * 5);
    assert_eq!(told(&world, 0), [Input::Suspected(RobotId(2))]);
}

/// Every datagram arrives twice, and each copy ten seconds late with a chance of one half.
fn late_copies() -> Wire {
    Wire {
        duplication: 1.0,
        late: (0.5, 10_000),
        ..Wire::perfect()
    }
}

#[test]
fn late_copies_of_an_earlier_life_are_no_restarts() {
    for seed in 0..20 {
        let mut world = world(3, seed, late_copies());
        world.run_for(SECOND * 60);
        let before = told(&world, 0).len();
        world.crash(1);
        world.start(1);
        world.run_for(SECOND * 20);
        let verdicts = &told(&world, 0)[before..];
        let suspicions = |verdict: &&Input| **verdict == Input::Suspected(RobotId(1));
        let count = verdicts.iter().filter(suspicions).count();
        assert_eq!(count, 1, "seed {seed}: {verdicts:?}");
    }
}

#[test]
fn late_copies_are_no_sign_of_life() {
    for seed in 0..20 {
        let mut world = world(3, seed, late_copies());
        world.run_for(SECOND * 60);
        let before = told(&world, 0).len();
        world.crash(1);
        world.run_for(SECOND * 40);
        let verdicts = &told(&world, 0)[before..];
        let trusts = |verdict: &&Input| **verdict == Input::Trusted(RobotId(1));
        // A heartbeat that was held back may be the latest.
        let count = verdicts.iter().filter(trusts).count();
        assert!(count <= 1, "seed {seed}: {verdicts:?}");
        assert_eq!(suspected(&world, 0), [1], "seed {seed}");
    }
}
