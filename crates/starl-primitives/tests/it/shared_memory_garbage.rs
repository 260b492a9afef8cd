//! Memories tolerate any bytes from the network: there is no panic, foreign datagrams change nothing, and forged ones
//! of any length do not fill the memory.

use crate::harness::sharer::{Sharer, memory, read, write, write_many};
use crate::harness::{self, Wire, World};
use starl_core::{Duration, Effect, Input, Message, Payload, Port, Primitive, Random, RobotId};
use starl_primitives::SharedMemory;
use starl_primitives::shared_memory::Options;

fn world(robots: usize, options: Options) -> World {
    World::new(robots, 1, Wire::perfect(), None, Sharer::boxed(options))
}

fn arrives(from: u32, payload: Payload) -> Input {
    Input::Message(Message {
        from: RobotId(from),
        port: Port::named("memory"),
        payload,
    })
}

#[test]
fn random_bytes_are_ignored() {
    let mut world = world(2, Options::default());
    world.command(0, write(0, 7));
    world.run_for(Duration::from_seconds(1));
    let mut random = Random::keyed(1, &[]);
    for _ in 0..50_000 {
        let length = random.below(60);
        let bytes = (0..length).map(|_| random.bits() as u8).collect();
        world.input(1, &arrives(0, bytes));
    }
    assert_eq!(read(&world, 1, 0), Some(7));
    world.run_for(Duration::from_seconds(10));
    assert_eq!(read(&world, 0, 0), Some(7));
    assert_eq!(memory(&world, 0).elements(), memory(&world, 1).elements());
}

/// Real datagrams, with some bytes changed, cut off, or added.
#[test]
fn damaged_datagrams_break_nothing() {
    let options = Options {
        most_elements: 500,
        ..Options::default()
    };
    let mut world = world(3, options);
    world.command(0, write_many(200));
    world.run_for(Duration::from_seconds(5));
    world.crash(2);
    world.start(2);
    world.command(1, write(3, 9));
    world.run_for(Duration::from_seconds(5));
    let real = world.payloads();
    assert!(real.len() > 10);
    let mut random = Random::keyed(2, &[]);
    for round in 0..20_000 {
        let mut bytes = real[random.below(real.len() as u32) as usize].clone();
        for _ in 0..1 + random.below(4) {
            let place = random.below(bytes.len() as u32) as usize;
            bytes[place] = random.bits() as u8;
        }
        match random.below(4) {
            0 => bytes.truncate(random.below(bytes.len() as u32) as usize),
            1 => bytes.push(random.bits() as u8),
            _ => {}
        }
        world.input(round % 3, &arrives((round % 3) as u32 ^ 1, bytes));
        if round % 100 == 0 {
            world.run_for(Duration::from_millis(10));
        }
    }
    for robot in 0..3 {
        assert!(memory(&world, robot).elements() <= 500);
    }
    world.command(0, write(0, 1234));
    world.run_for(Duration::from_seconds(30));
    for robot in 0..3 {
        assert_eq!(read(&world, robot, 0), Some(1234));
    }
}

#[test]
fn strangers_and_oneself_are_not_heard() {
    let mut world = world(2, Options::default());
    world.command(0, write(0, 7));
    world.run_for(Duration::from_millis(1));
    let datagram = world.payloads().pop().unwrap();
    let mut fresh = self::world(2, Options::default());
    fresh.input(1, &arrives(2, datagram.clone()));
    fresh.input(1, &arrives(1, datagram.clone()));
    assert_eq!(read(&fresh, 1, 0), None);
    fresh.input(1, &arrives(0, datagram));
    assert_eq!(read(&fresh, 1, 0), Some(7));
}

/// The answer to one datagram is bounded, whatever it asks for.
#[test]
fn no_datagram_brings_about_a_flood() {
    let mut world = world(2, Options::default());
    world.command(0, write_many(5000));
    world.run_for(Duration::from_seconds(60));
    world.crash(1);
    let before = world.records.len();
    world.start(1);
    world.run_for(Duration::from_seconds(2));
    let asked = world.payloads_from(before);
    world.run_for(Duration::from_seconds(60));
    for datagram in asked {
        let sent = world.sent_count();
        world.input(0, &arrives(1, datagram));
        assert!(world.sent_count() - sent <= 32);
    }
}

#[test]
fn a_memory_without_a_start_begins_with_its_first_input() {
    let mut memory = SharedMemory::new("memory", Options::default());
    let effects = harness::alone(0, |robot| memory.handle(robot, &Input::Activate));
    assert!(matches!(
        effects[..],
        [Effect::Record(_), Effect::SetTimer { .. }]
    ));
}

#[test]
fn a_memory_is_bounded() {
    let options = Options {
        most_elements: 10,
        ..Options::default()
    };
    let mut world = world(2, options);
    let mut large = self::world(2, Options::default());
    large.command(0, write_many(20));
    large.run_for(Duration::from_millis(1));
    for payload in large.payloads() {
        world.input(1, &arrives(0, payload));
    }
    assert_eq!(memory(&world, 1).elements(), 10);
}

/// No robot gives two values the same stamp, unless its state was corrupted. Even then all agree.
#[test]
fn of_two_values_with_the_same_stamp_all_take_the_same() {
    for swapped in [false, true] {
        let mut world = world(3, Options::default());
        world.wire.loss = 1.0;
        world.command(0, write(0, 7));
        world.run_for(Duration::from_millis(1));
        let one = world.payloads().pop().unwrap();
        let mut other = one.clone();
        // The value comes last.
        let place = other.len() - 4;
        assert_eq!(other[place], 7);
        other[place] = 8;
        let robots = if swapped { [2, 1] } else { [1, 2] };
        world.input(robots[0], &arrives(0, one));
        world.input(robots[1], &arrives(0, other));
        world.wire.loss = 0.0;
        world.crash(0);
        world.run_for(Duration::from_seconds(10));
        for robot in 1..3 {
            assert_eq!(read(&world, robot, 0), Some(8));
        }
    }
}
