//! A peer from which nothing is expected, and for which nothing is on its way, is kept in a few bytes. It is not
//! forgotten: late copies of its messages are recognised, also those of its earlier lives.

use crate::harness::talker::{Talker, broadcast};
use crate::harness::{Wire, World};
use starl_core::Duration;
use starl_primitives::reliable::Options;

const MESSAGES: u32 = 12;

#[test]
fn late_copies_are_recognised_when_all_is_at_rest() {
    for first_in_first_out in [false, true] {
        for seed in 0..30 {
            let options = Options {
                first_in_first_out,
                ..Options::default()
            };
            // Of two copies one comes in time. The other may come when both robots are long at rest.
            let wire = Wire {
                duplication: 1.0,
                delay_ms: (1, 20),
                late: (0.3, 8_000),
                ..Wire::perfect()
            };
            let mut world = World::new(3, seed, wire, None, Talker::boxed(options));
            for value in 0..MESSAGES {
                if value == MESSAGES / 2 {
                    world.crash(0);
                    world.start(0);
                }
                world.command(0, broadcast(value));
                world.run_for(Duration::from_seconds(4));
            }
            world.run_for(Duration::from_seconds(40));
            for to in [1, 2] {
                let received = world.received().into_iter().filter(|got| got.1 == to);
                let values: Vec<i64> = received.map(|got| got.2).collect();
                let mut distinct = values.clone();
                distinct.sort_unstable();
                distinct.dedup();
                assert_eq!(
                    distinct.len(),
                    values.len(),
                    "seed {seed}: twice in {values:?}"
                );
                assert!(
                    values.len() >= MESSAGES as usize - 1,
                    "seed {seed}: {values:?}"
                );
                if first_in_first_out {
                    assert!(values.is_sorted(), "seed {seed}: {values:?}");
                }
            }
        }
    }
}
