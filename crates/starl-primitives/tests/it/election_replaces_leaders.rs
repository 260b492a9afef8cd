//! A failed leader is replaced within a bound; a leader that returns, and robots that join late, learn the new leader.

use crate::harness::elector::{ALGORITHMS, Elector, agreed, by, election, judge};
use crate::harness::{Wire, World};
use starl_core::{Duration, Time};
use starl_primitives::election::Algorithm;

const SECOND: Duration = Duration::from_seconds(1);

fn agreeing(count: usize, seed: u64, algorithm: Algorithm, wire: Wire) -> World {
    let mut world = World::new(count, seed, wire, None, Elector::eager(by(algorithm)));
    world.run_for(SECOND * 30);
    world
}

/// Runs until these agree on another leader than this; gives the time it took.
fn replaced(world: &mut World, rest: &[usize], leader: Option<u32>) -> Duration {
    let since = world.now;
    while agreed(world, rest).is_none() || agreed(world, rest) == leader {
        world.run_for(Duration::from_millis(10));
        assert!(world.now.since(since) < SECOND * 120, "no other leader");
    }
    world.now.since(since)
}

#[test]
fn a_leader_that_crashes_is_replaced() {
    // Without a detector the others wait for the leader's patience; with leases always for the lease.
    let bounds = [
        (Algorithm::Leases, false, 5),
        (Algorithm::Ballots, true, 4),
        (Algorithm::Ballots, false, 11),
        (Algorithm::Bully, true, 5),
        (Algorithm::Bully, false, 7),
    ];
    for (algorithm, has_detector, bound) in bounds {
        let mut longest = Duration::ZERO;
        for seed in 0..100 {
            let make = Elector::boxed(by(algorithm), None, true, has_detector);
            let mut world = World::new(5, seed, Wire::perfect(), None, make);
            world.run_for(SECOND * 30);
            let leader = agreed(&world, &[0, 1, 2, 3, 4]).expect("a leader");
            world.crash(leader as usize);
            let rest: Vec<usize> = (0..5).filter(|&robot| robot != leader as usize).collect();
            longest = longest.max(replaced(&mut world, &rest, Some(leader)));
        }
        println!("{algorithm:?}, detector {has_detector}: {longest}");
        assert!(longest < SECOND * bound, "{algorithm:?}: {longest}");
    }
}

#[test]
fn over_a_bad_network_too() {
    for algorithm in ALGORITHMS {
        let (mut longest, mut sum) = (Duration::ZERO, Duration::ZERO);
        for seed in 0..100 {
            let mut world = agreeing(5, seed, algorithm, Wire::bad());
            replaced(&mut world, &[0, 1, 2, 3, 4], None);
            let leader = agreed(&world, &[0, 1, 2, 3, 4]).expect("a leader");
            world.crash(leader as usize);
            let rest: Vec<usize> = (0..5).filter(|&robot| robot != leader as usize).collect();
            let took = replaced(&mut world, &rest, Some(leader));
            longest = longest.max(took);
            sum = sum + took;
        }
        println!("{algorithm:?}: mean {}, longest {longest}", sum / 100);
        assert!(longest < SECOND * 35, "{algorithm:?}: {longest}");
    }
}

/// The leader restarts at once, so that it was never missed.
#[test]
fn a_leader_that_has_forgotten_that_it_leads_does_no_harm() {
    for algorithm in ALGORITHMS {
        for seed in 0..50 {
            let mut world = agreeing(5, seed, algorithm, Wire::perfect());
            let leader = agreed(&world, &[0, 1, 2, 3, 4]).expect("a leader") as usize;
            let crashes = [(world.records.len(), leader as u32)];
            world.crash(leader);
            world.start(leader);
            world.run_for(SECOND * 12);
            assert!(agreed(&world, &[0, 1, 2, 3, 4]).is_some(), "{algorithm:?}");
            if algorithm == Algorithm::Leases {
                assert_eq!(judge(&world, &crashes).len(), 2);
            }
        }
    }
}

