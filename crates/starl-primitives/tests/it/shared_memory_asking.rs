//! A robot that gets a list of another's elements requests the missing ones, and receives them.

use crate::harness;
use starl_core::{
    Destination, Effect, Input, Message, Payload, Port, Primitive, RobotId, TimerKey, timers,
};
use starl_primitives::SharedMemory;
use starl_primitives::shared_memory::Options;

const PORT: Port = Port::named("memory");

/// The messages of a memory for an input.
fn handle(id: u32, memory: &mut SharedMemory, input: &Input) -> Vec<(Destination, Payload)> {
    let effects = harness::alone(id, |robot| memory.handle(robot, input));
    let sent = effects.into_iter().filter_map(|effect| match effect {
        Effect::Transmit {
            destination,
            payload,
            ..
        } => Some((destination, payload)),
        _ => None,
    });
    sent.collect()
}

fn arrives(from: u32, payload: &Payload) -> Input {
    Input::Message(Message {
        from: RobotId(from),
        port: PORT,
        payload: payload.clone(),
    })
}

timers! {
    /// The timers of a memory.
    enum Alarm {
        Flush,
        Gossip,
        Repair,
    }
}

fn fires(alarm: Alarm) -> Input {
    Input::Timer(TimerKey::new(PORT, alarm))
}

#[test]
fn it_requests_missing_elements() {
    let mut knowing = SharedMemory::new("memory", Options::default());
    let mut lacking = knowing.clone();
    harness::alone(0, |robot| {
        knowing.write(robot, "x", [5].as_slice().into()).unwrap();
    });
    handle(0, &mut knowing, &fires(Alarm::Flush)); // and this is lost

    // Each announces its memory; the one that knows hears that the other differs.
    let announced = handle(1, &mut lacking, &fires(Alarm::Gossip));
    let [(Destination::All, announced)] = &announced[..] else {
        panic!("{announced:?}");
    };
    assert_eq!(handle(0, &mut knowing, &arrives(1, announced)), []);
    let told = handle(0, &mut knowing, &fires(Alarm::Gossip));
    let [
        (Destination::All, _),
        (Destination::Robot(RobotId(1)), list),
    ] = &told[..]
    else {
        panic!("{told:?}");
    };

    let asked = handle(1, &mut lacking, &arrives(0, list));
    let [(Destination::Robot(RobotId(0)), asked)] = &asked[..] else {
        panic!("{asked:?}");
    };
    assert_eq!(handle(0, &mut knowing, &arrives(1, asked)), []);
    let repaired = handle(0, &mut knowing, &fires(Alarm::Repair));
    let [(Destination::All, repaired)] = &repaired[..] else {
        panic!("{repaired:?}");
    };
    handle(1, &mut lacking, &arrives(0, repaired));
    assert_eq!(lacking.read("x"), Some(&[5][..]));
    assert_eq!(lacking.stamp("x"), knowing.stamp("x"));
}
