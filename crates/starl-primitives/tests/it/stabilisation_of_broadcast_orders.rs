//! From any state broadcasts in causal and in total order recover their guarantees (self-stabilisation, Dijkstra 1974);
//! the time is measured.

use crate::harness::teller::{Id, Step, Teller, causal_violation, runs, tell, total_violation};
use crate::harness::{Wire, World};
use starl_core::{Duration, Time};
use starl_primitives::broadcast::Order;
use std::collections::{BTreeMap, BTreeSet};

const ROBOTS: usize = 4;
const PAUSE: Duration = Duration::from_millis(250);

/// Robots that broadcast four times a second, of which some are corrupted after 10 s; and when.
fn corrupted(order: Order, seed: u64, whom: &[usize]) -> (World, Time) {
    let make = Teller::boxed(order, 0, 0.0);
    let mut world = World::new(ROBOTS, seed, Wire::perfect(), None, make);
    let mut at = world.now;
    for round in 0..200 {
        for robot in 0..ROBOTS {
            world.command(robot, tell(round));
        }
        if round == 40 {
            at = world.now;
            whom.iter().for_each(|&robot| world.corrupt(robot));
        }
        world.run_for(PAUSE);
    }
    world.run_for(Duration::from_seconds(60));
    (world, at)
}

/// The time from which on every message that was sent was delivered to all, once and in
/// order.
fn recovered(world: &World, order: Order) -> Time {
    let runs = runs(world, &[]);
    let mut sent: BTreeMap<Id, Time> = BTreeMap::new();
    let mut handed: BTreeMap<Id, BTreeSet<u32>> = BTreeMap::new();
    for (robot, steps) in &runs {
        for (place, step) in steps {
            match step {
                Step::Sent(id) => drop(sent.insert(*id, world.records[*place].0)),
                Step::Handed(id) => drop(handed.entry(*id).or_default().insert(*robot)),
                _ => {}
            }
        }
    }
    let all = if order == Order::Total {
        ROBOTS
    } else {
        ROBOTS - 1
    };
    let is_missed = |id: &Id| handed.get(id).map_or(0, BTreeSet::len) < all;
    let missed = sent.iter().filter(|(id, _)| is_missed(id));
    let mut good = missed.map(|(_, at)| *at).max().unwrap_or(Time::ZERO) + PAUSE;
    // And in order: the latest time from which on it is so.
    loop {
        let later: Vec<(u32, Vec<(usize, Step)>)> = runs
            .iter()
            .map(|(robot, steps)| {
                let of_later = |(_, step): &&(usize, Step)| match step {
                    Step::Sent(id) | Step::Handed(id) => sent.get(id).is_some_and(|at| *at >= good),
                    _ => true,
                };
                (*robot, steps.iter().filter(of_later).cloned().collect())
            })
            .collect();
        let violation = match order {
            Order::Total => total_violation(&later),
            _ => causal_violation(&later),
        };
        if violation.is_none() {
            return good;
        }
        good += PAUSE;
    }
}

/// The median and the worst time to recover, seconds.
fn times(order: Order, whom: &[usize], seeds: u64) -> (f64, f64) {
    let mut times: Vec<f64> = (0..seeds)
        .map(|seed| {
            let (world, at) = corrupted(order, seed, whom);
            recovered(&world, order).since(at).seconds()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    (times[times.len() / 2], times[times.len() - 1])
}

#[test]
fn all_orders_hold_again_soon() {
    for (order, whom, bound) in [
        (Order::Causal, &[1][..], 15.0),
        (Order::Causal, &[0, 1, 2, 3], 15.0),
        (Order::Total, &[1], 15.0),
        (Order::Total, &[0, 1, 2, 3], 15.0),
    ] {
        let (median, worst) = times(order, whom, 50);
        println!(
            "{order:?}, {} robots: {median:.2} s, {worst:.2} s",
            whom.len()
        );
        assert!(worst < bound, "{order:?}, {whom:?}: {worst}");
    }
}
