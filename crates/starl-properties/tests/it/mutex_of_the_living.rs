//! A lease mutex frees the resources of a crashed robot, and continues while a majority of its arbiters is up, ready
//! and connected. Each excuse is also tried with a run that it must not excuse.

use crate::support::{Story, assert_none, assert_only, seconds};
use starl_core::event::Value;
use starl_properties::Excuse;

const NON_INTERFERENCE: &str = "mutex.non_interference";
const PROGRESS: &str = "mutex.progress";
const FENCING: &str = "mutex.fencing";

/// Five robots, all ready from 500 ms on, with a bound of 5 s; `needed` have to be for a request to be granted.
fn story(needed: i64) -> Story {
    let mut story = Story::of_ground_robots(5);
    story.setting.properties.mutex_bound = seconds(5);
    story.setting.properties.mutex_alone_bound = seconds(5);
    for robot in 0..5 {
        ready(&mut story, 500, robot, needed, false);
    }
    story
}

fn ready(story: &mut Story, millis: u64, robot: u32, needed: i64, anew: bool) {
    let fields = [
        ("participants", Value::Int(5)),
        ("needed", Value::Int(needed)),
        ("anew", Value::Bool(anew)),
    ];
    story.report(millis, robot, ("mutex", "ready"), fields);
}

fn numbered(story: &mut Story, millis: u64, robot: u32, number: i64) {
    let fields = [
        ("resource", Value::Text("a".into())),
        ("fencing", Value::Int(number)),
        ("drift", Value::Float(0.01)),
    ];
    story.report(millis, robot, ("mutex", "enter"), fields);
    story.locks(millis + 100, robot, "release", "a");
}

/// The bug that no campaign saw: the lease of a holder that has died never ends.
#[test]
fn a_lease_that_outlives_its_crashed_holder_is_reported() {
    let mut story = story(3);
    story
        .locks(1000, 4, "acquire", "a")
        .locks(1100, 4, "enter", "a");
    story
        .fault(2000, Some(4), "crash")
        .fault(2000, Some(3), "crash");
    story.locks(2500, 0, "acquire", "a");
    assert_only(&story.verdict(30_000), NON_INTERFERENCE, 7500, &[0]);
    story.locks(3000, 1, "acquire", "a");
    assert_only(&story.verdict(30_000), PROGRESS, 7500, &[0]);
    story.locks(7000, 0, "enter", "a");
    assert_none(&story.verdict(30_000));
}

#[test]
fn only_a_ready_majority_must_continue() {
    let mut story = story(3);
    for robot in [2, 3, 4] {
        story.fault(2000, Some(robot), "crash");
    }
    story.locks(2500, 0, "acquire", "a");
    assert_none(&story.verdict(30_000));
    assert_eq!(
        story.excused(30_000, NON_INTERFERENCE),
        [(Excuse::NoMajority, 1)]
    );
    // A robot that has started has forgotten its grants until it reports otherwise.
    story.fault(10_000, Some(2), "restart");
    assert_none(&story.verdict(30_000));
    ready(&mut story, 12_000, 2, 3, true);
    assert_only(&story.verdict(30_000), NON_INTERFERENCE, 17_000, &[0]);
}

#[test]
fn with_storage_a_robot_need_not_be_ready_again() {
    let mut story = story(3);
    story.setting.keeps_storage = true;
    for robot in [2, 3, 4] {
        story.fault(2000, Some(robot), "crash");
    }
    story.locks(2500, 0, "acquire", "a");
    story.fault(10_000, Some(2), "restart");
    assert_only(&story.verdict(30_000), NON_INTERFERENCE, 15_000, &[0]);
    story.fault(9000, Some(2), "storage lost");
    assert_none(&story.verdict(30_000));
}

#[test]
fn the_part_with_a_majority_must_continue() {
    let mut story = story(3);
    story.fault(2000, None, "partition");
    for (number, (from, to)) in [(0, 1), (1, 2), (3, 4)].into_iter().enumerate() {
        story.sends(2100, from, number as u32, to);
    }
    story
        .locks(2500, 0, "acquire", "a")
        .locks(2500, 4, "acquire", "b");
    assert_only(&story.verdict(30_000), NON_INTERFERENCE, 7500, &[0]);
    // Robots outside it do not keep those in it from what they want too.
    story.locks(1500, 4, "acquire", "a");
    assert_only(&story.verdict(30_000), PROGRESS, 7500, &[0]);
}

#[test]
fn all_robots_are_needed_with_quorums() {
    let mut story = story(5);
    story.fault(2000, Some(4), "crash");
    story.locks(2500, 0, "acquire", "a");
    assert_none(&story.verdict(30_000));
    assert_eq!(story.excused(30_000, NON_INTERFERENCE), [(Excuse::Down, 1)]);
}

#[test]
fn numbers_may_go_back_where_a_majority_has_forgotten_them_and_says_so() {
    let mut story = story(3);
    numbered(&mut story, 1000, 0, 900);
    for robot in [2, 3, 4] {
        story.fault(2000, Some(robot), "crash");
    }
    let mut silent = story.clone();
    numbered(&mut silent, 3000, 1, 7);
    assert_only(&silent.verdict(30_000), FENCING, 3000, &[1, 0]);
    ready(&mut story, 2500, 2, 3, true);
    numbered(&mut story, 3000, 1, 7);
    assert_none(&story.verdict(30_000));
    assert_eq!(story.excused(30_000, FENCING), [(Excuse::NoMajority, 1)]);
    // From then on they grow again.
    numbered(&mut story, 4000, 0, 7);
    assert_only(&story.verdict(30_000), FENCING, 4000, &[0, 1]);
}

#[test]
fn reports_without_a_majority_that_forgot_are_not_excused() {
    let mut story = story(3);
    numbered(&mut story, 1000, 0, 900);
    for robot in [3, 4] {
        story.fault(2000, Some(robot), "crash");
        ready(&mut story, 2500, robot, 3, true);
    }
    numbered(&mut story, 3000, 1, 7);
    assert_only(&story.verdict(30_000), FENCING, 3000, &[1, 0]);
}

#[test]
fn with_storage_numbers_grow_though_all_crash_at_once() {
    let mut story = story(3);
    story.setting.keeps_storage = true;
    numbered(&mut story, 1000, 0, 900);
    for robot in 0..5 {
        story.fault(2000, Some(robot), "crash");
        story.fault(2100, Some(robot), "restart");
        ready(&mut story, 2500, robot, 3, true);
    }
    numbered(&mut story, 3000, 1, 7);
    assert_only(&story.verdict(30_000), FENCING, 3000, &[1, 0]);
}
