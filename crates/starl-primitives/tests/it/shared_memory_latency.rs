//! How long it takes until all robots read a write: one delay where nothing is lost, and about a second
//! where the write is lost to some. These are the figures of the reference, rounded up.

use crate::harness::sharer::{Sharer, read, write, write_own};
use crate::harness::{Wire, World};
use starl_core::Duration;
use starl_primitives::shared_memory::Options;

const ROBOTS: u32 = 10;

/// Seconds from each of many writes until all robots read it, in ascending order. Delays are 5 to 50 ms.
fn latencies(loss: f64, pause: Duration, busy: bool) -> Vec<f64> {
    let mut latencies = Vec::new();
    for seed in 0..10 {
        let wire = Wire {
            loss,
            delay_ms: (5, 50),
            ..Wire::perfect()
        };
        let make = Sharer::boxed(Options::default());
        let mut world = World::new(ROBOTS as usize, seed, wire, None, make);
        for number in 0..30 {
            world.run_for(pause);
            world.command(number as usize % 10, write(0, number));
            let written = world.now;
            let mut steps = 0;
            while (0..10).any(|robot| read(&world, robot, 0) != Some(number)) {
                steps += 1;
                assert!(steps < 20_000, "it takes more than 100 s");
                let robot = steps % 200;
                if busy && robot < ROBOTS {
                    // Each robot writes its element every second.
                    world.command(robot as usize, write_own(0, steps));
                }
                world.run_for(Duration::from_millis(5));
            }
            latencies.push(world.now.since(written).seconds());
        }
    }
    latencies.sort_by(f64::total_cmp);
    latencies
}

#[track_caller]
fn assert_percentiles(latencies: &[f64], half: f64, most: f64, all: f64) {
    let at = |fraction: f64| latencies[(fraction * (latencies.len() - 1) as f64) as usize];
    let found = (at(0.5), at(0.99), at(1.0));
    assert!(
        found.0 <= half && found.1 <= most && found.2 <= all,
        "{found:?}"
    );
}

#[test]
fn without_loss() {
    let pause = Duration::from_seconds(10);
    assert_percentiles(&latencies(0.0, pause, false), 0.05, 0.055, 0.055);
}

#[test]
fn after_quiet() {
    let pause = Duration::from_seconds(10);
    assert_percentiles(&latencies(0.1, pause, false), 0.7, 1.3, 1.6);
    assert_percentiles(&latencies(0.3, pause, false), 1.0, 2.6, 2.8);
    assert_percentiles(&latencies(0.5, pause, false), 2.3, 6.1, 8.7);
}

#[test]
fn among_other_writes() {
    let pause = Duration::from_millis(100);
    assert_percentiles(&latencies(0.1, pause, true), 0.4, 2.0, 2.2);
    assert_percentiles(&latencies(0.3, pause, true), 1.0, 4.3, 6.6);
    assert_percentiles(&latencies(0.5, pause, true), 2.3, 10.1, 12.3);
}
