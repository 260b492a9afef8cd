//! Excuses by recorded faults are counted, by property and reason; without an excuse nothing is counted.

use crate::support::{Story, assert_none, at, seconds};
use starl_core::event::Hit;
use starl_properties::Excuse;

fn story() -> Story {
    let mut story = Story::of_ground_robots(3);
    story.setting.properties.broadcast_bound = seconds(5);
    story.setting.properties.mutex_bound = seconds(5);
    story.setting.properties.mutex_alone_bound = seconds(5);
    story.setting.properties.barrier_bound = seconds(5);
    story.setting.properties.progress_bound = seconds(5);
    story
}

/// Nothing is violated, and this is excused.
#[track_caller]
fn assert_excused(story: &Story, property: &str, excused: &[(Excuse, u64)]) {
    assert_none(&story.verdict(60_000));
    assert_eq!(story.excused(60_000, property), excused);
}

#[test]
fn nothing_is_excused_where_nothing_breaks() {
    let mut story = story();
    story.broadcasts(1000, 0, 1);
    story
        .delivers(1200, 1, "broadcast", (0, 1))
        .delivers(1300, 2, "broadcast", (0, 1));
    story.locks(2000, 1, "acquire", "a");
    story.locks(2500, 1, "enter", "a");
    assert_excused(&story, "broadcast.delivery", &[]);
    assert_excused(&story, "mutex.non_interference", &[]);
}

#[test]
fn a_receiver_that_is_down_is_owed_no_message() {
    let mut story = story();
    story.fault(500, Some(2), "crash");
    story.broadcasts(1000, 0, 1);
    story.delivers(1200, 1, "broadcast", (0, 1));
    assert_excused(&story, "broadcast.delivery", &[(Excuse::Down, 1)]);
}

#[test]
fn a_request_waits_for_a_robot_that_is_down() {
    let mut story = story();
    story.locks(1000, 1, "acquire", "a");
    story.fault(2000, Some(0), "crash");
    // However often it is looked at.
    for second in 3..30 {
        story.stays(second * 1000, second * 1000 + 500, 2, at(5.0, 5.0));
    }
    assert_excused(&story, "mutex.non_interference", &[(Excuse::Down, 1)]);
    assert_excused(&story, "mutex.progress", &[]);
}

#[test]
fn a_robot_with_stuck_motors_need_not_arrive() {
    let mut story = story();
    story.starts(1000, 0, at(3.0, 0.0), &[]);
    story.fault(2000, Some(0), "stuck motor");
    assert_excused(&story, "reach_avoid.progress", &[(Excuse::Motors, 1)]);
}

#[test]
fn two_may_hold_a_resource_after_a_corruption() {
    let mut story = story();
    story.locks(1000, 0, "enter", "a");
    story.fault(2000, Some(1), "corrupt state");
    story.locks(2500, 1, "enter", "a");
    assert_excused(&story, "mutex.safety", &[(Excuse::Corruption, 1)]);
}

#[test]
fn falling_robots_may_touch_others() {
    let mut story = Story::of(&[crate::support::FLYER, crate::support::GROUND]);
    let above = at(0.0, 0.0).at_height(2.0);
    story.moved(1000, 0, above).moved(1000, 1, at(3.0, 0.0));
    story.fault(1100, Some(0), "crash");
    story.moved(1300, 0, at(0.0, 0.0).at_height(1.0));
    story.collided(1400, 0, Hit::Robot(starl_core::RobotId(1)));
    assert_excused(&story, "no_collision", &[(Excuse::Fall, 1)]);
}
