//! Messages between two programs: by broadcast, unicast and geocast, with fields of every type.

use crate::robot_support::{self, World, compile};
use starl_core::Point;
use starl_lang::machine::Value;

const ALL_WAYS: &str = r#"
program Ways

message Greeting(word: String, number: Int)

radio = Broadcast()
post = Unicast()
zone = Geocast()
shout = LocalBroadcast()

sent: Bool = false
heard: List[String] = []
senders: List[RobotId] = []

greet()
    pre not sent and me in {r for r in peers if robot_name(r) == "robot0"}
    eff
        sent = true
        radio.broadcast(Greeting("to all", 1))
        for r in peers
            if robot_name(r) == "robot1"
                post.send(r, Greeting("to one", 2))
        zone.geocast(Greeting("to those near", 3), circle(Point(5.0, 0.0), 1.0))
        shout.broadcast(Greeting("to whoever hears", 4))

on Greeting(from, word, number)
    heard.add(word)
    senders.add(from)
"#;

fn heard(world: &World, robot: usize) -> Vec<String> {
    let Value::List(words) = world.get(robot, "heard") else {
        panic!("no list")
    };
    let word = |value: &Value| match value {
        Value::Text(word) => word.clone(),
        other => panic!("{other}"),
    };
    let mut words: Vec<String> = words.iter().map(word).collect();
    words.sort();
    words
}

#[test]
fn each_kind_of_sending_reaches_its_receivers() {
    let mut world = World::of(&compile(ALL_WAYS), 3);
    world.put(2, Point::planar(5.5, 0.0));
    world.steps(3);
    assert_eq!(heard(&world, 0), [""; 0]);
    assert_eq!(heard(&world, 1), ["to all", "to one", "to whoever hears"]);
    let near = ["to all", "to those near", "to whoever hears"];
    assert_eq!(heard(&world, 2), near);
    assert_eq!(
        world.get(1, "senders").to_string(),
        "[robot0, robot0, robot0]",
        "the handler learns who sent"
    );
}

const EVERY_TYPE: &str = r#"
program Types

enum Color {red, green}
record Pair {left: Int, right: String}
message All(a: Bool, b: Int, c: Float, d: String, e: Point, f: Duration, g: RobotId, h: Color,
    i: List[Pair], j: Set[Int], k: Map[String, Point], l: Int?, m: Pair?, n: Area, o: Obstacles, p: Time)

radio = Broadcast()
sent: Bool = false
got: String = ""

send()
    pre not sent
    eff
        sent = true
        radio.broadcast(All(true, -7, 0.5, "x", Point(1.0, 2.0, 3.0), 5s, me, green, [Pair(1, "one")],
            {3, 2}, {"k": Point(0.0, 1.0)}, none, Pair(2, "two"), circle(Point(0.0, 0.0), 2.0), obstacles(), now))

on All(from, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p)
    if n.contains(Point(1.0, 1.0)) and g == from and p <= now and o == obstacles()
        got = String(a) + String(b) + String(c) + d + String(e) + String(f) + String(h) + String(i) + String(j) + String(k) + String(l) + String(m)
"#;

#[test]
fn values_of_every_type_arrive_as_they_were_sent() {
    let mut world = World::of(&compile(EVERY_TYPE), 2);
    world.steps(2);
    let Value::Text(got) = world.get(1, "got") else {
        panic!("no text")
    };
    assert_eq!(
        got,
        "true-70.5x(1.0, 2.0, 3.0)5sgreen[(left = 1, right = \"one\")]{2, 3}{\"k\": (0.0, 1.0, 0.0)}\
         none(left = 2, right = \"two\")"
    );
}

#[test]
fn programs_of_different_names_meet_where_they_name_the_place() {
    let hub = |name: &str, what: &str| {
        format!(
            "program {name}\n\nmessage Hello(word: String)\n\nradio = Broadcast({what})\nlast: String = \"\"\n\n\
             greet()\n    eff radio.broadcast(Hello(\"from {name}\"))\n\n\
             on Hello(from, word)\n    last = word\n"
        )
    };
    for (what, last) in [("\"meeting\"", "\"from Two\""), ("", "\"\"")] {
        let programs = [hub("One", what), hub("Two", what)];
        let programs = programs.map(|source| robot_support::program(&compile(&source)));
        let mut world = World::new(programs.into());
        world.steps(2);
        assert_eq!(world.get(0, "last").to_string(), last);
    }
}
