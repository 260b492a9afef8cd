//! The same scenario and seed give the same run, on any number of threads, from any copy.

use crate::engine_support::{Wander, run, scenario, simulate};
use starl_sim::Scenario;
use starl_sim::scenario::Proximity;

/// More robots than a shard holds, with everything that draws random numbers switched on.
fn busy(seed: u64) -> Scenario {
    let places: Vec<(f64, f64)> = (0..600)
        .map(|i| (f64::from(i % 25) * 0.4, f64::from(i / 25) * 0.4))
        .collect();
    let mut scenario = scenario("differential", &places);
    scenario.seed = seed;
    scenario.network.range = Some(1.0);
    scenario.network.link.loss = 0.2;
    scenario.network.link.duplication = 0.1;
    scenario.network.link.reordering = 0.1;
    scenario.positioning.position_noise = 0.01;
    scenario.motion.speed_noise = 0.1;
    scenario.motion.turn_noise = 0.1;
    scenario.faults.rates.crash = 0.01;
    scenario.faults.rates.restart_after = starl_core::Duration::from_seconds(1);
    scenario.faults.rates.partition = 0.5;
    scenario.fleet.groups[0].sensors.proximity = Some(Proximity {
        rays: 8,
        range: 0.2,
    });
    scenario
}

#[test]
fn a_seed_gives_the_same_records_twice_and_another_seed_gives_others() {
    let once = |seed| {
        let mut simulation = simulate(busy(seed), Wander::default());
        let records = run(&mut simulation, 3.0);
        (records, simulation.digest())
    };
    let (records, digest) = once(1);
    assert!(records.len() > 10_000);
    assert_eq!((records, digest), once(1));
    assert_ne!(digest, once(2).1);
}

#[cfg(feature = "parallel")]
#[test]
fn threads_do_not_change_the_run() {
    let on = |threads: Option<usize>| {
        let mut simulation = simulate(busy(3), Wander::default());
        let Some(threads) = threads else {
            return (run(&mut simulation, 3.0), simulation.digest());
        };
        simulation.set_parallel(true);
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        let records = pool.install(|| run(&mut simulation, 3.0));
        (records, simulation.digest())
    };
    let alone = on(None);
    assert_eq!(alone, on(Some(1)));
    assert_eq!(alone, on(Some(2)));
    assert_eq!(alone, on(Some(5)));
}

#[test]
fn recording_does_not_change_the_run() {
    let mut simulation = simulate(busy(4), Wander::default());
    simulation.set_recording(false);
    run(&mut simulation, 2.0);
    let mut recorded = simulate(busy(4), Wander::default());
    run(&mut recorded, 2.0);
    assert_eq!(simulation.digest(), recorded.digest());
    assert_eq!(simulation.tally(), recorded.tally());
}

#[test]
fn a_copy_continues_as_the_original() {
    let mut original = simulate(busy(5), Wander::default());
    run(&mut original, 1.0);
    let mut copy = original.clone();
    assert_eq!(run(&mut original, 2.0), run(&mut copy, 2.0));
    assert_eq!(original.digest(), copy.digest());
}
