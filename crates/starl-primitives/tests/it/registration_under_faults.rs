//! Under all faults of the network and all crashes and restarts: there are no two lists of one time, no two robots that
//! list each other with different lists, and no robot in a list without registration. After the faults all robots
//! eventually show the same list.

use crate::harness::registrar::{
    Registrar, agree, judge, list, register, registration, unregister,
};
use crate::harness::{Wire, World};
use starl_core::{Duration, Input, Message, Port, Random, RobotId, Time};
use starl_primitives::registration::Options;
use std::collections::BTreeSet;

const SECOND: Duration = Duration::from_seconds(1);
const PERIOD: Option<Duration> = Some(Duration::from_millis(100));

fn world(count: usize, seed: u64, wire: Wire, is_busy: bool) -> World {
    let make = Registrar::boxed(is_busy, Options::default());
    World::new(count, seed, wire, PERIOD, make)
}

fn checked(world: &World, crashes: &[(usize, u32)]) -> usize {
    judge(world, crashes, Options::default().settle)
}

/// Those that take part, in the order of their numbers.
fn registered(world: &World, count: usize) -> Vec<u32> {
    let takes_part = |&robot: &usize| registration(world, robot).is_registered();
    (0..count)
        .filter(takes_part)
        .map(|robot| robot as u32)
        .collect()
}

/// Runs until all that take part agree, and gives how long that took.
fn settles(world: &mut World, count: usize, within: Duration) -> Option<Duration> {
    let begun = world.now;
    while world.now <= begun + within {
        let all = registered(world, count);
        if all.is_empty() || agree(world, &all) {
            return Some(world.now.since(begun));
        }
        world.run_for(SECOND / 10);
    }
    None
}

fn quiet(world: &mut World) {
    world.wire = Wire::perfect();
    world.wire.cut.clear();
}

#[test]
fn loss_duplication_and_reordering() {
    for seed in 0..100 {
        let mut world = world(4, seed, Wire::bad(), false);
        (0..4).for_each(|robot| world.command(robot, register()));
        let after = settles(&mut world, 4, SECOND * 60);
        assert!(after.is_some(), "seed {seed}");
        checked(&world, &[]);
    }
}

#[test]
fn robots_register_and_leave_on_a_bad_network() {
    let mut lists = 0;
    for seed in 0..100 {
        let mut world = world(4, seed, Wire::bad(), true);
        world.run_for(SECOND * 60);
        lists += checked(&world, &[]);
    }
    assert!(lists > 2500, "{lists}");
}

#[test]
fn partitions_begin_and_heal() {
    for seed in 0..100 {
        let mut random = Random::keyed(seed, &[3]);
        let mut world = world(5, seed, Wire::perfect(), false);
        (0..5).for_each(|robot| world.command(robot, register()));
        for _ in 0..6 {
            let side: Vec<bool> = (0..5).map(|_| random.chance(0.5)).collect();
            for one in 0..5u32 {
                for other in 0..5u32 {
                    if side[one as usize] != side[other as usize] {
                        world.wire.cut.insert((one, other));
                    }
                }
            }
            // A detector that was wrong before is patient: up to 15 s.
            world.run_for(SECOND * 30);
            for part in [true, false] {
                let part: Vec<u32> = (0..5)
                    .filter(|&robot| side[robot as usize] == part)
                    .collect();
                assert!(
                    part.is_empty() || agree(&world, &part),
                    "seed {seed}: {part:?}"
                );
            }
            world.wire.cut.clear();
            world.run_for(Duration::from_millis(u64::from(random.below(10_000))));
        }
        world.run_for(SECOND * 20);
        assert!(agree(&world, &[0, 1, 2, 3, 4]), "seed {seed}");
        checked(&world, &[]);
    }
}

/// Links that work in one direction only, any of them, for any time.
#[test]
fn links_that_work_one_way() {
    for seed in 0..100 {
        let mut random = Random::keyed(seed, &[4]);
        let mut world = world(4, seed, Wire::perfect(), seed % 2 == 0);
        if seed % 2 == 1 {
            (0..4).for_each(|robot| world.command(robot, register()));
        }
        for _ in 0..30 {
            let link = (random.below(4), random.below(4));
            if !world.wire.cut.remove(&link) {
                world.wire.cut.insert(link);
            }
            world.run_for(Duration::from_millis(u64::from(random.below(5000))));
        }
        checked(&world, &[]);
        if seed % 2 == 1 {
            quiet(&mut world);
            let after = settles(&mut world, 4, SECOND * 300);
            assert!(after.is_some(), "seed {seed}");
        }
    }
}

#[test]
fn crashes_and_restarts() {
    for seed in 0..100 {
        let mut random = Random::keyed(seed, &[7]);
        let mut world = world(4, seed, Wire::bad(), true);
        let mut crashes = Vec::new();
        for _ in 0..30 {
            let robot = random.below(4) as usize;
            world.run_for(Duration::from_millis(u64::from(random.below(4000))));
            world.crash(robot);
            crashes.push((world.records.len(), robot as u32));
            world.run_for(Duration::from_millis(u64::from(random.below(2000))));
            world.start(robot);
        }
        checked(&world, &crashes);
    }
}

