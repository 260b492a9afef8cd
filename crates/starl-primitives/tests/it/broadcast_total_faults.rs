//! A totally ordered broadcast when its leader dies, when the network is partitioned, when a robot is
//! away for long, when most robots stop at once, and when a robot joins late.

use crate::harness::teller::{Id, Step, Teller, runs, sequences, tell, teller, total_violation};
use crate::harness::{Wire, World};
use starl_core::{Duration, RobotId};
use starl_primitives::broadcast::{Gap, Order};

fn world(robots: usize, seed: u64) -> World {
    let make = Teller::boxed(Order::Total, 0, 0.0);
    let mut world = World::new(robots, seed, Wire::perfect(), None, make);
    world.run_for(Duration::from_seconds(3));
    world
}

fn leader(world: &World) -> usize {
    let led = world.events("lead");
    led.last().expect("someone leads").1.index()
}

/// Cuts these robots off from the others.
fn cut_off(world: &mut World, some: &[u32], robots: u32) {
    for &a in some {
        for b in (0..robots).filter(|b| !some.contains(b)) {
            world.wire.cut.extend([(a, b), (b, a)]);
        }
    }
}

fn handed(world: &World, robot: u32) -> Vec<Id> {
    let runs = runs(world, &[]);
    assert_eq!(total_violation(&runs), None);
    let mut all = sequences(&runs, 0).into_iter();
    all.find(|(number, _)| *number == robot)
        .map_or(Vec::new(), |(_, ids)| ids)
}

#[test]
fn the_sender_delivers_its_own_message_in_order() {
    for seed in 0..20 {
        let mut world = world(3, seed);
        for value in 0..20 {
            world.command(value as usize % 3, tell(value));
        }
        world.run_for(Duration::from_seconds(2));
        assert_eq!(handed(&world, 0).len(), 20);
        for robot in 1..3 {
            assert_eq!(handed(&world, robot), handed(&world, 0));
        }
    }
}

#[test]
fn it_continues_without_its_leader() {
    for seed in 0..50 {
        let mut world = world(3, seed);
        let dead = leader(&world);
        for value in 0..9 {
            world.command(value as usize % 3, tell(value));
            world.run_for(Duration::from_millis(seed % 3));
            if value == 4 {
                world.crash(dead);
            }
        }
        world.run_for(Duration::from_seconds(10));
        let left: Vec<u32> = (0..3).filter(|robot| *robot != dead as u32).collect();
        assert_eq!(
            handed(&world, left[0]),
            handed(&world, left[1]),
            "seed {seed}"
        );
        let of_left = handed(&world, left[0]);
        let of_left = of_left.iter().filter(|id| id.0 != dead as u32);
        assert_eq!(of_left.count(), 6, "seed {seed}");
    }
}

#[test]
fn a_minority_delivers_nothing_and_reports_it_until_the_partition_heals() {
    for seed in 0..20 {
        let mut world = world(5, seed);
        let minority = [leader(&world) as u32, (leader(&world) as u32 + 1) % 5];
        cut_off(&mut world, &minority, 5);
        world.command(minority[0] as usize, tell(1));
        world.command((minority[0] as usize + 2) % 5, tell(2));
        world.run_for(Duration::from_seconds(10));
        for robot in 0..5 {
            let is_cut_off = minority.contains(&robot);
            assert_eq!(
                teller(&world, robot as usize).failed(),
                is_cut_off,
                "seed {seed}"
            );
            assert_eq!(handed(&world, robot).len(), usize::from(!is_cut_off));
        }
        assert_eq!(
            world.events("unavailable").len(),
            2 + world.events("available").len()
        );
        world.wire.cut.clear();
        world.run_for(Duration::from_seconds(5));
        for robot in 0..5 {
            assert!(!teller(&world, robot).failed(), "seed {seed}");
            assert_eq!(handed(&world, robot as u32).len(), 2, "seed {seed}");
        }
    }
}

#[test]
fn messages_that_cannot_be_ordered_fail_in_the_end() {
    let mut world = world(3, 1);
    cut_off(&mut world, &[0], 3);
    world.command(0, tell(1));
    world.run_for(Duration::from_seconds(60));
    let failures = teller(&world, 0).clone().take_failures();
    assert_eq!(failures.len(), 1);
    assert!(!teller(&world, 0).is_outstanding(failures[0].message));
}

/// Robot 2 is away while so many messages are ordered.
fn absence(messages: u32) -> World {
    let mut world = world(3, 5);
    cut_off(&mut world, &[2], 3);
    for value in 0..messages {
        world.command(value as usize % 2, tell(value));
        world.run_for(Duration::from_millis(20));
    }
    world.run_for(Duration::from_seconds(2));
    world.wire.cut.clear();
    world.run_for(Duration::from_seconds(10));
    world.command(0, tell(messages));
    world.run_for(Duration::from_seconds(2));
    world
}

#[test]
fn a_robot_that_was_away_catches_up() {
    let world = absence(400);
    assert_eq!(handed(&world, 2).len(), 401);
    assert!(world.events("gap").is_empty());
}

#[test]
fn a_robot_that_was_away_for_too_long_gets_a_gap() {
    let messages = 3500; // more than a minute
    let world = absence(messages);
    assert_eq!(handed(&world, 0).len(), messages as usize + 1);
    let late = handed(&world, 2);
    assert!((1..600).contains(&late.len()), "{}", late.len());
    assert_eq!(late.last(), handed(&world, 0).last());
    let gaps = world.events("gap");
    assert_eq!(gaps.len(), 1);
    assert_eq!(gaps[0].1, RobotId(2));
    assert_eq!(teller(&world, 2).clone().take_gaps(), [Gap { from: None }]);
}

#[test]
fn a_group_that_has_lost_its_majority_is_followed_by_another() {
    for seed in 0..50 {
        let mut world = world(5, seed);
        world.command(0, tell(1));
        world.run_for(Duration::from_seconds(1));
        for robot in 0..3 {
            world.crash(robot);
        }
        world.run_for(Duration::from_millis(100 + 77 * seed));
        let restart = world.now;
        for robot in 0..3 {
            world.start(robot);
        }
        world.run_for(Duration::from_seconds(20));
        world.command(1, tell(2));
        world.run_for(Duration::from_seconds(2));
        let runs = runs(&world, &[(restart, 0), (restart, 1), (restart, 2)]);
        assert_eq!(total_violation(&runs), None, "seed {seed}");
        let last = |steps: &[(usize, Step)]| steps.last().map(|(_, step)| step.clone());
        let last: Vec<_> = runs[runs.len() - 3..]
            .iter()
            .map(|run| last(&run.1))
            .collect();
        assert_eq!(last[0], last[1], "seed {seed}");
        for robot in 0..5 {
            assert!(!teller(&world, robot).failed(), "seed {seed}");
        }
        // The members of the earlier group report that they may have missed messages.
        assert!(world.events("gap").len() >= 2, "seed {seed}");
    }
}

#[test]
fn a_late_joiner_gets_the_messages_from_then_on() {
    let mut world = world(3, 6);
    for value in 0..700 {
        world.command(0, tell(value));
        world.run_for(Duration::from_millis(10));
    }
    world.join();
    world.run_for(Duration::from_seconds(5));
    world.command(1, tell(1));
    world.command(3, tell(1));
    world.run_for(Duration::from_seconds(2));
    assert_eq!(handed(&world, 3), handed(&world, 0)[700..]);
    assert!(world.events("gap").is_empty(), "that is no loss");
}
