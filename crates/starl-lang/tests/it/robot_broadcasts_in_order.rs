//! Broadcasts in causal and in total order, as programs use them.

use crate::robot_support::{World, compile};

const TELLERS: &str = r#"
program Tellers

message News(number: Int)

radio = Broadcast(order = ORDER)
told: Int = 0
heard: List[String] = []
down: Bool = false
gaps: Int = 0

tell()
    pre told < 5
    eff
        told = told + 1
        radio.broadcast(News(told))

watch()
    pre down != radio.failed
    eff
        down = radio.failed

on News(from, number)
    heard.add("{robot_name(from)}:{number}")

on radio.gap(from)
    gaps = gaps + 1
"#;

fn heard(order: &str, robots: u32) -> Vec<String> {
    let text = TELLERS.replace("ORDER", order);
    let mut world = World::of(&compile(&text), robots);
    world.steps(100);
    (0..robots)
        .map(|robot| world.get(robot as usize, "heard").to_string())
        .collect()
}

#[test]
fn in_total_order_all_hear_the_same() {
    let heard = heard("total", 3);
    assert_eq!(heard[0], heard[1]);
    assert_eq!(heard[0], heard[2]);
    assert_eq!(heard[0].matches("robot").count(), 15, "{}", heard[0]);
}

#[test]
fn in_causal_order_all_hear_the_others() {
    for heard in heard("causal", 3) {
        assert_eq!(heard.matches("robot").count(), 10, "{heard}");
    }
}

#[test]
fn the_example_does_as_it_says() {
    let text = include_str!("../../../../examples/primitives/broadcast.starl");
    let mut world = World::of(&compile(text), 4);
    world.steps(200);
    for robot in 0..4 {
        // 20 messages of the robots' own, and an answer to each.
        assert_eq!(world.get(robot, "heard").to_string(), "40");
    }
}
