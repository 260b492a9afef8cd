//! A robot whose true position enters the unsafe set of its ReachAvoid violates safety, independent of the primitive's
//! belief.

use crate::support::{FLYER, Story, assert_none, assert_only, at};
use starl_core::geometry::HeightSpan;
use starl_core::{ConvexPolygon, Obstacle, Point};

fn pool() -> Obstacle {
    Obstacle::circle(at(2.0, 0.0), 0.5)
}

/// A robot goes along x through 1.5 m, where the pool begins, at 1 m/s.
fn through_the_pool() -> Story {
    let mut story = Story::of_ground_robots(2);
    story.walks(0, 3000, 1, at(0.0, 0.0), at(3.0, 0.0));
    story
}

#[test]
fn entering_the_unsafe_set_is_reported_once() {
    let mut story = through_the_pool();
    story.starts(250, 1, at(3.0, 0.0), &[pool()]);
    let verdict = story.verdict(3000);
    assert_only(&verdict, "reach_avoid.safety", 1500, &[1]);
    assert_eq!(
        verdict[0].text,
        "robot 1 went from (1.400, 0.000, 0.000) m to (1.500, 0.000, 0.000) m, into obstacle 0 of \
         the unsafe set of the command to (3.000, 0.000, 0.000) m that it was given 1250ms before"
    );
}

#[test]
fn passing_beside_it_is_safe() {
    let mut story = Story::of_ground_robots(1);
    story.starts(250, 0, at(3.0, 0.51), &[pool()]);
    story.walks(0, 3000, 0, at(0.0, 0.51), at(3.0, 0.51));
    assert_none(&story.verdict(3000));
}

#[test]
fn nothing_is_unsafe_for_a_robot_without_a_command() {
    for end in ["done", "give_up", "stop"] {
        let mut story = through_the_pool();
        story.starts(250, 1, at(1.2, 0.0), &[pool()]);
        story.ends(1250, 1, end);
        assert_none(&story.verdict(3000));
    }
}

#[test]
fn the_next_command_brings_its_own_unsafe_set() {
    let mut story = through_the_pool();
    story.starts(250, 1, at(3.0, 0.0), &[pool()]);
    story.starts(
        1250,
        1,
        at(3.0, 0.0),
        &[Obstacle::circle(at(2.0, 3.0), 0.5)],
    );
    assert_none(&story.verdict(3000));
    story.starts(2150, 1, at(3.0, 0.0), &[pool()]);
    assert_only(&story.verdict(3000), "reach_avoid.safety", 2200, &[1]);
}

#[test]
fn a_failure_that_the_primitive_reports_first_is_judged_at_the_next_pose() {
    let mut story = through_the_pool();
    story.starts(250, 1, at(3.0, 0.0), &[pool()]);
    story.ends(1450, 1, "failed");
    assert_only(&story.verdict(3000), "reach_avoid.safety", 1500, &[1]);
    let mut false_alarm = through_the_pool();
    false_alarm.starts(250, 1, at(3.0, 0.0), &[pool()]);
    false_alarm.ends(1350, 1, "failed");
    assert_none(&false_alarm.verdict(3000));
}

#[test]
fn a_wall_without_thickness_cannot_be_slipped_through_between_two_poses() {
    let wall = ConvexPolygon::new(&[at(1.55, -1.0), at(1.55, 1.0)]).expect("a wall");
    let mut story = through_the_pool();
    story.starts(250, 1, at(3.0, 0.0), &[Obstacle::polygon(wall)]);
    assert_only(&story.verdict(3000), "reach_avoid.safety", 1600, &[1]);
}

#[test]
fn flyers_may_pass_over() {
    for (height, safe) in [(1.5, true), (0.9, false)] {
        let low = pool().with_height(HeightSpan::new(0.0, 1.0));
        let mut story = Story::of(&[FLYER]);
        let (start, end) = (Point::new(0.0, 0.0, height), Point::new(3.0, 0.0, height));
        story.starts(50, 0, end, &[low]);
        story.walks(0, 3000, 0, start, end);
        assert_eq!(story.verdict(3000).is_empty(), safe, "{height}");
    }
}

#[test]
fn a_robot_that_does_not_work_is_excused() {
    for fault in ["crash", "stuck motor", "frozen sensor", "corrupt state"] {
        let mut story = through_the_pool();
        story.starts(250, 1, at(3.0, 0.0), &[pool()]);
        story.fault(1200, Some(1), fault);
        assert_none(&story.verdict(3000));
        let mut another = through_the_pool();
        another.starts(250, 1, at(3.0, 0.0), &[pool()]);
        another.fault(1200, Some(0), fault);
        assert_only(&another.verdict(3000), "reach_avoid.safety", 1500, &[1]);
    }
}

#[test]
fn a_robot_that_was_repaired_before_the_command_is_not_excused() {
    let mut story = through_the_pool();
    story.fault(50, Some(1), "stuck motor");
    story.fault(150, Some(1), "repair");
    story.starts(250, 1, at(3.0, 0.0), &[pool()]);
    assert_only(&story.verdict(3000), "reach_avoid.safety", 1500, &[1]);
}
