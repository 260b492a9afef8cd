//! Without faults, all robots show the same leader and keep it.

use crate::harness::elector::{ALGORITHMS, ELECT, Elector, RESIGN, agreed, by, election, judge};
use crate::harness::{Wire, World};
use starl_core::{Duration, RobotId};
use starl_primitives::election::{Algorithm, Options};

const SECOND: Duration = Duration::from_seconds(1);

fn world(count: usize, seed: u64, algorithm: Algorithm) -> World {
    World::new(
        count,
        seed,
        Wire::perfect(),
        None,
        Elector::eager(by(algorithm)),
    )
}

fn everyone(count: usize) -> Vec<usize> {
    (0..count).collect()
}

#[test]
fn all_show_the_same_leader() {
    for algorithm in ALGORITHMS {
        for count in [1, 2, 3, 4, 5, 10, 30] {
            for seed in 0..10 {
                let mut world = world(count, seed, algorithm);
                world.run_for(SECOND * 5);
                let leader = agreed(&world, &everyone(count));
                assert!(
                    leader.is_some(),
                    "{algorithm:?}, {count} robots, seed {seed}"
                );
                world.run_for(SECOND * 60);
                assert_eq!(agreed(&world, &everyone(count)), leader);
                let changes = world.events("leader").len();
                assert_eq!(changes, count, "{algorithm:?}, {count} robots, seed {seed}");
                assert!(world.events("lost").is_empty() && world.events("fail").is_empty());
                assert!((0..count).all(|robot| !election(&world, robot).failed()));
            }
        }
    }
}

#[test]
fn with_bully_the_greatest_leads() {
    let mut world = world(7, 1, Algorithm::Bully);
    world.run_for(SECOND);
    assert_eq!(agreed(&world, &everyone(7)), Some(6));
}

#[test]
fn with_ballots_any_may_lead() {
    let mut led = [0; 4];
    for seed in 0..400 {
        let mut world = world(4, seed, Algorithm::Ballots);
        world.run_for(SECOND);
        led[agreed(&world, &everyone(4)).unwrap() as usize] += 1;
    }
    // Four deviations of a binomial distribution with mean 100.
    assert!(
        led.iter().all(|&count| (65..=135).contains(&count)),
        "{led:?}"
    );
}

#[test]
fn ties_are_drawn_again() {
    for seed in 0..50 {
        let options = Options {
            ballots: 2,
            ..by(Algorithm::Ballots)
        };
        let mut world = World::new(5, seed, Wire::perfect(), None, Elector::eager(options));
        world.run_for(SECOND);
        assert!(agreed(&world, &everyone(5)).is_some(), "seed {seed}");
    }
}

#[test]
fn a_leader_that_resigns_is_replaced_and_stands_again_when_told_so() {
    for algorithm in ALGORITHMS {
        for seed in 0..20 {
            let mut world = world(4, seed, algorithm);
            let mut rest = everyone(4);
            world.run_for(SECOND * 8);
            let first = agreed(&world, &rest).unwrap() as usize;
            world.command(first, RESIGN);
            assert_eq!(election(&world, first).leader(), None);
            world.run_for(SECOND * 8);
            let second = agreed(&world, &rest).unwrap() as usize;
            assert_ne!(first, second, "{algorithm:?}, seed {seed}");
            rest.retain(|&robot| robot != first);
            world.command(first, ELECT);
            world.run_for(SECOND * 8);
            assert!(agreed(&world, &everyone(4)).is_some());
        }
    }
}

#[test]
fn a_robot_that_does_not_stand_does_not_lead_but_learns_the_leader() {
    for algorithm in ALGORITHMS {
        for seed in 0..20 {
            let make = Elector::boxed(by(algorithm), None, false, true);
            let mut world = World::new(4, seed, Wire::perfect(), None, make);
            world.run_for(SECOND * 5);
            assert_eq!(agreed(&world, &everyone(4)), None);
            world.command(1, ELECT);
            world.command(2, ELECT);
            world.run_for(SECOND * 10);
            let leader = agreed(&world, &everyone(4));
            assert!(matches!(leader, Some(1 | 2)), "{algorithm:?}: {leader:?}");
        }
    }
}

#[test]
fn only_participants_take_part() {
    for algorithm in ALGORITHMS {
        let participants = [0, 2, 3].map(RobotId).into();
        let make = Elector::boxed(by(algorithm), Some(participants), true, true);
        let mut world = World::new(5, 1, Wire::perfect(), None, make);
        world.run_for(SECOND * 20);
        let leader = agreed(&world, &everyone(5));
        assert!(
            matches!(leader, Some(0 | 2 | 3)),
            "{algorithm:?}: {leader:?}"
        );
        for robot in 0..5 {
            let is_participant = [0, 2, 3].contains(&robot);
            assert_eq!(election(&world, robot).stands(), is_participant);
            assert_eq!(election(&world, robot).failed(), !is_participant);
        }
    }
}

#[test]
fn with_leases_each_leadership_has_a_later_epoch() {
    for seed in 0..20 {
        let mut world = world(3, seed, Algorithm::Leases);
        for _ in 0..10 {
            world.run_for(SECOND * 8);
            let leader = agreed(&world, &everyone(3)).unwrap() as usize;
            assert_eq!(
                election(&world, 0).epoch(),
                election(&world, leader).epoch()
            );
            world.command(leader, RESIGN);
            world.command(leader, ELECT);
        }
        assert!(judge(&world, &[]).len() >= 10);
    }
}