#[test]
fn after_crashes_and_restarts_all_agree() {
    for seed in 0..100 {
        let mut random = Random::keyed(seed, &[8]);
        let mut world = world(5, seed, Wire::bad(), false);
        (0..5).for_each(|robot| world.command(robot, register()));
        let mut crashes = Vec::new();
        for _ in 0..10 {
            let robot = random.below(5) as usize;
            world.run_for(Duration::from_millis(u64::from(random.below(3000))));
            world.crash(robot);
            crashes.push((world.records.len(), robot as u32));
            world.run_for(Duration::from_millis(u64::from(random.below(3000))));
            world.start(robot);
            if random.chance(0.7) {
                world.command(robot, register());
            }
        }
        let after = settles(&mut world, 5, SECOND * 120);
        assert!(after.is_some(), "seed {seed}");
        checked(&world, &crashes);
    }
}

#[test]
fn robots_that_join_late() {
    for seed in 0..100 {
        let mut world = world(2, seed, Wire::bad(), false);
        (0..2).for_each(|robot| world.command(robot, register()));
        for robot in 2..6 {
            world.run_for(SECOND * 10);
            world.join();
            world.command(robot, register());
        }
        let after = settles(&mut world, 6, SECOND * 60);
        assert!(after.is_some(), "seed {seed}");
        assert_eq!(list(&world, 5).unwrap().len(), 6);
        world.command(3, unregister());
        world.run_for(SECOND * 2);
        assert!(settles(&mut world, 6, SECOND * 60).is_some());
        assert_eq!(list(&world, 5).unwrap(), [0, 1, 2, 4, 5]);
        checked(&world, &[]);
    }
}

/// Robots whose clocks are hours apart: the times of lists still rise.
#[test]
fn clocks_that_are_off() {
    for seed in 0..100 {
        let mut random = Random::keyed(seed, &[9]);
        let mut world = world(4, seed, Wire::bad(), true);
        for robot in 0..4 {
            let ahead = i64::from(random.below(7200)) * 1_000_000_000;
            world.set_clock_ahead(robot as usize, ahead);
        }
        world.run_for(SECOND * 60);
        checked(&world, &[]);
        let shown = registration(&world, 0).view_id();
        assert!(shown.is_none_or(|id| id.coordinator <= RobotId(3)));
    }
}

/// Messages that arrive several seconds late named registrations before the last one of their robot. These were
/// believed again, and each held up the others until its robot denied it.
#[test]
fn late_messages_bring_back_no_registration_that_is_over() {
    let mut world = world(2, 1, Wire::perfect(), false);
    world.command(0, register());
    let announced = world.payloads().last().cloned().expect("an announcement");
    world.run_for(SECOND);
    world.command(1, register());
    for command in [unregister(), register(), unregister()] {
        world.run_for(SECOND * 2);
        world.command(0, command);
    }
    world.run_for(SECOND * 12);
    assert!(agree(&world, &[1]));
    let shown = registration(&world, 1).view_id();
    let late = Message {
        from: RobotId(0),
        port: Port::named("who"),
        payload: announced,
    };
    for _ in 0..100 {
        world.input(1, &Input::Message(late.clone()));
        world.run_for(SECOND / 50);
        assert_eq!(registration(&world, 1).view_id(), shown);
    }
}

/// A robot that hears the others and is not heard waited for each of them in turn, longer than it left the first of
/// them out, so that it waited for that one again. It also waited for each that registered again.
#[test]
fn a_robot_that_is_not_heard_shows_a_list_of_itself() {
    for count in [3, 5, 10] {
        for (seed, is_busy) in [(0, false), (1, false), (2, true), (3, true)] {
            let mut world = world(count, seed, Wire::perfect(), is_busy);
            let last = count - 1;
            for other in 0..last {
                world.wire.cut.insert((last as u32, other as u32));
                world.command(other, register());
            }
            world.run_for(SECOND * 2);
            let (begun, mut without) = (world.now, Duration::ZERO);
            while world.now.since(begun) < SECOND * 300 && without < SECOND * 25 {
                let is_new = !registration(&world, last).is_registered();
                world.command(last, register());
                world.run_for(SECOND / 10);
                let shows = list(&world, last).is_some();
                without = without + SECOND / 10;
                if is_new || shows {
                    without = Duration::ZERO;
                }
            }
            assert!(without < SECOND * 25, "{count} robots, seed {seed}");
        }
    }
}

/// Two coordinators dated their lists alike to the nanosecond. A robot that had restarted was in both lists, in one
/// with each of its lives.
#[test]
fn lists_of_two_coordinators_never_have_the_same_time() {
    for seed in 0..20 {
        let mut world = world(4, seed, Wire::perfect(), false);
        (0..4).for_each(|robot| world.wire.isolate(robot, 4));
        (0..4).for_each(|robot| world.command(robot, register()));
        world.run_for(SECOND);
        let times = (0..4).filter_map(|robot| registration(&world, robot).agreed_at());
        let times: BTreeSet<Time> = times.collect();
        assert_eq!(times.len(), 4, "{times:?}");
    }
}
