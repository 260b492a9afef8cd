//! No robot passes a barrier before all have arrived, whatever the network does and whichever robots crash
//! and restart; and when all have arrived, all pass.

use crate::harness::crosser::{Crosser, arrive, barrier, crosser, crossings};
use crate::harness::{Wire, World};
use starl_core::{Duration, Random};

const SECOND: Duration = Duration::from_seconds(1);
const PERIOD: Option<Duration> = Some(Duration::from_millis(100));

fn idle(count: usize, seed: u64, wire: Wire) -> World {
    World::new(count, seed, wire, PERIOD, Crosser::boxed(None, None))
}

fn busy(count: usize, seed: u64, wire: Wire) -> World {
    World::new(count, seed, wire, PERIOD, Crosser::boxed(None, Some(1000)))
}

#[test]
fn no_robot_passes_before_the_last_has_arrived() {
    let mut world = idle(4, 1, Wire::perfect());
    for generation in 1..4 {
        for robot in [2, 0, 3] {
            world.command(robot, arrive());
            world.run_for(SECOND * 3);
            assert!(barrier(&world, robot).is_waiting() && !barrier(&world, robot).passed());
        }
        world.command(1, arrive());
        world.run_for(Duration::from_millis(5));
        for robot in 0..4 {
            assert!(
                barrier(&world, robot).passed(),
                "{robot} {:?}",
                barrier(&world, robot)
            );
            assert_eq!(barrier(&world, robot).generation(), generation + 1);
        }
    }
    assert_eq!(crossings(&world, &[]).values().sum::<u32>(), 12);
}

#[test]
fn a_lone_robot_does_not_wait() {
    let mut world = idle(1, 1, Wire::perfect());
    assert!(!barrier(&world, 0).passed());
    world.command(0, arrive());
    assert!(barrier(&world, 0).passed());
}

#[test]
fn others_than_the_participants_are_not_waited_for() {
    let make = Crosser::boxed(Some(&[0, 2]), None);
    let mut world = World::new(4, 1, Wire::perfect(), PERIOD, make);
    world.command(0, arrive());
    world.command(1, arrive());
    world.run_for(SECOND);
    assert!(!barrier(&world, 0).passed());
    world.command(2, arrive());
    world.run_for(SECOND);
    assert!(barrier(&world, 0).passed() && barrier(&world, 2).passed());
    crossings(&world, &[]);
}

#[test]
fn loss_duplication_and_reordering() {
    for seed in 0..50 {
        let mut world = busy(4, seed, Wire::bad());
        world.run_for(SECOND * 60);
        let crossings = crossings(&world, &[]);
        for robot in 0..4 {
            assert!(crossings[&robot] >= 15, "seed {seed}: {crossings:?}");
        }
    }
}

#[test]
fn crashes_and_restarts() {
    for seed in 0..50 {
        let mut random = Random::keyed(seed, &[7]);
        let mut world = busy(4, seed, Wire::bad());
        let mut crashes = Vec::new();
        for _ in 0..20 {
            let robot = random.below(4) as usize;
            world.run_for(Duration::from_millis(u64::from(random.below(4000))));
            world.crash(robot);
            crashes.push((world.records.len(), robot as u32));
            world.run_for(Duration::from_millis(u64::from(random.below(2000))));
            world.start(robot);
        }
        let before = crossings(&world, &crashes);
        world.run_for(SECOND * 60);
        let after = crossings(&world, &crashes);
        for robot in 0..4 {
            let more = after[&robot] - before.get(&robot).unwrap_or(&0);
            assert!(more >= 10, "seed {seed}: {before:?}, then {after:?}");
        }
    }
}

/// Lives of robots never all end at once here, but in any order.
#[test]
fn all_may_restart_one_after_the_other() {
    for seed in 0..50 {
        let mut world = busy(3, seed, Wire::bad());
        let mut crashes = Vec::new();
        world.run_for(SECOND * 10);
        for robot in [0, 1, 2, 1, 0, 2] {
            world.crash(robot);
            crashes.push((world.records.len(), robot as u32));
            world.start(robot);
            world.run_for(SECOND * 2);
        }
        let before = crosser(&world, 0).crossings;
        world.run_for(SECOND * 30);
        assert!(crosser(&world, 0).crossings >= before + 5, "seed {seed}");
        crossings(&world, &crashes);
    }
}

#[test]
fn partitions() {
    for seed in 0..50 {
        let mut random = Random::keyed(seed, &[3]);
        let mut world = busy(4, seed, Wire::perfect());
        for _ in 0..10 {
            for link in 0..16 {
                if random.chance(0.3) {
                    world.wire.cut.insert((link / 4, link % 4));
                }
            }
            world.run_for(Duration::from_millis(u64::from(random.below(5000))));
            world.wire.cut.clear();
            let before = crosser(&world, 0).crossings;
            world.run_for(SECOND * 15);
            assert!(crosser(&world, 0).crossings >= before + 5, "seed {seed}");
        }
        crossings(&world, &[]);
    }
}

