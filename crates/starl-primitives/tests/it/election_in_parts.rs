//! Where the network falls apart: with leases only the part with a majority has a leader, with ballots and
//! bully each part has one; and when the parts meet again all agree.

use crate::harness::elector::{ALGORITHMS, Elector, RESIGN, agreed, by, election, judge, leaders};
use crate::harness::{Wire, World};
use starl_core::Duration;
use starl_primitives::election::Algorithm;
use std::collections::BTreeSet;

const SECOND: Duration = Duration::from_seconds(1);
const ALL: [usize; 5] = [0, 1, 2, 3, 4];

fn world(seed: u64, algorithm: Algorithm) -> World {
    let mut world = World::new(
        5,
        seed,
        Wire::perfect(),
        None,
        Elector::eager(by(algorithm)),
    );
    world.run_for(SECOND * 10);
    world
}

/// Nothing passes between these and the others.
fn part(world: &mut World, robots: &[usize]) {
    for from in ALL {
        for to in ALL {
            if robots.contains(&from) != robots.contains(&to) {
                world.wire.cut.insert((from as u32, to as u32));
            }
        }
    }
}

#[test]
fn with_leases_the_leader_stays_in_the_greater_part_and_the_others_show_none() {
    for seed in 0..50 {
        let mut world = world(seed, Algorithm::Leases);
        let leader = agreed(&world, &ALL).unwrap() as usize;
        let lesser: Vec<usize> = ALL
            .into_iter()
            .filter(|&robot| robot != leader)
            .take(2)
            .collect();
        let greater: Vec<usize> = ALL
            .into_iter()
            .filter(|robot| !lesser.contains(robot))
            .collect();
        part(&mut world, &lesser);
        world.run_for(SECOND * 4);
        assert_eq!(leaders(&world, &lesser), [None, None]);
        world.run_for(SECOND * 20);
        assert_eq!(agreed(&world, &greater), Some(leader as u32));
        assert_eq!(leaders(&world, &lesser), [None, None]);
        assert!(lesser.iter().all(|&robot| election(&world, robot).failed()));
        assert!(
            greater
                .iter()
                .all(|&robot| !election(&world, robot).failed())
        );
        world.wire.cut.clear();
        world.run_for(SECOND * 5);
        // Robots that stand without success do not disturb the leader.
        assert_eq!(agreed(&world, &ALL), Some(leader as u32), "seed {seed}");
        assert!(
            lesser
                .iter()
                .all(|&robot| !election(&world, robot).failed())
        );
        judge(&world, &[]);
    }
}

#[test]
fn with_leases_a_leader_that_is_cut_off_stops_before_another_leads() {
    for seed in 0..50 {
        let mut world = world(seed, Algorithm::Leases);
        let leader = agreed(&world, &ALL).unwrap() as usize;
        let rest: Vec<usize> = ALL.into_iter().filter(|&robot| robot != leader).collect();
        part(&mut world, &[leader]);
        world.run_for(SECOND * 3);
        assert_eq!(election(&world, leader).leader(), None);
        world.run_for(SECOND * 3);
        let second = agreed(&world, &rest);
        assert!(second.is_some(), "seed {seed}");
        world.wire.cut.clear();
        world.run_for(SECOND * 5);
        assert_eq!(agreed(&world, &ALL), second);
        assert_eq!(judge(&world, &[]).last().map(|&(_, leader)| leader), second);
    }
}

#[test]
fn with_leases_a_robot_that_can_send_but_not_hear_holds_no_votes() {
    for seed in 0..50 {
        let mut world = world(seed, Algorithm::Leases);
        let leader = agreed(&world, &ALL).unwrap() as usize;
        let deaf = (leader + 1) % ALL.len();
        let hears = |robot: usize| robot != leader && robot != deaf;
        let rest: Vec<usize> = ALL.into_iter().filter(|&robot| hears(robot)).collect();
        for from in ALL {
            world.wire.cut.insert((from as u32, deaf as u32));
        }
        world.run_for(SECOND * 10);
        world.command(leader, RESIGN);
        world.run_for(SECOND * 15);
        assert!(agreed(&world, &rest).is_some(), "seed {seed}");
        judge(&world, &[]);
    }
}

#[test]
fn with_leases_no_robot_leads_without_a_majority() {
    let mut world = world(1, Algorithm::Leases);
    part(&mut world, &[0, 1]);
    for (from, to) in [(2, 3), (2, 4)] {
        world.wire.cut.extend([(from, to), (to, from)]);
    }
    world.run_for(SECOND * 20);
    assert_eq!(leaders(&world, &ALL), [None; 5]);
    assert!(ALL.iter().all(|&robot| election(&world, robot).failed()));
    world.wire.cut.clear();
    world.run_for(SECOND * 10);
    assert!(agreed(&world, &ALL).is_some());
    judge(&world, &[]);
}

#[test]
fn with_ballots_and_bully_each_part_has_a_leader_until_they_meet() {
    for algorithm in [Algorithm::Ballots, Algorithm::Bully] {
        for seed in 0..50 {
            let mut world = world(seed, algorithm);
            part(&mut world, &[0, 3]);
            world.run_for(SECOND * 20);
            let one = agreed(&world, &[0, 3]).expect("a leader");
            let other = agreed(&world, &[1, 2, 4]).expect("a leader");
            assert_ne!(one, other);
            world.wire.cut.clear();
            world.run_for(SECOND * 20);
            assert!(agreed(&world, &ALL).is_some(), "{algorithm:?}, seed {seed}");
        }
    }
}

/// A link in one direction only is the hardest case for robots that believe what they hear.
#[test]
fn links_that_carry_one_way_only_do_no_harm() {
    for algorithm in ALGORITHMS {
        for seed in 0..20 {
            let mut world = world(seed, algorithm);
            let leader = agreed(&world, &ALL).unwrap();
            for peer in 0..5 {
                world.wire.cut.insert((peer, leader));
            }
            world.run_for(SECOND * 30);
            world.wire.cut.clear();
            world.run_for(SECOND * 20);
            assert!(agreed(&world, &ALL).is_some(), "{algorithm:?}, seed {seed}");
            if algorithm == Algorithm::Leases {
                judge(&world, &[]);
            }
        }
    }
}

#[test]
fn of_two_leaders_by_ballots_all_follow_the_greater_one_though_their_words_cross() {
    for seed in 0..60 {
        let make = Elector::eager(by(Algorithm::Ballots));
        let mut world = World::new(5, seed, Wire::delayed(100), None, make);
        world.run_for(SECOND * 10);
        let leader = agreed(&world, &ALL).expect("a leader") as usize;
        part(&mut world, &[leader]);
        world.run_for(SECOND * 20);
        let shown: BTreeSet<u32> = leaders(&world, &ALL).into_iter().flatten().collect();
        assert_eq!(shown.len(), 2, "seed {seed}");
        world.wire.cut.clear();
        world.run_for(SECOND * 2);
        assert!(agreed(&world, &ALL).is_some(), "seed {seed}");
    }
}
