//! Large fleets find a leader although a third of the datagrams is lost and a fifth arrives 10 s late.

use crate::harness::elector::{ALGORITHMS, Elector, RESIGN, by, election};
use crate::harness::{Wire, World};
use starl_core::Duration;
use starl_core::event::agreement::Algorithm;

const SECOND: Duration = Duration::from_seconds(1);
const STEP: Duration = Duration::from_millis(50);

fn late() -> Wire {
    Wire {
        loss: 0.3,
        duplication: 0.3,
        delay_ms: (10, 20),
        late: (0.2, 10_000),
        ..Wire::perfect()
    }
}

/// Runs until each of these robots has shown a leader other than `gone`; gives the time it took.
fn led(world: &mut World, robots: &[usize], gone: Option<usize>) -> Duration {
    let since = world.now;
    let mut waiting = robots.to_vec();
    while !waiting.is_empty() {
        world.run_for(STEP);
        assert!(world.now.since(since) < SECOND * 200, "no leader");
        let is_leader = |&robot: &usize| {
            let leader = election(world, robot).leader();
            leader.is_some_and(|leader| Some(leader.index()) != gone)
        };
        waiting.retain(|robot| !is_leader(robot));
    }
    world.now.since(since)
}

/// Candidates that miss each other's claims outbid each other, but not for ever.
#[test]
fn a_large_fleet_has_a_leader_within_the_bound_of_the_checker() {
    for algorithm in ALGORITHMS {
        for count in [5, 12, 15, 30] {
            let (mut first, mut next) = (Vec::new(), Vec::new());
            for seed in 0..20 {
                let make = Elector::eager(by(algorithm));
                let mut world = World::new(count, seed, late(), None, make);
                let all: Vec<usize> = (0..count).collect();
                first.push(led(&mut world, &all, None));
                world.run_for(SECOND * 5);
                let mut shown = all.iter().map(|&robot| election(&world, robot).leader());
                let Some(leader) = shown.find_map(|leader| leader) else {
                    continue;
                };
                world.crash(leader.index());
                let is_up = |robot: &usize| *robot != leader.index();
                let rest: Vec<usize> = all.into_iter().filter(is_up).collect();
                next.push(led(&mut world, &rest, Some(leader.index())));
            }
            for times in [&mut first, &mut next] {
                times.sort_unstable();
                let (median, longest) = (times[times.len() / 2], times[times.len() - 1]);
                println!("{algorithm:?}, {count} robots: median {median}, longest {longest}");
                assert!(longest < SECOND * 35, "{algorithm:?}, {count}: {longest}");
            }
        }
    }
}

/// Late copies of the claims of a leader that has resigned change nothing, and robots that voted for a candidate that
/// did not become leader do not stand at the moment at which their promises end.
#[test]
fn a_leader_that_resigns_is_replaced_though_its_claims_arrive_for_ten_seconds_more() {
    let wire = Wire {
        late: (0.3, 10_000),
        ..late()
    };
    for count in [12, 20] {
        let mut times = Vec::new();
        for seed in 0..30 {
            let make = Elector::eager(by(Algorithm::Leases));
            let mut world = World::new(count, seed, wire.clone(), None, make);
            let all: Vec<usize> = (0..count).collect();
            times.push(led(&mut world, &all, None));
            world.run_for(SECOND * 5);
            let mut shown = all.iter().map(|&robot| election(&world, robot).leader());
            let Some(leader) = shown.find_map(|leader| leader) else {
                continue;
            };
            world.command(leader.index(), RESIGN);
            times.push(led(&mut world, &all, Some(leader.index())));
        }
        times.sort_unstable();
        let (median, longest) = (times[times.len() / 2], times[times.len() - 1]);
        println!("{count} robots: median {median}, longest {longest}");
        assert!(longest < SECOND * 25, "{count}: {longest}");
    }
}

/// A voter that took each late copy of a claim for a new claim would stay bound to the leader for ten seconds more.
#[test]
fn copies_of_the_claims_of_a_leader_that_has_crashed_bind_no_voter() {
    let wire = Wire {
        loss: 0.0,
        duplication: 1.0,
        late: (0.2, 10_000),
        ..late()
    };
    let mut times = Vec::new();
    for seed in 0..40 {
        let make = Elector::eager(by(Algorithm::Leases));
        let mut world = World::new(5, seed, wire.clone(), None, make);
        let all: Vec<usize> = (0..5).collect();
        led(&mut world, &all, None);
        world.run_for(SECOND * 12);
        let leader = election(&world, 0).leader().expect("there is a leader");
        world.crash(leader.index());
        let rest: Vec<usize> = all
            .into_iter()
            .filter(|&robot| robot != leader.index())
            .collect();
        times.push(led(&mut world, &rest, Some(leader.index())));
    }
    times.sort_unstable();
    let (median, longest) = (times[times.len() / 2], times[times.len() - 1]);
    println!("median {median}, longest {longest}");
    assert!(median < SECOND * 5, "{median}");
}
