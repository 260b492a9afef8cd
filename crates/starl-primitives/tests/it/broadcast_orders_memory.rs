//! The memory of a broadcast in any order is bounded, for any traffic; and garbage does no harm.

use crate::harness::teller::{Teller, tell, teller};
use crate::harness::{Wire, World};
use starl_core::{Duration, Input, Message, Payload, Port, Random, RobotId};
use starl_primitives::broadcast::Order;

fn size(world: &World, robot: usize) -> usize {
    format!("{:?}", teller(world, robot)).len()
}

#[test]
fn memory_does_not_grow_with_the_number_of_messages() {
    for order in [Order::Causal, Order::Total] {
        let make = Teller::boxed(order, 0, 0.0);
        let mut world = World::new(3, 1, Wire::perfect(), None, make);
        world.run_for(Duration::from_seconds(5));
        let mut after = Vec::new();
        for round in 0..3 {
            for value in 0..1000 {
                world.command(value as usize % 3, tell(value));
                world.run_for(Duration::from_millis(5));
            }
            // One is down permanently.
            if round == 0 {
                world.crash(2);
            }
            world.run_for(Duration::from_seconds(60));
            after.push(size(&world, 0));
        }
        assert!(after[2] <= after[1] + 100, "{order:?}: {after:?}");
    }
}

/// The most that robots keep in each tenth of this span, in which all of them broadcast and restart in turn.
fn sizes_under_churn(span: Duration, seed: u64) -> Vec<usize> {
    let wire = Wire {
        loss: 0.1,
        duplication: 0.1,
        delay_ms: (5, 300),
        ..Wire::perfect()
    };
    let make = Teller::boxed(Order::Total, u32::MAX, 0.3);
    let mut world = World::new(5, seed, wire, Some(Duration::from_millis(200)), make);
    let step = Duration::from_seconds(4);
    let steps = (span.seconds() / step.seconds()) as usize;
    let mut sizes = vec![0; 10];
    for at in 0..steps {
        world.run_for(step);
        let largest = (0..5).map(|robot| size(&world, robot)).max();
        let tenth = at * 10 / steps;
        sizes[tenth] = sizes[tenth].max(largest.unwrap_or(0));
        // Such a load that groups die now and then.
        for robot in (0..5).filter(|robot| (at + robot) % 3 == 0 && at % 2 == 0) {
            world.crash(robot);
            world.run_for(Duration::from_millis(300));
            world.start(robot);
        }
        world.records.clear();
    }
    sizes
}

#[test]
fn memory_is_flat_over_an_hour_of_load_and_churn() {
    let sizes = sizes_under_churn(Duration::from_seconds(3600), 1);
    let most = |sizes: &[usize]| sizes.iter().copied().max().unwrap_or(0);
    let (early, late) = (most(&sizes[..5]), most(&sizes[5..]));
    assert!(late <= early + early / 2, "{sizes:?}");
}

#[test]
fn garbage_is_tolerated() {
    for order in [Order::Fifo, Order::Causal, Order::Total] {
        for seed in 0..20 {
            let make = Teller::boxed(order, 20, 0.2);
            let wire = Wire::bad();
            let mut world = World::new(3, seed, wire, Some(Duration::from_millis(100)), make);
            world.run_for(Duration::from_seconds(10));
            let mut random = Random::keyed(seed, &[5]);
            let genuine = world.payloads();
            let calm = size(&world, 0);
            for _ in 0..3000 {
                let pick = random.below(genuine.len() as u32) as usize;
                let mut bytes: Payload = genuine[pick].clone();
                for _ in 0..=random.below(3) {
                    let at = random.below(bytes.len() as u32) as usize;
                    bytes[at] = random.bits() as u8;
                }
                if random.chance(0.2) {
                    bytes.truncate(random.below(30) as usize);
                }
                let message = Message {
                    from: RobotId(random.below(5)),
                    port: Port::named("news"),
                    payload: bytes,
                };
                world.input(0, &Input::Message(message));
            }
            let size = size(&world, 0);
            assert!(size < calm + 100_000, "{order:?}, seed {seed}: {size}");
            world.run_for(Duration::from_seconds(30));
        }
    }
}

/// The most that a robot keeps in each part of a run in which all send ten messages a second and restart in turn.
fn under_churn(order: Order, parts: u64, part: Duration) -> Vec<usize> {
    let make = Teller::boxed(order, u32::MAX, 1.0);
    let wire = Wire {
        loss: 0.1,
        duplication: 0.1,
        delay_ms: (5, 60),
        late: (0.05, 5000),
        ..Wire::perfect()
    };
    let mut world = World::new(4, 1, wire, Some(Duration::from_millis(100)), make);
    let mut random = Random::keyed(1, &[6]);
    let mut most = Vec::new();
    for round in 0..parts {
        let mut largest = 0;
        let end = world.now + part;
        while world.now < end {
            let robot = random.below(4) as usize;
            world.crash(robot);
            world.run_for(Duration::from_millis(u64::from(random.below(4000))));
            world.start(robot);
            world.run_for(Duration::from_seconds(10));
            for robot in 0..4 {
                largest = largest.max(size(&world, robot));
            }
            world.records.clear();
        }
        println!("{order:?}, part {round}: {largest}");
        most.push(largest);
    }
    most
}

#[test]
fn memory_is_flat_under_load_and_churn() {
    for order in [Order::Unordered, Order::Fifo, Order::Causal] {
        let most = under_churn(order, 8, Duration::from_seconds(120));
        // Half of the restarts fill the lists of the latest lives.
        let (early, late) = most.split_at(most.len() / 2);
        let sum = |part: &[usize]| part.iter().sum::<usize>();
        assert!(sum(late) < sum(early) * 3 / 2, "{order:?}: {most:?}");
    }
}

#[test]
#[ignore = "an hour of load takes minutes"]
fn memory_is_flat_for_an_hour() {
    for order in [Order::Unordered, Order::Fifo, Order::Causal, Order::Total] {
        let most = under_churn(order, 6, Duration::from_seconds(600));
        let [first, .., last] = most[..] else { return };
        assert!(last < first * 3 / 2, "{order:?}: {most:?}");
    }
}
