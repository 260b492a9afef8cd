//! The cost of an entry if all robots always request the same few resources and hold them for a while: at most 4 n
//! datagrams in a fleet of n, also with a fifth of them lost, and without starvation. `cargo test -p starl-primitives
//! --test it mutex_under_contention -- --nocapture --ignored` prints the table of docs/reference/primitives/mutex.md.

use crate::harness::locker::{ALGORITHMS, Locker, contend};
use crate::harness::{Wire, World};
use starl_core::{Duration, Input};
use starl_primitives::mutex::Algorithm;

const SECOND: Duration = Duration::from_seconds(1);
/// Robots in the fleet.
const SIZES: [usize; 4] = [3, 10, 30, 100];

fn world(algorithm: Algorithm, count: usize, loss: f64) -> World {
    let wire = Wire {
        loss,
        delay_ms: (10, 20),
        ..Wire::perfect()
    };
    let mut world = World::new(count, 1, wire, None, Locker::boxed(algorithm, false));
    (0..count).for_each(|robot| world.input(robot, &Input::Activate));
    world.run_for(SECOND * 10);
    world
}

#[test]
fn with_leases_an_entry_takes_few_datagrams() {
    measure(&[Algorithm::Lease]);
}

#[test]
#[ignore = "prints a table, and claims nothing of the other algorithms"]
fn of_all_algorithms() {
    println!("| algorithm | robots | lost | datagrams an entry | entries a second |");
    measure(&ALGORITHMS);
}

fn measure(algorithms: &[Algorithm]) {
    for &algorithm in algorithms {
        for count in SIZES {
            for loss in [0.0, 0.2] {
                let mut world = world(algorithm, count, loss);
                // Long enough for the first crowd to be served.
                contend(&mut world, SECOND * (count as u64 / 4));
                world.records.clear();
                let before = world.traffic_on("lock").0;
                let span = 10;
                let entries = contend(&mut world, SECOND * span);
                let sent = (world.traffic_on("lock").0 - before) as f64;
                let (total, all) = (entries.iter().sum::<usize>() as f64, count as f64);
                println!(
                    "| {algorithm:?} | {count} | {loss} | {:.0} | {:.1} |",
                    sent / total,
                    total / span as f64
                );
                if algorithm == Algorithm::Lease && count >= 10 {
                    assert!(
                        sent / total <= 4.0 * all,
                        "{algorithm:?}, {count} robots, loss {loss}: {sent} for {total}"
                    );
                }
            }
        }
    }
}
