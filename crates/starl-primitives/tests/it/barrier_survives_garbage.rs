//! With any bytes from the network a barrier does not panic, memory stays bounded, and robots cross again afterwards.

use crate::harness::crosser::{Crosser, barrier, crosser};
use crate::harness::{Wire, World};
use starl_core::{Duration, Input, Message, Port, Random, RobotId};

const SECOND: Duration = Duration::from_seconds(1);
const PERIOD: Option<Duration> = Some(Duration::from_millis(100));

#[test]
fn damaged_datagrams_and_random_bytes() {
    for seed in 0..20 {
        let mut random = Random::keyed(seed, &[6]);
        let make = Crosser::boxed(None, Some(1000));
        let mut world = World::new(4, seed, Wire::bad(), PERIOD, make);
        world.run_for(SECOND * 10);
        world.crash(2);
        world.start(2);
        world.run_for(SECOND * 10);
        let real = world.payloads();
        for round in 0..2000 {
            let mut bytes = real[random.below(real.len() as u32) as usize].clone();
            for _ in 0..random.below(4) {
                let place = random.below(bytes.len() as u32) as usize;
                if let Some(byte) = bytes.get_mut(place) {
                    *byte = random.bits() as u8;
                }
            }
            match random.below(5) {
                0 => bytes.truncate(random.below(bytes.len() as u32) as usize),
                1 => bytes.push(random.bits() as u8),
                2 => bytes = (0..random.below(60)).map(|_| random.bits() as u8).collect(),
                _ => {}
            }
            let message = Message {
                from: RobotId(random.below(6)),
                port: Port::named("gate"),
                payload: bytes,
            };
            world.input(random.below(4) as usize, &Input::Message(message));
            if round % 50 == 0 {
                world.run_for(SECOND / 2);
            }
        }
        world.wire = Wire::perfect();
        world.run_for(SECOND * 20);
        let before: Vec<u32> = (0..4)
            .map(|robot| crosser(&world, robot).crossings)
            .collect();
        world.run_for(SECOND * 20);
        for (robot, before) in before.into_iter().enumerate() {
            let more = crosser(&world, robot).crossings - before;
            assert!(
                more >= 8,
                "seed {seed}: {more}, {:?}",
                barrier(&world, robot)
            );
            let state = format!("{:?}", barrier(&world, robot));
            assert!(state.len() < 3000, "{}", state.len());
        }
    }
}