#[test]
fn late_joiners_are_waited_for() {
    for seed in 0..50 {
        let mut world = busy(2, seed, Wire::bad());
        for robot in 2..5 {
            world.run_for(SECOND * 10);
            world.join();
            world.run_for(SECOND * 10);
            assert!(crosser(&world, robot).crossings >= 1, "seed {seed}");
        }
        world.run_for(SECOND * 40);
        assert!(crosser(&world, 4).crossings >= 10, "seed {seed}");
        // A robot that joins has not arrived at earlier generations; from then on all are counted.
        for robot in 0..5 {
            let ahead = barrier(&world, robot).generation();
            assert!(ahead.abs_diff(barrier(&world, 4).generation()) <= 1);
        }
    }
}

#[test]
fn waiting_for_a_crashed_robot_is_reported_and_ends_when_it_returns() {
    for crashes_first in [true, false] {
        let mut world = idle(3, 1, Wire::perfect());
        for robot in 0..3 {
            world.command(robot, arrive());
        }
        world.run_for(SECOND * 20);
        assert!((0..3).all(|robot| barrier(&world, robot).passed()));
        if crashes_first {
            world.crash(1);
        }
        world.command(0, arrive());
        world.command(2, arrive());
        world.run_for(SECOND / 10);
        assert!(!barrier(&world, 0).failed());
        if !crashes_first {
            world.crash(1);
        }
        world.run_for(SECOND * 5);
        assert!(barrier(&world, 0).failed() && barrier(&world, 2).failed());
        world.start(1);
        world.run_for(SECOND * 2);
        assert!(!barrier(&world, 0).failed() && barrier(&world, 0).is_waiting());
        world.command(1, arrive());
        world.run_for(SECOND * 5);
        assert!((0..3).all(|robot| barrier(&world, robot).passed()));
    }
}

/// Those that wait for a crashed robot repeat their questions, and do not answer each other's again and again.
#[test]
fn robots_that_do_not_know_fall_silent() {
    let mut world = idle(6, 1, Wire::perfect());
    world.crash(5);
    (0..5).for_each(|robot| world.command(robot, arrive()));
    world.run_for(SECOND * 20);
    let before = world.sent_on("gate");
    world.run_for(SECOND * 40);
    // Every 4 s each.
    let sent = world.sent_on("gate") - before;
    assert!(sent <= 60, "{sent}");
}

#[test]
fn a_robot_that_crashes_at_the_barrier_has_arrived() {
    let mut world = idle(3, 1, Wire::perfect());
    (0..3).for_each(|robot| world.command(robot, arrive()));
    world.run_for(SECOND * 5);
    world.command(0, arrive());
    world.run_for(SECOND);
    world.crash(0);
    world.run_for(SECOND * 10);
    world.command(1, arrive());
    world.command(2, arrive());
    world.run_for(SECOND);
    assert!(barrier(&world, 1).passed() && barrier(&world, 2).passed());
}

#[test]
fn messages_are_as_many_as_the_theory_says() {
    for count in [3, 4, 5, 10, 20, 50, 100] {
        let make = Crosser::boxed(None, None);
        let mut world = World::new(count, 1, Wire::perfect(), None, make);
        let sent_for = |world: &mut World| {
            let before = world.sent_on("gate");
            for robot in 0..count {
                world.command(robot, arrive());
                world.run_for(Duration::from_millis(2));
            }
            world.run_for(Duration::from_millis(5));
            assert!((0..count).all(|robot| barrier(world, robot).passed()));
            world.sent_on("gate") - before
        };
        assert_eq!(
            sent_for(&mut world),
            3 * count - 2,
            "{count} robots, first crossing"
        );
        for _ in 0..3 {
            assert_eq!(sent_for(&mut world), count, "{count} robots");
        }
    }
}

#[test]
fn after_a_corruption_it_is_safe_again() {
    let mut slowest = Duration::ZERO;
    for seed in 0..150 {
        let mut world = busy(4, seed, Wire::perfect());
        world.run_for(SECOND * 10);
        let corrupted = Random::keyed(seed, &[5]).below(16);
        (0..4)
            .filter(|robot| corrupted >> robot & 1 == 1)
            .for_each(|robot| world.corrupt(robot));
        let begun = world.now;
        // In step: all wait for, or are on their way to, the same crossing or neighbouring ones, and know.
        let in_step = |world: &World| {
            let generations = (0..4).map(|robot| barrier(world, robot).generation());
            let (low, high) = (generations.clone().min(), generations.max());
            high.unwrap() <= low.unwrap() + 1
        };
        world.run_for(SECOND / 10);
        while !in_step(&world) {
            world.run_for(SECOND / 10);
            assert!(world.now.since(begun) < SECOND * 60, "seed {seed}");
        }
        slowest = slowest.max(world.now.since(begun));
        world.run_for(SECOND * 10);
        let before: Vec<u32> = (0..4)
            .map(|robot| crosser(&world, robot).crossings)
            .collect();
        world.records.clear();
        world.run_for(SECOND * 20);
        for (robot, before) in before.into_iter().enumerate() {
            let more = crosser(&world, robot).crossings - before;
            assert!(more >= 8, "seed {seed}: {more}");
        }
    }
    assert!(slowest <= Duration::from_millis(4500), "{slowest}");
}
