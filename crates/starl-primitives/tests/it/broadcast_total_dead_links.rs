//! A totally ordered broadcast where some robots do not hear others at all, but others hear both.

use crate::harness::teller::{Teller, runs, sequences, tell, total_violation};
use crate::harness::{Wire, World};
use starl_core::{Duration, Random};
use starl_primitives::broadcast::Order;

const SECOND: Duration = Duration::from_seconds(1);

fn world(robots: usize, seed: u64, wire: Wire) -> World {
    World::new(
        robots,
        seed,
        wire,
        None,
        Teller::boxed(Order::Total, 0, 0.0),
    )
}

/// All robots broadcast, and all deliver all of it.
fn all_reach_all(world: &mut World, robots: usize, first: u32, context: &str) {
    for value in first..first + 2 * robots as u32 {
        world.command(value as usize % robots, tell(value));
        world.run_for(Duration::from_millis(300));
    }
    world.run_for(SECOND * 15);
    let runs = runs(world, &[]);
    assert_eq!(total_violation(&runs), None, "{context}");
    let handed = sequences(&runs, 0);
    assert_eq!(handed.len(), robots, "{context}: all deliver something");
    for (robot, ids) in handed {
        let last = ids.iter().rev().take(2 * robots);
        let senders: Vec<usize> = (0..robots as u32)
            .map(|sender| last.clone().filter(|id| id.0 == sender).count())
            .collect();
        assert_eq!(
            senders,
            vec![2; robots],
            "{context}: robot {robot} delivers the last two of each"
        );
    }
}

#[test]
fn links_that_are_dead_from_the_start_keep_no_robot_out() {
    for robots in [3, 5] {
        for (a, b) in pairs(robots) {
            let mut world = world(robots, u64::from(a * 5 + b), Wire::perfect());
            world.wire.cut.extend([(a, b)]);
            world.run_for(SECOND * 15);
            all_reach_all(&mut world, robots, 0, &format!("{a} to {b} of {robots}"));
        }
    }
}

#[test]
fn links_that_die_in_both_directions_cut_no_robot_off() {
    for robots in [3, 5] {
        for (a, b) in pairs(robots).filter(|(a, b)| a < b) {
            let mut world = world(robots, u64::from(a * 5 + b), Wire::perfect());
            world.run_for(SECOND * 3);
            all_reach_all(&mut world, robots, 0, "all links live");
            world.wire.cut.extend([(a, b), (b, a)]);
            world.run_for(SECOND * 15);
            all_reach_all(&mut world, robots, 100, &format!("{a} and {b} of {robots}"));
        }
    }
}

#[test]
fn many_dead_links_of_a_lossy_network_cut_no_robot_off() {
    for seed in 0..10 {
        let mut random = Random::keyed(seed, &[]);
        let mut world = world(
            7,
            seed,
            Wire {
                loss: 0.1,
                ..Wire::perfect()
            },
        );
        // Robot 6 hears all, and all hear it.
        for (a, b) in pairs(6) {
            if random.chance(0.2) {
                world.wire.cut.extend([(a, b)]);
            }
        }
        world.run_for(SECOND * 30);
        all_reach_all(&mut world, 7, 0, &format!("seed {seed}"));
    }
}

fn pairs(robots: usize) -> impl Iterator<Item = (u32, u32)> {
    let robots = robots as u32;
    (0..robots).flat_map(move |a| (0..robots).filter(move |b| a != *b).map(move |b| (a, b)))
}
