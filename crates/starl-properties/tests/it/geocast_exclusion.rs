//! A robot that has been outside the area all the time delivers nothing.

use crate::support::{Story, assert_none, assert_only, at, seconds};
use starl_core::{Area, ConvexPolygon, Duration, Point};

fn circle() -> Area {
    Area::Circle {
        center: at(0.0, 0.0),
        radius: 1.0,
    }
}

/// Robot 0 sends message 1 into an area at 1 s; d2 is 5 s. Robot 1 delivers it.
fn delivered(area: Area, millis: u64) -> Story {
    let mut story = Story::of_ground_robots(2);
    story.setting.properties.geocast_bound = seconds(5);
    story.geocasts(1000, 0, 1, area);
    story.delivers(millis, 1, "geocast", (0, 1));
    story
}

#[test]
fn delivery_far_from_the_area_is_reported_once() {
    let mut story = delivered(circle(), 1550);
    story.stays(0, 20_000, 1, at(3.0, 0.0));
    story.delivers(1750, 1, "geocast", (0, 1));
    let mut verdict = story.verdict(20_000);
    // That it comes twice is another matter.
    verdict.retain(|violation| violation.property == "geocast.exclusion");
    assert_only(&verdict, "geocast.exclusion", 1550, &[1, 0]);
    assert_eq!(
        verdict[0].text,
        "robot 1 delivered message 1 that robot 0 geocast at 1.000s, but had stayed at least 2.000 m \
         away from its area since"
    );
}

#[test]
fn delivery_inside_is_correct() {
    let mut story = delivered(circle(), 1550);
    story.stays(0, 20_000, 1, at(0.9, 0.0));
    assert_none(&story.verdict(20_000));
}

#[test]
fn the_boundary_is_as_wide_as_an_estimate_can_be_stale() {
    // A body can fall 0.11 m in the 100 ms between two poses and the 50 ms between two estimates.
    for (x, holds) in [(1.11, true), (1.12, false)] {
        let mut story = delivered(circle(), 1550);
        story.stays(0, 20_000, 1, at(x, 0.0));
        assert_eq!(story.verdict(20_000).is_empty(), holds, "{x}");
    }
    for (x, holds) in [(1.7, true), (1.72, false)] {
        let mut story = delivered(circle(), 1550);
        story.setting.position_noise = 0.1;
        story.stays(0, 20_000, 1, at(x, 0.0));
        assert_eq!(story.verdict(20_000).is_empty(), holds, "{x} with noise");
    }
}

#[test]
fn a_robot_that_leaves_meanwhile_may_deliver() {
    let mut story = delivered(circle(), 3050);
    story.walks(0, 1500, 1, at(0.0, 0.0), at(1.5, 0.0));
    story.walks(1600, 4000, 1, at(1.6, 0.0), at(4.0, 0.0));
    assert_none(&story.verdict(4000));
}

#[test]
fn a_robot_that_left_before_may_not() {
    let mut story = delivered(circle(), 3050);
    story.stays(0, 100, 1, at(0.0, 0.0));
    story.walks(800, 4000, 1, at(1.8, 0.0), at(5.0, 0.0));
    assert_only(&story.verdict(4000), "geocast.exclusion", 3050, &[1, 0]);
}

#[test]
fn a_robot_that_enters_after_delivery_was_outside_when_it_counted() {
    let mut story = delivered(circle(), 1550);
    story.stays(0, 2000, 1, at(3.0, 0.0));
    story.stays(2100, 20_000, 1, at(0.0, 0.0));
    assert_only(&story.verdict(20_000), "geocast.exclusion", 1550, &[1, 0]);
}

#[test]
fn a_late_copy_does_not_reach_a_robot_that_entered_after_the_bound() {
    // The sender repeats for 4 s beyond d2 at the most.
    for (enters, holds) in [(5000, true), (7000, false)] {
        let mut story = delivered(circle(), 9000);
        story.stays(0, enters - 2000, 1, at(3.0, 0.0));
        story.walks(enters - 1900, enters + 100, 1, at(3.0, 0.0), at(1.0, 0.0));
        story.stays(enters + 200, 20_000, 1, at(0.9, 0.0));
        assert_eq!(story.verdict(20_000).is_empty(), holds, "{enters}");
    }
}

#[test]
fn frozen_positioning_excuses() {
    let mut story = delivered(circle(), 1550);
    story.stays(0, 20_000, 1, at(3.0, 0.0));
    story.fault(500, Some(1), "frozen sensor");
    assert_none(&story.verdict(20_000));
}

#[test]
fn areas_of_every_shape_are_understood() {
    let square = ConvexPolygon::rectangle(at(-1.0, -1.0), at(1.0, 1.0)).expect("a square");
    let cuboid = Area::Box {
        low: Point::new(-1.0, -1.0, 0.0),
        high: Point::new(1.0, 1.0, 2.0),
    };
    for area in [Area::Polygon(square), cuboid] {
        for (place, holds) in [(at(0.9, 0.9), true), (at(1.3, 0.0), false)] {
            let mut story = delivered(area.clone(), 1550);
            story.stays(0, 20_000, 1, place);
            assert_eq!(story.verdict(20_000).is_empty(), holds, "{area:?} {place}");
        }
    }
}

#[test]
fn no_robot_is_in_an_invalid_area() {
    let nowhere = Area::Circle {
        center: at(0.0, 0.0),
        radius: -1.0,
    };
    let mut story = delivered(nowhere, 1550);
    story.stays(0, 20_000, 1, at(0.0, 0.0));
    let verdict = story.verdict(20_000);
    assert_only(&verdict, "geocast.exclusion", 1550, &[1, 0]);
}

#[test]
fn without_poses_nothing_is_claimed() {
    assert_none(&delivered(circle(), 1550).verdict(20_000));
}

#[test]
fn rare_estimates_widen_the_boundary() {
    let mut story = delivered(circle(), 1550);
    story.setting.estimate_period = Duration::from_millis(500);
    story.stays(0, 20_000, 1, at(2.5, 0.0));
    assert_none(&story.verdict(20_000));
}
