//! With any messages from robots of the fleet, a mutex does not panic, uses bounded memory, and continues when they
//! send valid messages again.

use crate::harness::locker::{ALGORITHMS, Locker, entries, mutex};
use crate::harness::{Wire, World};
use starl_core::{Duration, Input, Message, Payload, Port, Random, RobotId};

const SECOND: Duration = Duration::from_seconds(1);
const PERIOD: Option<Duration> = Some(Duration::from_millis(100));

/// A datagram that was sent, perhaps with some bytes changed, or a meaningless one.
fn garbage(sent: &[Payload], random: &mut Random) -> Vec<u8> {
    let mut bytes = match sent.len() as u32 {
        0 => Vec::new(),
        count => sent[random.below(count) as usize].to_vec(),
    };
    for _ in 0..random.below(4) {
        match (random.below(3), bytes.len() as u32) {
            (0, _) | (_, 0) => bytes.push(random.bits() as u8),
            (1, length) => bytes[random.below(length) as usize] = random.bits() as u8,
            (_, length) => bytes.truncate(random.below(length) as usize),
        }
    }
    bytes
}

#[test]
fn after_garbage_it_continues() {
    for (algorithm, seed) in ALGORITHMS
        .into_iter()
        .flat_map(|a| (0..30).map(move |s| (a, s)))
    {
        let mut random = Random::keyed(seed, &[9]);
        let mut world = World::new(
            4,
            seed,
            Wire::perfect(),
            PERIOD,
            Locker::boxed(algorithm, true),
        );
        let (mut longest, mut sent, mut read) = (0, Vec::new(), 0);
        for _ in 0..600 {
            world.run_for(Duration::from_millis(20));
            sent.extend(world.payloads_from(read));
            read = world.records.len();
            let message = Message {
                // The last is not a robot of the fleet.
                from: RobotId(random.below(5)),
                port: Port::named("lock"),
                payload: garbage(&sent, &mut random).into(),
            };
            let to = random.below(4) as usize;
            world.input(to, &Input::Message(message));
            longest = longest.max(format!("{:?}", mutex(&world, to)).len());
        }
        assert!(longest < 20_000, "{algorithm:?} seed {seed}: {longest}");
        world.run_for(SECOND * 60);
        world.records.clear();
        let held = |robot| !mutex(&world, robot).held().is_empty();
        if (0..4).any(held) {
            // Its judge begins with nothing held.
            continue;
        }
        world.run_for(SECOND * 60);
        let entries = entries(&world, &[]);
        for robot in 0..4 {
            assert!(
                entries.get(&robot) >= Some(&5),
                "{algorithm:?} seed {seed}: {entries:?}"
            );
        }
    }
}

#[test]
fn memory_does_not_grow_with_time() {
    for algorithm in ALGORITHMS {
        let mut world = World::new(5, 1, Wire::bad(), PERIOD, Locker::boxed(algorithm, true));
        let size = |world: &World| {
            let sizes = (0..5).map(|robot| format!("{:?}", mutex(world, robot)).len());
            sizes.max()
        };
        let mut early = None;
        for round in 0..400 {
            world.run_for(SECOND);
            world.records.clear();
            if round < 100 {
                early = early.max(size(&world));
            } else {
                assert!(
                    size(&world) < early.map(|early| early * 3 / 2),
                    "{algorithm:?}"
                );
            }
        }
    }
}
