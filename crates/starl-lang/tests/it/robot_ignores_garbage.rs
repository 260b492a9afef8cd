//! A program handles only its own messages, ignores all other bytes from the network, and continues.

use crate::robot_support::{self, World, compile};
use starl_core::{Destination, Input, Message, Payload, Port, Random, RobotId};

const LISTENER: &str = r#"
program Listener

message Numbers(numbers: List[Int], name: String)

radio = Broadcast()
allwrite board: List[String] = []
heard: Int = 0
sum: Int = 0

on Numbers(from, numbers, name)
    heard += 1
    for n in numbers
        sum += n

look()
    eff
        for name in board
            heard += name.size() * 0
"#;

const SPEAKER: &str = r#"
program Listener

message Numbers(numbers: List[Int], name: String)
message Letters(letters: List[String])

radio = Broadcast()

speak()
    eff
        radio.broadcast(Letters(["a"]))
        radio.broadcast(Numbers([1, 2], "b"))
"#;

#[test]
fn a_message_that_the_program_does_not_handle_is_ignored() {
    let programs = [LISTENER, SPEAKER].map(|source| robot_support::program(&compile(source)));
    let mut world = World::new(programs.into());
    world.steps(2);
    assert_eq!((world.int(0, "heard"), world.int(0, "sum")), (2, 6));
    assert_eq!(world.failure(0), None);
}

#[test]
fn messages_with_other_fields_are_other_messages() {
    let other = SPEAKER.replace("numbers: List[Int], name", "numbers: Set[Int], name");
    let other = other.replace("Numbers([1, 2]", "Numbers({1, 2}");
    let programs = [LISTENER, &other].map(|source| robot_support::program(&compile(source)));
    let mut world = World::new(programs.into());
    world.steps(2);
    assert_eq!(world.int(0, "heard"), 0);
    assert_eq!(world.failure(0), None);
}

#[test]
fn damaged_messages_are_ignored() {
    let programs = [LISTENER, SPEAKER].map(|source| robot_support::program(&compile(source)));
    let mut world = World::new(programs.into());
    world.steps(2);
    let ports = [
        Port::named("Listener/radio"),
        Port::named("Listener/shared"),
        Port::PROGRAM,
    ];
    let sent: Vec<Payload> = (world.sent())
        .filter(|sent| sent.destination == Destination::All)
        .map(|sent| sent.payload.clone())
        .collect();
    let mut random = Random::keyed(1, &[]);
    for round in 0..20_000 {
        let mut payload = sent[random.below(sent.len() as u32) as usize].clone();
        for _ in 0..=random.below(4) {
            match random.below(3) {
                0 => payload.truncate(random.below(1 + payload.len() as u32) as usize),
                1 => payload.push(random.bits() as u8),
                _ if payload.is_empty() => {}
                _ => {
                    let place = random.below(payload.len() as u32) as usize;
                    payload[place] = random.bits() as u8;
                }
            }
        }
        let message = Message {
            from: RobotId(random.below(3)),
            port: ports[round % ports.len()],
            payload,
        };
        world.input(0, &Input::Message(message));
        if round % 100 == 0 {
            world.step();
        }
        let failed = world.failure(0);
        // Damaged numbers are still numbers, and may be great.
        assert!(
            failed.is_none_or(|text| text.contains("too great")),
            "{failed:?}"
        );
        if failed.is_some() {
            return;
        }
    }
}

#[test]
fn the_bytes_of_a_message_given_to_the_program_itself_are_not_heard() {
    let mut world = World::of(&compile(LISTENER), 1);
    let message = Message {
        from: RobotId(0),
        port: Port::PROGRAM,
        payload: Payload::new(),
    };
    world.input(0, &Input::Message(message));
    assert_eq!(world.int(0, "heard"), 0);
}
