//! A robot that is in the area all the time delivers the message within the bound.

use crate::support::{Story, assert_none, assert_only, at, seconds};
use starl_core::event::DropReason;
use starl_core::{Area, ConvexPolygon, Event, Point, RobotId};

fn circle() -> Area {
    Area::Circle {
        center: at(0.0, 0.0),
        radius: 1.0,
    }
}

/// Robot 0 sends message 1 into an area at 1 s; d2 is 5 s.
fn sent_to(area: Area) -> Story {
    let mut story = Story::of_ground_robots(3);
    story.setting.properties.geocast_bound = seconds(5);
    story.geocasts(1000, 0, 1, area);
    story
}

/// Robots 0 and 1 are inside, robot 2 is far away; no robot delivers.
fn silence() -> Story {
    let mut story = sent_to(circle());
    story.stays(0, 20_000, 0, at(-0.5, 0.0));
    story.stays(0, 20_000, 1, at(0.5, 0.0));
    story.stays(0, 20_000, 2, at(9.0, 0.0));
    story
}

#[test]
fn a_robot_inside_that_does_not_deliver_is_reported_once_when_its_time_is_up() {
    let verdict = silence().verdict(20_000);
    assert_only(&verdict, "geocast.inclusion", 6000, &[0, 1]);
    assert_eq!(
        verdict[0].text,
        "message 1 that robot 0 geocast at 1.000s did not reach robot 1 within 5s, inside its area \
         throughout"
    );
}

#[test]
fn the_last_moment_is_in_time_and_the_next_is_not() {
    for (millis, holds) in [(6000, true), (6001, false)] {
        let mut story = silence();
        story.delivers(millis, 1, "geocast", (0, 1));
        assert_eq!(story.verdict(20_000).is_empty(), holds, "{millis}");
    }
}

#[test]
fn a_bound_that_has_not_run_out_is_not_judged() {
    let mut story = sent_to(circle());
    story.stays(0, 6000, 1, at(0.0, 0.0));
    assert_none(&story.verdict(6000));
}

#[test]
fn near_the_boundary_a_robot_may_decide_either_way() {
    for (x, holds) in [(0.89, true), (0.88, false)] {
        let mut story = sent_to(circle());
        story.stays(0, 20_000, 1, at(x, 0.0));
        assert_eq!(story.verdict(20_000).is_empty(), holds, "{x}");
    }
}

#[test]
fn a_robot_that_is_outside_for_a_part_of_the_time_is_not_owed_the_message() {
    // Until 1.1 s; from 5.9 s on; in between.
    for (from, to) in [(0, 1100), (5900, 20_000), (3000, 3100)] {
        let mut story = sent_to(circle());
        for millis in (0..=20_000).step_by(100) {
            let outside = (from..=to).contains(&millis);
            story.moved(millis, 1, at(if outside { 2.0 } else { 0.0 }, 0.0));
        }
        assert_none(&story.verdict(20_000));
    }
}

#[test]
fn positions_before_and_after_do_not_matter() {
    let mut story = sent_to(circle());
    story.stays(0, 600, 1, at(2.0, 0.0));
    story.stays(700, 6100, 1, at(0.0, 0.0));
    story.stays(6200, 20_000, 1, at(2.0, 0.0));
    assert_only(&story.verdict(20_000), "geocast.inclusion", 6000, &[0, 1]);
}

#[test]
fn robots_that_break_are_excused() {
    for (robot, fault) in [
        (1, "crash"),
        (1, "frozen sensor"),
        (1, "corrupt state"),
        (0, "crash"),
    ] {
        let mut story = silence();
        story.fault(2000, Some(robot), fault);
        assert_none(&story.verdict(20_000));
    }
    let mut story = silence();
    story.fault(2000, Some(1), "stuck motor");
    assert_only(&story.verdict(20_000), "geocast.inclusion", 6000, &[0, 1]);
}

#[test]
fn a_robot_behind_a_partition_is_excused() {
    let mut story = silence();
    let event = Event::Dropped {
        from: RobotId(0),
        to: Some(RobotId(1)),
        sequence: 0,
        reason: DropReason::Partition,
    };
    story.record(1000, Some(0), event);
    assert_none(&story.verdict(20_000));
}

#[test]
fn areas_of_every_shape_are_understood() {
    let square = ConvexPolygon::rectangle(at(-1.0, -1.0), at(1.0, 1.0)).expect("a square");
    let cuboid = Area::Box {
        low: Point::new(-1.0, -1.0, -1.0),
        high: Point::new(1.0, 1.0, 2.0),
    };
    for area in [Area::Polygon(square), cuboid] {
        for (place, owed) in [(at(0.8, 0.8), true), (at(1.3, 0.0), false)] {
            let mut story = sent_to(area.clone());
            story.stays(0, 20_000, 1, place);
            assert_ne!(story.verdict(20_000).is_empty(), owed, "{area:?} {place}");
        }
    }
}

#[test]
fn no_robot_is_owed_a_message_to_an_invalid_area() {
    let mut story = sent_to(Area::Circle {
        center: at(0.0, 0.0),
        radius: f64::NAN,
    });
    story.stays(0, 20_000, 1, at(0.0, 0.0));
    assert_none(&story.verdict(20_000));
}

#[test]
fn a_message_is_taken_once_inside_or_outside() {
    let mut story = silence();
    story.delivers(1100, 1, "geocast", (0, 1));
    let outside = |story: &mut Story, millis: u64, robot: u32| {
        let fields = [
            ("from", RobotId(0).into()),
            ("number", 1u32.into()),
            ("incarnation", 7u32.into()),
        ];
        story.report(millis, robot, ("geocast", "outside"), fields);
    };
    outside(&mut story, 1100, 2);
    assert_none(&story.verdict(20_000));
    let mut twice = story.clone();
    outside(&mut twice, 1200, 2);
    assert_only(&twice.verdict(20_000), "geocast.integrity", 1200, &[2, 0]);
    story.delivers(1200, 1, "geocast", (0, 1));
    assert_only(&story.verdict(20_000), "geocast.integrity", 1200, &[1, 0]);
}
