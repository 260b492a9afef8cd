//! A program sees things by their names, takes one, knows that it holds it, and puts it down.

use crate::robot_support::{World, compile};
use starl_core::sensor::{Detected, Detection};
use starl_core::{Point, RobotId};

const COLLECT: &str = r#"
program Collect

seen: String
held: String = "nothing"

look()
    eff seen = String({t.name: t.position for t in things})

pick()
    pre holding == none and some t = things.first()
    eff take(t.number)

tell()
    pre some t = holding and held != thing_name(t)
    eff held = thing_name(t)

on input drop()
    put_down()
    held = "nothing"

on input grasp(thing: Int)
    take(thing)
"#;

fn world() -> World {
    let mut world = World::of(&compile(COLLECT), 1);
    world.thing_names = vec!["box".into(), "".into(), "cup".into()];
    world
}

fn sight(what: Detected, x: f64) -> Detection {
    Detection {
        what,
        position: Point::planar(x, 0.0),
    }
}

fn order(name: &'static str, thing: Option<i64>) -> starl_core::Input {
    let fields = thing.map(|thing| ("thing".into(), thing.into()));
    starl_core::Input::Order(starl_core::Order {
        name: name.into(),
        fields: fields.into_iter().collect(),
    })
}

#[test]
fn things_in_sight_have_a_number_a_name_and_a_place() {
    let mut world = world();
    world.robots[0].detections = vec![
        sight(Detected::Thing(2), 0.5),
        sight(Detected::Robot(RobotId(0)), 0.7),
        sight(Detected::Thing(0), 1.0),
    ];
    world.step();
    let seen = world.get(0, "seen").to_string();
    assert_eq!(
        seen,
        r#""{\"box\": (1.0, 0.0, 0.0), \"cup\": (0.5, 0.0, 0.0)}""#
    );
}

#[test]
fn the_nearest_thing_is_taken_and_put_down_again() {
    let mut world = world();
    world.step();
    assert_eq!(world.robots[0].holding, None, "there is nothing in sight");
    world.robots[0].detections = vec![sight(Detected::Thing(2), 0.1)];
    world.steps(2);
    assert_eq!(world.robots[0].holding, Some(2));
    assert_eq!(world.get(0, "held").to_string(), "\"cup\"");
    world.robots[0].detections.clear();
    world.input(0, &order("drop", None));
    world.step();
    assert_eq!(world.robots[0].holding, None);
    assert_eq!(world.get(0, "held").to_string(), "\"nothing\"");
}

#[test]
fn a_number_without_a_thing_is_not_taken_and_has_no_name() {
    let mut world = world();
    for thing in [-1, i64::from(u32::MAX) + 1] {
        world.input(0, &order("grasp", Some(thing)));
        assert_eq!(world.robots[0].holding, None, "{thing}");
    }
    let text = r#"
program Names

names: List[String]

init
    names = [thing_name(n) for n in [0, 1, 2, 3, -1, 4294967296]]
"#;
    let mut world = World::unstarted(vec![crate::robot_support::program(&compile(text))]);
    world.thing_names = vec!["box".into(), "".into(), "cup".into()];
    world.start();
    assert_eq!(
        world.get(0, "names").to_string(),
        "[\"box\", \"\", \"cup\", \"\", \"\", \"\"]"
    );
}