#[test]
fn late_joiners_learn_the_leader_and_do_not_disturb() {
    for algorithm in ALGORITHMS {
        for seed in 0..50 {
            let mut world = agreeing(3, seed, algorithm, Wire::perfect());
            let before = agreed(&world, &[0, 1, 2]);
            world.join();
            world.run_for(SECOND);
            world.join();
            world.run_for(SECOND * 10);
            let after = agreed(&world, &[0, 1, 2, 3, 4]);
            match algorithm {
                // The greatest takes over.
                Algorithm::Bully => assert_eq!(after, Some(4)),
                _ => assert_eq!(after, before, "{algorithm:?}, seed {seed}"),
            }
        }
    }
}

/// A robot that restarts does not vote before a lease has passed and it has asked those that remember.
#[test]
fn with_leases_a_robot_that_restarts_votes_only_after_a_lease() {
    for seed in 0..50 {
        let mut world = agreeing(3, seed, Algorithm::Leases, Wire::perfect());
        let leader = agreed(&world, &[0, 1, 2]).expect("a leader") as usize;
        let follower = (leader + 1) % 3;
        world.crash(follower);
        world.start(follower);
        let (restart, crashed) = (world.now, world.records.len());
        world.run_for(SECOND);
        assert_eq!(
            election(&world, follower).leader(),
            Some(starl_core::RobotId(leader as u32))
        );
        // It alone could give the third robot a majority.
        world.crash(leader);
        world.run_for(SECOND * 10);
        let crashes = [(crashed, leader as u32)];
        assert!(judge(&world, &crashes).len() == 1 || world.records.len() > crashed);
        let votes: Vec<Time> = world
            .events("vote")
            .iter()
            .filter(|(at, who, _)| *at >= restart && who.0 == follower as u32)
            .map(|(at, ..)| *at)
            .collect();
        assert!(
            votes.iter().all(|&at| at.since(restart) >= SECOND * 3),
            "{votes:?}"
        );
    }
}

/// Of three robots one is down and one has restarted: the promises of the one that is down are unknown, so
/// there is no leader until it returns. Waiting is the only safe behaviour.
#[test]
fn with_leases_there_is_no_leader_if_too_few_robots_have_memory() {
    let mut world = agreeing(3, 1, Algorithm::Leases, Wire::perfect());
    let leader = agreed(&world, &[0, 1, 2]).expect("a leader") as usize;
    let (other, third) = ((leader + 1) % 3, (leader + 2) % 3);
    world.crash(leader);
    world.crash(other);
    world.start(other);
    world.run_for(SECOND * 60);
    assert!(election(&world, other).leader().is_none() && election(&world, other).failed());
    assert!(election(&world, third).leader().is_none() && election(&world, third).failed());
    world.start(leader);
    world.run_for(SECOND * 10);
    assert!(agreed(&world, &[0, 1, 2]).is_some());
}

/// A robot that was down when the others started again joins them, and then remembers as much as they do: a
/// robot that restarts after that can learn from it, although another one is down.
#[test]
fn with_leases_a_robot_that_joins_restarted_ones_remembers_as_they_do() {
    for seed in 0..20 {
        let make = Elector::eager(by(Algorithm::Leases));
        let mut world = World::new(4, seed, Wire::perfect(), None, make);
        let restart_at = |world: &mut World, robot: usize, milliseconds: u64| {
            let until = Time(milliseconds * 1_000_000);
            world.run_for(until.since(world.now));
            world.crash(robot);
            world.run_for(Duration::from_millis(90));
            world.start(robot);
        };
        restart_at(&mut world, 2, 1970);
        restart_at(&mut world, 1, 3060);
        world.run_for(SECOND * 3 - Duration::from_millis(30));
        world.crash(3);
        world.run_for(SECOND * 10);
        assert!(agreed(&world, &[0, 1, 2]).is_some(), "seed {seed}");
    }
}
