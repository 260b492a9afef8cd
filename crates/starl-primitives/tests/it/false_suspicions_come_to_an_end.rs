//! On a network that loses, delays and reorders, robots may be suspected in error, but ever less; a
//! partition heals, and what a fault has left in the detector's memory is forgotten.

use crate::harness::watcher::{Watcher, suspected, told};
use crate::harness::{Wire, World};
use starl_core::{Duration, Input};
use starl_primitives::failure_detector::Options;

const SECOND: Duration = Duration::from_seconds(1);

fn world(count: usize, seed: u64, wire: Wire) -> World {
    World::new(count, seed, wire, None, Watcher::boxed(Options::default()))
}

fn suspicions(world: &World, robot: usize) -> usize {
    let verdicts = told(world, robot).iter();
    verdicts
        .filter(|verdict| matches!(verdict, Input::Suspected(_)))
        .count()
}

#[test]
fn a_lossy_network_is_learnt() {
    let (mut early, mut late) = (0, 0);
    for seed in 0..10 {
        let mut world = world(3, seed, Wire::bad());
        world.run_for(SECOND * 600);
        let before: usize = (0..3).map(|robot| suspicions(&world, robot)).sum();
        world.run_for(SECOND * 600);
        let after: usize = (0..3).map(|robot| suspicions(&world, robot)).sum();
        early += before;
        late += after - before;
    }
    // In 36,000 s of watching, with 30 % lost.
    assert!(late <= 15, "{late} suspicions, and {early} before");
    assert!(late < early, "{late} suspicions, and {early} before");
}

#[test]
fn a_sudden_change_of_the_network_is_survived() {
    for seed in 0..10 {
        let mut world = world(3, seed, Wire::perfect());
        world.run_for(SECOND * 60);
        world.wire = Wire {
            loss: 0.6,
            ..Wire::bad()
        };
        world.run_for(SECOND * 1200);
        let before: usize = (0..3).map(|robot| suspicions(&world, robot)).sum();
        world.run_for(SECOND * 300);
        let after: usize = (0..3).map(|robot| suspicions(&world, robot)).sum();
        assert!(after - before <= 2, "seed {seed}: {before}, then {after}");
    }
}

#[test]
fn a_partition_heals() {
    for seed in 0..10 {
        let mut world = world(4, seed, Wire::perfect());
        world.run_for(SECOND * 20);
        let cut = |a, b| [(a, b), (b, a)];
        let pairs = [(0, 2), (0, 3), (1, 2), (1, 3)];
        world.wire.cut = pairs.into_iter().flat_map(|(a, b)| cut(a, b)).collect();
        world.run_for(SECOND * 20);
        assert_eq!(suspected(&world, 0), [2, 3]);
        assert_eq!(suspected(&world, 3), [0, 1]);
        world.wire.cut.clear();
        world.run_for(SECOND * 2);
        for robot in 0..4 {
            assert_eq!(suspected(&world, robot), [], "seed {seed}");
        }
    }
}

#[test]
fn a_corrupted_detector_recovers() {
    for seed in 0..200 {
        let mut world = world(3, seed, Wire::perfect());
        world.run_for(SECOND * 20);
        world.corrupt(0);
        world.run_for(SECOND * 40);
        assert_eq!(suspected(&world, 0), [], "seed {seed}");
        for robot in 0..3 {
            // Of each of the two others at most one.
            assert!(suspicions(&world, robot) <= 2, "seed {seed}");
            assert_eq!(suspected(&world, robot), [], "seed {seed}");
        }
        world.crash(1);
        world.run_for(SECOND * 40);
        assert_eq!(suspected(&world, 0), [1], "seed {seed}");
    }
}

#[test]
fn garbage_from_the_network_is_ignored() {
    use starl_core::{Message, Payload, Port, RobotId};
    let mut world = world(2, 1, Wire::perfect());
    world.run_for(SECOND * 20);
    for length in 0..40_u8 {
        for from in [1, 7, u32::MAX] {
            let message = Message {
                from: RobotId(from),
                port: Port::named("watch"),
                payload: (0..length)
                    .map(|byte| byte.wrapping_mul(37) | 0x80)
                    .collect::<Payload>(),
            };
            world.input(0, &Input::Message(message));
        }
    }
    world.run_for(SECOND * 20);
    assert_eq!(suspected(&world, 0), []);
}
