//! From any state robots agree again (self-stabilisation, Dijkstra 1974).

use crate::harness::registrar::{Registrar, agree, list, register, registration};
use crate::harness::{Wire, World};
use starl_core::{Duration, Random};
use starl_primitives::registration::Options;

const SECOND: Duration = Duration::from_seconds(1);
const PERIOD: Option<Duration> = Some(Duration::from_millis(100));

/// Corrupts some of four robots, of which three take part, and gives how long it takes until those three agree and
/// continue agreeing for 10 s.
fn recovery(seed: u64, wire: Wire) -> Duration {
    let mut random = Random::keyed(seed, &[11]);
    let make = Registrar::boxed(false, Options::default());
    let mut world = World::new(4, seed, wire, PERIOD, make);
    (0..3).for_each(|robot| world.command(robot, register()));
    world.run_for(Duration::from_millis(u64::from(random.below(12_000))));
    let whom = 1 + random.below(15);
    for robot in (0..4).filter(|robot| whom >> robot & 1 == 1) {
        world.corrupt(robot);
    }
    let begun = world.now;
    let mut agreed = None;
    while agreed.is_none_or(|since| world.now.since(since) < SECOND * 10) {
        world.run_for(SECOND / 10);
        if !agree(&world, &[0, 1, 2]) {
            agreed = None;
        } else if agreed.is_none() {
            agreed = Some(world.now);
        }
        if world.now.since(begun) > SECOND * 300 {
            for robot in 0..4 {
                println!(
                    "{robot} {:?} {:?}",
                    list(&world, robot),
                    registration(&world, robot)
                );
            }
            panic!("seed {seed}");
        }
    }
    agreed.unwrap().since(begun)
}

#[test]
fn robots_agree_from_any_state() {
    let mut spans: Vec<Duration> = (0..400)
        .map(|seed| recovery(seed, Wire::perfect()))
        .collect();
    spans.sort();
    let (middle, most) = (spans[spans.len() / 2], spans[spans.len() - 1]);
    println!(
        "median {middle}, 99 of 100 {}, all {most}",
        spans[spans.len() * 99 / 100]
    );
    assert!(
        middle <= SECOND * 3 && most <= SECOND * 60,
        "{middle} {most}"
    );
}

#[test]
fn on_a_bad_network_too() {
    let mut spans: Vec<Duration> = (0..100).map(|seed| recovery(seed, Wire::bad())).collect();
    spans.sort();
    let (middle, most) = (spans[spans.len() / 2], spans[spans.len() - 1]);
    println!("median {middle}, all {most}");
    assert!(
        middle <= SECOND * 10 && most <= SECOND * 120,
        "{middle} {most}"
    );
}
