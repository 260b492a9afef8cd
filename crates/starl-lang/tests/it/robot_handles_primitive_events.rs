//! Events of primitives reach their handlers at once, not at the next activation; and a program knows
//! which of its messages are on their way.

use crate::robot_support::{World, compile};
use starl_lang::machine::Value;

const SENDER: &str = r#"
program Sender

message Hello(word: String)

post = Unicast()
radio = Broadcast()

first: Int = 0
second: Int = 0
third: Int = 0
on_its_way: Bool = false
failed: List[Int] = []
unreached: List[RobotId] = []
failed_at: Time? = none
activations: Int = 0
at_failure: Int = 0

send()
    pre first == 0
    eff
        for r in peers
            if robot_name(r) == "robot1"
                first = post.send(r, Hello("one"))
            elif robot_name(r) == "robot2"
                second = post.send(r, Hello("two"))
        third = radio.broadcast(Hello("all"))

watch()
    eff
        on_its_way = post.outstanding(second)
        activations += 1

on post.failed(number, robots)
    failed.add(number)
    for r in robots
        unreached.add(r)
    failed_at = now
    at_failure = activations

on radio.failed(number)
    failed.add(100 + number)
"#;

#[test]
fn a_message_that_is_not_acknowledged_fails_with_its_number() {
    let mut world = World::of(&compile(SENDER), 3);
    world.wire.isolate(2, 3);
    world.step();
    // The numbers of a program's messages differ even where those of the protocol do not.
    assert_eq!((world.int(0, "first"), world.int(0, "second")), (1, 2));
    world.step();
    assert_eq!(world.get(0, "on_its_way"), Value::Bool(true));
    world.steps(600);
    assert_eq!(world.get(0, "on_its_way"), Value::Bool(false));
    let failed = world.get(0, "failed").to_string();
    assert!(["[2, 101]", "[101, 2]"].contains(&&failed[..]), "{failed}");
    assert_eq!(world.get(0, "unreached").to_string(), "[robot2]");
}

#[test]
fn the_handler_runs_between_activations() {
    let mut world = World::of(&compile(SENDER), 3);
    world.wire.isolate(2, 3);
    world.steps(600);
    let Value::Some(at) = world.get(0, "failed_at") else {
        panic!("it has not failed")
    };
    let Value::Time(at) = *at else {
        panic!("no time")
    };
    // Activations are at whole tenths of a second, the retries' jitter is not.
    assert_ne!(at.0 % 100_000_000, 0);
    assert_eq!(world.int(0, "at_failure"), at.0 as i64 / 100_000_000 + 1);
}

const AGAIN: &str = r#"
program Again

message Hello(number: Int)

radio = Broadcast()
sent: Int = 0
failures: Int = 0

flood()
    pre sent == 0
    eff
        for i in 0..4102
            sent = radio.broadcast(Hello(i))

on radio.failed(number)
    failures += 1
    sent = radio.broadcast(Hello(number))
"#;

#[test]
fn a_handler_that_brings_about_its_own_event_does_not_run_for_ever() {
    let mut world = World::of(&compile(AGAIN), 2);
    world.wire.loss = 1.0;
    world.step();
    assert_eq!(world.failure(0), None);
    assert_eq!(world.int(0, "sent"), 4102);
    world.step();
    // Six were given up for others. At each input, of which a step has two, they are sent again, for
    // which six others are given up.
    assert_eq!(world.int(0, "failures"), 12);
    assert_eq!(world.int(0, "sent"), 4114);
}
