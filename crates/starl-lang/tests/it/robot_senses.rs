//! A program's knowledge of its robot and the world.

use crate::robot_support::{World, compile};
use starl_core::sensor::{Contact, Detected, Detection, Ray};
use starl_core::{Obstacle, Point, RobotId};

const SENSES: &str = r#"
program Senses

what: String

look()
    eff
        what = String(me) + " " + String(position) + " " + String(heading) + " " + String(velocity) + " " + String(now) + " " + String(peers) + " " + String(bumped) + " " + String(ranges) + " " + String(detected) + " " + String(way_points()) + " " + String(way_point("w1")) + " " + String(way_point("w9")) + " " + String(obstacles())
"#;

fn what(world: &World, robot: usize) -> String {
    world.get(robot, "what").to_string()
}

#[test]
fn without_sensors_there_is_nothing_to_sense() {
    let mut world = World::of(&compile(SENSES), 2).with_way_points(&[(1.0, 2.0), (3.0, 4.0)]);
    world.put(1, Point::planar(0.5, 1.5));
    world.step();
    assert_eq!(
        what(&world, 1),
        "\"robot1 (0.5, 1.5, 0.0) 0.0 (0.0, 0.0, 0.0) 0.000s {robot0, robot1} none [] [] \
         [(1.0, 2.0, 0.0), (3.0, 4.0, 0.0)] (3.0, 4.0, 0.0) none 0 obstacles\""
    );
    world.step();
    assert!(what(&world, 1).contains(" 0.100s "));
}

#[test]
fn sensors_are_read() {
    let mut world = World::of(&compile(SENSES), 1);
    world.obstacles = [Obstacle::circle(Point::ZERO, 1.0)].into();
    let ray = |bearing, distance| Ray {
        bearing,
        distance,
        nearness: 0.0,
    };
    world.robots[0].rays = vec![ray(-1.0, 0.25), ray(1.0, 2.0)];
    let seen = |what, x| Detection {
        what,
        position: Point::planar(x, 0.0),
    };
    world.robots[0].detections = vec![
        seen(Detected::Thing(4), 1.0),
        seen(Detected::Robot(RobotId(7)), 2.0),
    ];
    for (bearing, side) in [(1.0, "left"), (-1.0, "right"), (0.0, "both"), (3.0, "none")] {
        world.robots[0].bumper = Some(Contact { bearing });
        world.step();
        let expected = format!(
            "{{robot0}} {side} [0.25, 2.0] [(robot = none, thing = 4, position = (1.0, 0.0, 0.0)), \
             (robot = robot7, thing = none, position = (2.0, 0.0, 0.0))] [] none none 1 obstacles"
        );
        assert!(what(&world, 0).contains(&expected), "{}", what(&world, 0));
    }
}

#[test]
fn each_fleet_reads_its_own_waypoints() {
    // The list is made once for all; it must still be the right one for each.
    let code = compile(SENSES);
    let mut one = World::of(&code, 2).with_way_points(&[(1.0, 0.0)]);
    one.step();
    assert_eq!(
        what(&one, 0).replace("robot0 (", ""),
        what(&one, 1).replace("robot1 (", "")
    );
    let mut changed = one.with_way_points(&[(-0.0, 0.0), (2.0, 2.0)]);
    changed.step();
    assert!(what(&changed, 0).contains("[(-0.0, 0.0, 0.0), (2.0, 2.0, 0.0)]"));
}

const CHANCE: &str = r#"
program Chance

low: Int = 0
high: Int = 0
wide: Bool = true
float: Float = 0.0
picked: String? = none
nothing: Int? = none

draw()
    eff
        let n = random_int(-3, 4)
        low = min(low, n)
        high = max(high, n)
        float = random(2.0, 2.5)
        let far = random_int(-9000000000000000000, 9000000000000000000)
        wide = wide and far >= -9000000000000000000 and far < 9000000000000000000
        picked = choose(["a", "b"])
        nothing = choose([i for i in 0..0])
"#;

#[test]
fn chance_stays_within_bounds_and_reaches_all_of_them() {
    let mut world = World::of(&compile(CHANCE), 2);
    let mut picked = std::collections::BTreeSet::new();
    for _ in 0..200 {
        world.step();
        picked.insert(world.get(0, "picked").to_string());
        let starl_lang::machine::Value::Float(float) = world.get(0, "float") else {
            panic!("no Float")
        };
        assert!((2.0..2.5).contains(&float));
    }
    assert_eq!((world.int(0, "low"), world.int(0, "high")), (-3, 3));
    assert_eq!(picked.len(), 2);
    assert_eq!(world.get(0, "nothing").to_string(), "none");
    assert_eq!(world.get(0, "wide").to_string(), "true");
    // Robots have streams of their own.
    assert_ne!(world.get(0, "float"), world.get(1, "float"));
}

#[test]
fn no_number_lies_between_bounds_in_the_wrong_order() {
    let source = "program Bounds\n\nx: Int = 0\n\ndraw()\n    eff x = random_int(4, 4)\n";
    let mut world = World::of(&compile(source), 1);
    world.step();
    let reason = world.failure(0).unwrap_or_default();
    assert_eq!(reason, "bounds.starl:6:13: no Int is from 4 to below 4");
}
