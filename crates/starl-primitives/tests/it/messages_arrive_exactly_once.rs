//! Under loss, duplication and reordering every message reaches every receiver exactly once.

use crate::harness::talker::{Talker, broadcast, geocast, unicast};
use crate::harness::{Wire, World};
use starl_core::Duration;
use starl_primitives::reliable::Options;
use std::collections::BTreeMap;

const ROBOTS: u32 = 4;
const MESSAGES: u32 = 15;

/// Everyone broadcasts, geocasts and sends to the next robot, all at once.
fn chatter(seed: u64, options: Options) -> World {
    let mut world = World::new(
        ROBOTS as usize,
        seed,
        Wire::bad(),
        None,
        Talker::boxed(options),
    );
    for message in 0..MESSAGES {
        for robot in 0..ROBOTS {
            let at = robot as usize;
            world.command(at, broadcast(message));
            world.command(at, geocast(1000 + message));
            world.command(at, unicast(((robot + 1) % ROBOTS) as u8, 2000 + message));
        }
        world.run_for(Duration::from_millis(70));
    }
    world.run_for(options.failure_bound() + Duration::from_seconds(1));
    world
}

fn expected() -> BTreeMap<(u32, u32, i64), u32> {
    let mut expected = BTreeMap::new();
    for from in 0..ROBOTS {
        for to in (0..ROBOTS).filter(|&to| to != from) {
            for message in 0..i64::from(MESSAGES) {
                expected.insert((from, to, message), 1);
                expected.insert((from, to, 1000 + message), 1);
                if to == (from + 1) % ROBOTS {
                    expected.insert((from, to, 2000 + message), 1);
                }
            }
        }
    }
    expected
}

fn check(seed: u64, options: Options) {
    let world = chatter(seed, options);
    let mut counted = BTreeMap::new();
    for received in world.received() {
        *counted.entry(received).or_insert(0) += 1;
    }
    assert_eq!(counted, expected(), "seed {seed}");
    assert_eq!(world.events("fail"), [], "seed {seed}");
    let settled = (ROBOTS * MESSAGES * 3) as usize;
    assert_eq!(world.events("acknowledged").len(), settled, "seed {seed}");
    for robot in 0..ROBOTS as usize {
        assert_eq!(world.timers(robot), 0, "seed {seed}: nothing is left to do");
    }
}

#[test]
fn in_any_order() {
    for seed in 0..40 {
        check(seed, Options::default());
    }
}

#[test]
fn in_order() {
    for seed in 0..40 {
        check(
            seed,
            Options {
                first_in_first_out: true,
                ..Options::default()
            },
        );
    }
}

#[test]
fn with_hardly_any_memory() {
    // Messages without room at a receiver are repeated, so more retries are needed.
    for seed in 0..20 {
        let first_in_first_out = seed % 2 == 0;
        check(
            seed,
            Options {
                window: 1,
                retries: 60,
                first_in_first_out,
                ..Options::default()
            },
        );
    }
}

#[test]
fn messages_to_the_robot_itself_arrive_once_and_without_the_network() {
    let wire = Wire {
        loss: 1.0,
        ..Wire::perfect()
    };
    let mut world = World::new(2, 1, wire, None, Talker::boxed(Options::default()));
    for message in 1..=3 {
        world.command(0, unicast(0, message));
    }
    world.run_for(Duration::from_millis(10));
    assert_eq!(world.received(), [(0, 0, 1), (0, 0, 2), (0, 0, 3)]);
    assert_eq!(world.events("acknowledged").len(), 3);
    assert_eq!(world.timers(0), 0, "nothing is left to do");
}

/// The receiver has to ask which life of the sender this is. It asks by its own clock: a sender that speaks to a stranger
/// only now and then has few occasions to be asked.
#[test]
fn a_first_message_arrives_where_half_of_all_is_lost() {
    let wire = Wire {
        loss: 0.5,
        delay_ms: (5, 400),
        ..Wire::perfect()
    };
    let mut given_up = Vec::new();
    for seed in 0..2000 {
        let options = Options::default();
        let mut world = World::new(2, seed, wire.clone(), None, Talker::boxed(options));
        world.command(0, broadcast(1));
        world.run_for(options.failure_bound());
        // Its acknowledgement may be lost each time.
        if world.received().is_empty() {
            given_up.push(seed);
        }
    }
    assert_eq!(given_up, [0; 0]);
}

#[test]
fn the_same_seed_gives_the_same_run() {
    let first = chatter(7, Options::default());
    let second = chatter(7, Options::default());
    let other = chatter(8, Options::default());
    assert_eq!(first.records, second.records);
    assert_ne!(first.records, other.records);
}
