//! If so many robots are down that all others must vote for the same candidate, they do not compete for ever.

use crate::harness::elector::{Elector, agreed, by};
use crate::harness::{Wire, World};
use starl_core::Duration;
use starl_primitives::election::Algorithm;

/// Robots that stand at the same time, and one after the other, while a vote is under way.
#[test]
fn three_of_four_robots_agree_soon() {
    let tenth = Duration::from_millis(100);
    let mut slowest = Duration::ZERO;
    for seed in 0..200 {
        let wire = Wire {
            delay_ms: (40, 60),
            ..Wire::perfect()
        };
        let make = Elector::eager(by(Algorithm::Leases));
        let mut world = World::new(4, seed, wire, None, make);
        world.run_for(Duration::from_seconds(3));
        world.crash(3);
        let begun = world.now;
        // A lease of the one that is down may have to run out.
        while agreed(&world, &[0, 1, 2]).is_none() || agreed(&world, &[0, 1, 2]) == Some(3) {
            world.run_for(tenth);
            assert!(
                world.now.since(begun) < Duration::from_seconds(60),
                "seed {seed}"
            );
        }
        slowest = slowest.max(world.now.since(begun));
    }
    println!("a leader after at most {slowest}");
    assert!(slowest <= Duration::from_seconds(2), "{slowest}");
}
