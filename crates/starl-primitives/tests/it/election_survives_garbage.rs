//! With any bytes from the network: robots continue to elect, epochs have one leader, and memory is bounded by the size
//! of the fleet.

use crate::harness::elector::{ALGORITHMS, Elector, agreed, by, election, judge};
use crate::harness::{Wire, World};
use starl_core::{Duration, Input, Message, Payload, Port, Random, RobotId};
use starl_primitives::election::Algorithm;

const SECOND: Duration = Duration::from_seconds(1);
const ALL: [usize; 4] = [0, 1, 2, 3];

/// A message on the port of the election.
fn message(from: u32, payload: Payload) -> Input {
    Input::Message(Message {
        from: RobotId(from),
        port: Port::named("election"),
        payload,
    })
}

/// The length of a robot's written state.
fn size(world: &World, robot: usize) -> usize {
    format!("{:?}", election(world, robot)).len()
}

/// Bytes of any kind, from robots of any number.
#[test]
fn bytes_of_any_kind() {
    for algorithm in ALGORITHMS {
        for seed in 0..20 {
            let mut random = Random::keyed(seed, &[9]);
            let make = Elector::eager(by(algorithm));
            let mut world = World::new(4, seed, Wire::perfect(), None, make);
            let mut largest = 0;
            for _ in 0..2000 {
                world.run_for(Duration::from_millis(u64::from(random.below(20))));
                let count = random.below(24) as usize;
                let mut bytes: Vec<u8> = (0..count).map(|_| random.bits() as u8).collect();
                if let Some(kind) = bytes.first_mut() {
                    *kind %= 16;
                }
                // There are many robots that are not participants; participants do not lie.
                let from = 4 + random.below(100_000);
                let to = random.below(4) as usize;
                world.input(to, &message(from, Payload::from_vec(bytes)));
                largest = largest.max(size(&world, to));
            }
            world.run_for(SECOND * 30);
            // Over a bad network leaders change now and then.
            let mut seconds = 0;
            while agreed(&world, &ALL).is_none() {
                world.run_for(SECOND);
                seconds += 1;
                assert!(seconds <= 15, "{algorithm:?}, seed {seed}");
            }
            assert!(largest < 4000, "{largest}");
            if algorithm == Algorithm::Leases {
                judge(&world, &[]);
            }
        }
    }
}

/// Earlier messages of participants are heard again, at any time, and under another's name: nothing is safe
/// then, but everything continues afterwards.
#[test]
fn messages_that_were_sent_before() {
    for algorithm in ALGORITHMS {
        for seed in 0..40 {
            let mut random = Random::keyed(seed, &[9]);
            let make = Elector::eager(by(algorithm));
            let mut world = World::new(4, seed, Wire::bad(), None, make);
            let (mut heard, mut read): (Vec<Payload>, usize) = (Vec::new(), 0);
            for round in 0..600 {
                world.run_for(Duration::from_millis(100));
                heard.extend(world.payloads_from(read));
                read = world.records.len();
                let index = random.below(heard.len() as u32) as usize;
                let (from, to) = (random.below(4), random.below(4));
                if let Some(payload) = heard.get(index)
                    && to != from
                {
                    world.input(to as usize, &message(from, payload.clone()));
                }
                if round % 100 == 50 {
                    world.crash(to as usize);
                    world.start(to as usize);
                }
            }
            world.run_for(SECOND * 60);
            // Over a bad network leaders change now and then.
            let mut seconds = 0;
            while agreed(&world, &ALL).is_none() {
                world.run_for(SECOND);
                seconds += 1;
                assert!(seconds <= 15, "{algorithm:?}, seed {seed}");
            }
            assert!(ALL.iter().all(|&robot| size(&world, robot) < 8000));
        }
    }
}

/// Memory does not grow with time.
#[test]
fn a_long_run_takes_no_more_memory_than_a_short_one() {
    for algorithm in ALGORITHMS {
        let make = Elector::eager(by(algorithm));
        let mut world = World::new(10, 1, Wire::bad(), None, make);
        let mut largest = [0; 2];
        for largest in &mut largest {
            for _ in 0..600 {
                world.run_for(SECOND);
                let sizes = (0..10).map(|robot| size(&world, robot));
                *largest = sizes.max().unwrap_or(0).max(*largest);
            }
        }
        let [before, after] = largest;
        assert!(
            after < before + before / 4,
            "{algorithm:?}: {before}, then {after}"
        );
        assert!((0..10).all(|robot| world.timers(robot) <= 2));
    }
}
