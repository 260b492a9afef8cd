//! In total order all robots deliver the same messages in the same order, under all faults; and all messages of robots
//! in a majority, unless the network loses everything.

use crate::harness::teller::{Teller, runs, sequences, tell, teller, total_violation, trouble};
use crate::harness::{Wire, World};
use starl_core::Duration;
use starl_primitives::broadcast::Order;

const PERIOD: Duration = Duration::from_millis(100);

fn world(robots: usize, seed: u64, wire: Wire, count: u32) -> World {
    let make = Teller::boxed(Order::Total, count, 0.1);
    World::new(robots, seed, wire, Some(PERIOD), make)
}

#[test]
fn all_deliver_all_messages_in_one_order() {
    for seed in 0..60 {
        for wire in [Wire::perfect(), Wire::bad()] {
            for robots in [1, 2, 3, 5] {
                let mut world = world(robots, seed, wire.clone(), 10);
                world.run_for(Duration::from_seconds(60));
                let runs = runs(&world, &[]);
                let sequences = sequences(&runs, seed);
                assert_eq!(total_violation(&runs), None, "seed {seed}");
                assert_eq!(sequences.len(), robots, "seed {seed}");
                for (robot, sequence) in sequences {
                    assert_eq!(
                        sequence.len(),
                        10 * robots,
                        "seed {seed}, {robots} robots: robot {robot}"
                    );
                }
            }
        }
    }
}

#[test]
fn the_order_is_one_under_crashes_and_partitions() {
    for seed in 0..300 {
        let wire = if seed % 2 == 0 {
            Wire::perfect()
        } else {
            Wire::bad()
        };
        let robots = 3 + seed as usize % 3;
        let mut world = world(robots, seed, wire, 40);
        let starts = trouble(&mut world, robots, seed, Duration::from_seconds(40));
        world.run_for(Duration::from_seconds(30));
        let runs = runs(&world, &starts);
        sequences(&runs, seed);
        assert_eq!(total_violation(&runs), None, "seed {seed}");
        // It continues when all are well.
        let before = world.records.len();
        for robot in 0..robots {
            assert!(
                !teller(&world, robot).failed(),
                "seed {seed}: {robot} of {robots}"
            );
            world.command(robot, tell(7));
        }
        world.run_for(Duration::from_seconds(20));
        let handed = world.records[before..].iter().filter(
            |record| matches!(&record.2, starl_core::Event::Program { name, .. } if name == "got"),
        );
        assert!(handed.count() >= robots * robots, "seed {seed}");
    }
}
