//! ReachAvoid in a program: its settings, its flags, and what stops it.

use crate::robot_support::{World, compile};
use starl_core::event::{PrimitiveEvent, ReachAvoidEvent};
use starl_core::sensor::{Detected, Detection};
use starl_core::{Event, Obstacle, Point, RobotId};

const MOVES: &str = r#"
program Moves

motion = ReachAvoid(vicinity = 20cm, most_replans = 3)
reached: Bool = false
trouble: Bool = false
because: MotionTrouble? = none

go()
    pre not motion.active and not motion.done and not motion.failed
    eff motion.reach_avoid(Point(3.0, 0.0), obstacles())

arrive()
    pre motion.done
    eff reached = true; finish()

fail_there()
    pre motion.failed
    eff trouble = true; because = motion.reason
"#;

#[test]
fn it_goes_there_with_the_settings_of_the_binding() {
    let mut world = World::of(&compile(MOVES), 1);
    world.steps(3);
    assert_eq!(world.get(0, "reached").to_string(), "true");
    assert_eq!(world.get(0, "because").to_string(), "none");
    assert!(world.robots[0].node.condition().finished);
    let starts = world.events_of(0).filter_map(|event| match event {
        Event::Primitive {
            event:
                PrimitiveEvent::ReachAvoid(ReachAvoidEvent::Start {
                    target, vicinity, ..
                }),
            ..
        } => Some((*target, *vicinity)),
        _ => None,
    });
    assert_eq!(starts.last(), Some((Point::planar(3.0, 0.0), 0.2)));
}

#[test]
fn in_the_unsafe_set_it_has_failed() {
    let mut world = World::of(&compile(MOVES), 1);
    world.obstacles = [Obstacle::circle(Point::ZERO, 1.0)].into();
    world.steps(2);
    assert_eq!(world.get(0, "trouble").to_string(), "true");
    assert_eq!(world.get(0, "because").to_string(), "in_unsafe_set");
}

const FOLLOWS: &str = r#"
program Follows

motion = ReachAvoid()
sent: Bool = false

go()
    pre not sent
    eff motion.follow([Point(1.0, 0.0), Point(1.0, 2.0, 0.5)], obstacles()); sent = true
"#;

#[test]
fn it_follows_a_list_of_points() {
    let mut world = World::of(&compile(FOLLOWS), 1);
    world.steps(1);
    let paths = world.events_of(0).filter_map(|event| match event {
        Event::Primitive {
            event: PrimitiveEvent::ReachAvoid(ReachAvoidEvent::Path { path }),
            ..
        } => Some(path.clone()),
        _ => None,
    });
    let path = vec![
        Point::ZERO,
        Point::planar(1.0, 0.0),
        Point::planar(1.0, 2.0),
    ];
    assert_eq!(paths.collect::<Vec<_>>(), [path]);
}

const LANE: &str = r#"
program Lane

motion = ReachAvoid(gap = 50cm)
goes: Bool = false
ways: List[Float]

go()
    pre not goes
    eff motion.drive_lane([Point(0.0, 0.0), Point(9.0, 0.0)], 6m); goes = true

/// It depends on nothing that the program or a message changes.
note()
    pre goes and (ways.last() ?? 0.0) != motion.free()
    eff ways.add(motion.free())
"#;

#[test]
fn it_drives_in_a_lane_and_tells_how_far_it_is_free() {
    let mut world = World::of(&compile(LANE), 1);
    world.steps(3);
    for x in [7.0, 8.0] {
        world.robots[0].detections = vec![Detection {
            what: Detected::Robot(RobotId(1)),
            position: Point::planar(x, 0.0),
        }];
        world.steps(3);
    }
    assert_eq!(world.get(0, "ways").to_string(), "[9.0, 6.5, 7.5]");
    let starts = world.events_of(0).filter_map(|event| match event {
        Event::Primitive {
            event: PrimitiveEvent::ReachAvoid(ReachAvoidEvent::Start { target, .. }),
            ..
        } => Some(*target),
        _ => None,
    });
    assert_eq!(starts.last(), Some(Point::planar(6.0, 0.0)));
}

const STOPS: &str = r#"
program Stops

motion = ReachAvoid()
step: Int = 0

go()
    pre step == 0
    eff motion.reach_avoid(Point(3.0, 0.0), obstacles()); step = 1

halt()
    pre step == 1 and motion.active
    eff stop(); step = 2
"#;

#[test]
fn stop_ends_every_kind_of_motion() {
    let mut world = World::of(&compile(STOPS), 1);
    world.step();
    world.step();
    assert_eq!(world.int(0, "step"), 2);
    let stops = world.events_of(0).filter(|event| {
        matches!(
            event,
            Event::Primitive {
                event: PrimitiveEvent::ReachAvoid(ReachAvoidEvent::Stop),
                ..
            }
        )
    });
    assert_eq!(stops.count(), 1);
    assert!(world.robots[0].travel.halts > 0);
}
