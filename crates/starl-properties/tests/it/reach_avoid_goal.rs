//! A ReachAvoid that is done has had its robot truly at the target a moment ago.

use crate::support::{FLYER, GROUND, Story, assert_none, assert_only, at};
use starl_core::{Duration, Point};

/// A robot of this body stands at a place and says that it is done with its target at the origin.
fn done_at(body: starl_core::motion::Body, target: Point, place: Point) -> Story {
    let mut story = Story::of(&[body]);
    story.starts(100, 0, target, &[]);
    story.stays(0, 4000, 0, place);
    story.ends(3050, 0, "done");
    story
}

#[test]
fn done_far_from_the_target_is_reported() {
    let verdict = done_at(GROUND, at(0.0, 0.0), at(0.2, 0.0)).verdict(4000);
    assert_only(&verdict, "reach_avoid.goal", 3050, &[0]);
    assert_eq!(
        verdict[0].text,
        "robot 0 reported that it had reached (0.000, 0.000, 0.000) m, but had come no nearer than \
         0.200 m in the last 1s; the vicinity is 0.100 m"
    );
}

#[test]
fn the_vicinity_and_the_uncertainty_of_poses_are_granted() {
    // 0.1 m of vicinity and 0.049 m that a body can fall in 100 ms.
    assert_none(&done_at(GROUND, at(0.0, 0.0), at(0.149, 0.0)).verdict(4000));
    let verdict = done_at(GROUND, at(0.0, 0.0), at(0.15, 0.0)).verdict(4000);
    assert_only(&verdict, "reach_avoid.goal", 3050, &[0]);
}

#[test]
fn six_deviations_of_positioning_noise_are_granted() {
    for (place, holds) in [(0.2, true), (0.22, false)] {
        let mut story = done_at(GROUND, at(0.0, 0.0), at(place, 0.0));
        story.setting.position_noise = 0.01;
        assert_eq!(story.verdict(4000).is_empty(), holds, "{place}");
    }
}

#[test]
fn having_been_there_within_a_second_will_do() {
    // At 1 m/s it is 0.1 m + 0.049 m + 0.1 m of a pose's way off after a quarter of a second.
    for (left, holds) in [(1800, true), (1700, false)] {
        let way = 0.001 * (4000 - left) as f64;
        let mut story = Story::of(&[GROUND]);
        story.starts(100, 0, at(0.0, 0.0), &[]);
        story.stays(0, left - 100, 0, at(0.0, 0.0));
        story.walks(left, 4000, 0, at(0.0, 0.0), at(way, 0.0));
        story.ends(3050, 0, "done");
        assert_eq!(story.verdict(4000).is_empty(), holds, "{left}");
    }
}

#[test]
fn ground_robots_leave_the_height_of_the_target_out() {
    assert_none(&done_at(GROUND, Point::new(0.0, 0.0, 1.5), at(0.05, 0.0)).verdict(4000));
}

#[test]
fn flyers_are_measured_in_space_from_where_they_can_be() {
    // The lowest height of travel is 1 m.
    let target = at(0.0, 0.0);
    assert_none(&done_at(FLYER, target, Point::new(0.05, 0.0, 1.0)).verdict(4000));
    let low = done_at(FLYER, target, Point::new(0.0, 0.0, 0.5)).verdict(4000);
    assert_only(&low, "reach_avoid.goal", 3050, &[0]);
}

#[test]
fn a_second_done_without_a_command_says_nothing() {
    let mut story = done_at(GROUND, at(0.0, 0.0), at(1.0, 0.0));
    story.ends(3250, 0, "done");
    assert_only(&story.verdict(4000), "reach_avoid.goal", 3050, &[0]);
}

#[test]
fn frozen_positioning_excuses_until_it_is_repaired() {
    let mut story = done_at(GROUND, at(0.0, 0.0), at(1.0, 0.0));
    story.fault(500, Some(0), "frozen sensor");
    assert_none(&story.verdict(4000));
    story.fault(3060, Some(0), "repair");
    story.starts(3100, 0, at(0.0, 0.0), &[]);
    story.ends(3350, 0, "done");
    assert_only(&story.verdict(4000), "reach_avoid.goal", 3350, &[0]);
}

#[test]
fn rare_poses_leave_more_open() {
    let mut story = done_at(GROUND, at(0.0, 0.0), at(0.29, 0.0));
    story.setting.pose_period = Duration::from_millis(200);
    assert_none(&story.verdict(4000));
}
