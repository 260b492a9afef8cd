//! After any corruption of all robots' states, resources are given to one robot at a time again, and to every
//! robot, within a time that is measured here. `cargo test -p starl-primitives --test
//! mutex_recovers_from_corruption -- --nocapture` shows it.

use crate::harness::locker::{ALGORITHMS, Locker, RESOURCES, acquire, mutex, set};
use crate::harness::{Wire, World};
use starl_core::Duration;

const PERIOD: Option<Duration> = Some(Duration::from_millis(100));
const SEEDS: u64 = 100;

/// Whether some resource is held by two robots.
fn is_doubly_held(world: &World) -> bool {
    RESOURCES.iter().any(|&resource| {
        let holds = |&robot: &usize| mutex(world, robot).holds(&set(&[resource]));
        (0..4).filter(holds).count() > 1
    })
}

/// A robot that holds something requests nothing. Two robots with invented resources that the other one requests
/// would wait for each other.
#[test]
fn waiting_robots_give_up_invented_resources() {
    for algorithm in ALGORITHMS {
        let mut found = 0;
        for seed in 0..SEEDS {
            let make = Locker::boxed(algorithm, false);
            let mut world = World::new(2, seed, Wire::perfect(), PERIOD, make);
            world.run_for(Duration::from_seconds(10));
            world.command(0, acquire(&["a"]));
            world.run_for(Duration::from_seconds(1));
            world.command(1, acquire(&["a", "b"]));
            world.run_for(Duration::from_seconds(1));
            world.corrupt(1);
            let is_odd = |world: &World| mutex(world, 1).is_waiting() && mutex(world, 1).crit();
            found += usize::from(is_odd(&world));
            world.run_for(Duration::from_seconds(5));
            assert!(!is_odd(&world), "{algorithm:?}, seed {seed}");
        }
        assert!(found > 10, "{algorithm:?}: {found}");
    }
}

#[test]
fn all_is_as_it_should_be_within_ten_seconds() {
    for algorithm in ALGORITHMS {
        let (mut safe, mut served) = (Vec::new(), Vec::new());
        for seed in 0..SEEDS {
            let mut world = World::new(
                4,
                seed,
                Wire::perfect(),
                PERIOD,
                Locker::boxed(algorithm, true),
            );
            world.run_for(Duration::from_seconds(10));
            (0..4).for_each(|robot| world.corrupt(robot));
            let (mut last_double, mut entered, mut all) = (0, [false; 4], None);
            for step in 1..=3000 {
                world.run_for(Duration::from_millis(10));
                if is_doubly_held(&world) {
                    last_double = step;
                    entered = [false; 4];
                }
                for (robot, entered) in entered.iter_mut().enumerate() {
                    *entered |= mutex(&world, robot).crit();
                }
                if all.is_none() && entered == [true; 4] {
                    all = Some(step);
                }
            }
            safe.push(last_double);
            served.push(all.unwrap_or(3000));
        }
        safe.sort_unstable();
        served.sort_unstable();
        let at = |times: &[i32], share: usize| times[times.len() * share / 100 - 1] as f64 / 100.0;
        println!(
            "| {algorithm:?} | {} s | {} s | {} s | {} s | {} s | {} s |",
            at(&safe, 50),
            at(&safe, 99),
            at(&safe, 100),
            at(&served, 50),
            at(&served, 99),
            at(&served, 100)
        );
        assert!(
            at(&safe, 100) < 10.0 && at(&served, 100) < 20.0,
            "{algorithm:?}"
        );
    }
}
