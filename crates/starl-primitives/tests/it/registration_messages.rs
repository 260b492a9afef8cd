//! The number of datagrams of an agreement is that of the theory, and memory is bounded for any input.

use crate::harness::registrar::{Registrar, agree, register, unregister};
use crate::harness::{self, Wire, World};
use starl_core::{Duration, Input, Message, Port, Random, RobotId};
use starl_primitives::registration::Options;

const SECOND: Duration = Duration::from_seconds(1);
const PERIOD: Option<Duration> = Some(Duration::from_millis(100));

fn idle(count: usize) -> World {
    let make = Registrar::boxed(false, Options::default());
    World::new(count, 1, Wire::perfect(), PERIOD, make)
}

/// The datagrams of registration until these robots agree.
fn sent_until(world: &mut World, agreed: &[u32]) -> usize {
    let before = world.sent_on("who");
    let begun = world.now;
    while !agree(world, agreed) {
        world.run_for(Duration::from_millis(1));
        assert!(world.now.since(begun) < SECOND * 20);
    }
    world.sent_on("who") - before
}

/// Robots that hardly ever announce a list that stays, so that none of that falls among what is counted.
fn rarely_announcing(count: usize) -> World {
    let options = Options {
        longest_interval: SECOND * 10_000,
        ..Options::default()
    };
    let make = Registrar::boxed(false, options);
    World::new(count, 1, Wire::perfect(), PERIOD, make)
}

#[test]
fn agreements_have_their_theoretical_cost() {
    for count in [3, 4, 5, 10, 20, 50, 100] {
        let mut world = rarely_announcing(count + 1);
        let all: Vec<u32> = (0..count as u32).collect();
        (0..count).for_each(|robot| world.command(robot, register()));
        // An announcement of each, a proposal, an acceptance of each but one, and that all have accepted.
        let announcements = count;
        assert_eq!(
            announcements + sent_until(&mut world, &all),
            count + 1 + (count - 1) + 1,
            "{count} robots together"
        );

        world.run_for(SECOND * 10);
        let everyone: Vec<u32> = (0..=count as u32).collect();
        world.command(count, register());
        let sent = 1 + sent_until(&mut world, &everyone);
        assert_eq!(sent, 1 + 1 + count + 1, "one more than {count} robots");

        world.run_for(SECOND * 10);
        world.command(count, unregister());
        let sent = 1 + sent_until(&mut world, &all);
        assert_eq!(
            sent,
            1 + 1 + (count - 1) + 1,
            "one of {count} + 1 robots leaves"
        );

        world.run_for(SECOND * 10);
        world.crash(count - 1);
        let sent = sent_until(&mut world, &all[..count - 1]);
        let theory = 1 + (count - 2) + 1;
        assert_eq!(sent, theory, "one of {count} robots crashes");
    }
}

#[test]
fn while_nothing_changes_one_robot_announces_the_list() {
    for count in [3, 10, 50] {
        let mut world = idle(count);
        (0..count).for_each(|robot| world.command(robot, register()));
        world.run_for(SECOND * 20);
        let before = world.sent_on("who");
        world.run_for(SECOND * 100);
        let sent = world.sent_on("who") - before;
        // One in each interval of 4 to 5 s, and at times two at once.
        assert!((20..=60).contains(&sent), "{count} robots: {sent}");
    }
}

/// Real datagrams with some bytes changed, cut off or added, and random bytes: nothing panics, memory stays
/// bounded, and all agree afterwards.
#[test]
fn garbage_is_survived() {
    for seed in 0..20 {
        let mut random = Random::keyed(seed, &[6]);
        let make = Registrar::boxed(false, Options::default());
        let mut world = World::new(4, seed, Wire::bad(), PERIOD, make);
        (0..4).for_each(|robot| world.command(robot, register()));
        world.run_for(SECOND * 5);
        world.command(3, unregister());
        world.run_for(SECOND * 5);
        let real = world.payloads();
        for round in 0..2000 {
            let mut bytes = real[random.below(real.len() as u32) as usize].clone();
            for _ in 0..1 + random.below(4) {
                if bytes.is_empty() {
                    bytes.push(0);
                }
                let place = random.below(bytes.len() as u32) as usize;
                bytes[place] = random.bits() as u8;
            }
            match random.below(5) {
                0 => bytes.truncate(random.below(bytes.len() as u32) as usize),
                1 => bytes.push(random.bits() as u8),
                2 => bytes = (0..random.below(60)).map(|_| random.bits() as u8).collect(),
                _ => {}
            }
            let message = Message {
                from: RobotId(random.below(6)),
                port: Port::named("who"),
                payload: bytes,
            };
            world.input(random.below(4) as usize, &Input::Message(message));
            if round % 50 == 0 {
                world.run_for(SECOND / 2);
            }
        }
        world.wire = Wire::perfect();
        // Wrong information about silent robots is forgotten in time.
        let begun = world.now;
        while !agree(&world, &[0, 1, 2]) {
            world.run_for(SECOND);
            assert!(world.now.since(begun) < SECOND * 300, "seed {seed}");
        }
        for robot in 0..4 {
            let state = format!("{:?}", harness::registrar::registration(&world, robot));
            assert!(state.len() < 5000, "{}", state.len());
        }
    }
}
