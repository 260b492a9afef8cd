//! From an arbitrary state of all robots elections recover, within a time that is measured here and stated in the
//! reference.

use crate::harness::elector::{ALGORITHMS, Elector, agreed, by, judge};
use crate::harness::{self, Wire, World};
use starl_core::{Duration, Time};
use starl_primitives::election::Algorithm;

const SECOND: Duration = Duration::from_seconds(1);
const PERIOD: Option<Duration> = Some(Duration::from_millis(100));
/// The figures in the reference are of 500.
const SEEDS: u64 = 100;
const ALL: [usize; 5] = [0, 1, 2, 3, 4];

/// A fleet whose state has just been overwritten.
fn corrupted(algorithm: Algorithm, seed: u64, wire: Wire) -> World {
    let make = Elector::eager(by(algorithm));
    let mut world = World::new(5, seed, wire, PERIOD, make);
    world.run_for(SECOND * 20);
    world.records.clear();
    ALL.into_iter().for_each(|robot| world.corrupt(robot));
    world
}

/// How long after the corruption the robots are without an agreed leader for the last time, in half a minute.
fn time_to_recover(world: &mut World) -> Duration {
    let since = world.now;
    let mut last = since;
    while world.now.since(since) < SECOND * 30 {
        world.run_for(Duration::from_millis(20));
        if agreed(world, &ALL).is_none() {
            last = world.now;
        }
    }
    last.since(since)
}

#[test]
fn all_agree_within_ten_seconds() {
    for algorithm in ALGORITHMS {
        let mut times: Vec<Duration> = (0..SEEDS)
            .map(|seed| time_to_recover(&mut corrupted(algorithm, seed, Wire::perfect())))
            .collect();
        times.sort_unstable();
        let (median, longest) = (times[times.len() / 2], times[times.len() - 1]);
        println!("{algorithm:?}: median {median}, longest {longest}");
        assert!(longest <= SECOND * 10, "{algorithm:?}: {longest}");
    }
}

/// Invented state of a corruption is forgotten after a lease: from then on no two robots lead at once, and
/// epochs grow.
#[test]
fn with_leases_all_is_safe_again_after_two_leases() {
    for seed in 0..SEEDS {
        let mut world = corrupted(Algorithm::Leases, seed, Wire::bad());
        let since: Time = world.now;
        world.run_for(SECOND * 6);
        // A robot that leads by then has its own epoch; earlier leaders are not judged.
        let mut leading: Vec<u32> = Vec::new();
        for robot in ALL {
            let election = harness::elector::election(&world, robot);
            if election
                .leader()
                .is_some_and(|leader| leader.index() == robot)
            {
                leading.push(robot as u32);
            }
        }
        assert!(
            leading.len() <= 1,
            "seed {seed}: {leading:?} lead, corrupted at {since}"
        );
        world.records.clear();
        for robot in ALL {
            world.command(robot, harness::elector::ELECT);
        }
        world.run_for(SECOND * 60);
        judge(&world, &[]);
    }
}
