//! A free resource is granted within the bound: to a request without overlap, and to one of those that overlap.

use crate::support::{Story, assert_none, assert_only, seconds};
use starl_core::RobotId;
use starl_core::event::Event;

const NON_INTERFERENCE: &str = "mutex.non_interference";
const PROGRESS: &str = "mutex.progress";

/// Three robots, with a bound of 5 s.
fn story() -> Story {
    let mut story = Story::of_ground_robots(3);
    story.setting.properties.mutex_bound = seconds(5);
    story.setting.properties.mutex_alone_bound = seconds(5);
    story
}

#[test]
fn a_request_without_overlap_is_granted_in_time() {
    let mut late = story();
    late.locks(1000, 0, "acquire", "a")
        .locks(1000, 0, "acquire", "b");
    late.locks(2000, 1, "acquire", "c")
        .locks(2100, 1, "enter", "c");
    let verdict = late.verdict(20_000);
    assert_only(&verdict, NON_INTERFERENCE, 6000, &[0]);
    assert_eq!(
        verdict[0].text,
        "robot 0 did not get the requested resources within 5s, though no other robot holds or requests any of it"
    );
    late.locks(6000, 0, "enter", "a")
        .locks(6000, 0, "enter", "b");
    assert_none(&late.verdict(20_000));
}

#[test]
fn a_robot_that_asks_alone_has_a_bound_of_its_own() {
    let mut alone = story();
    alone.setting.properties.mutex_alone_bound = seconds(2);
    alone.locks(1000, 0, "acquire", "a");
    let mut both = alone.clone();
    assert_only(&alone.verdict(20_000), NON_INTERFERENCE, 3000, &[0]);
    both.locks(1500, 1, "acquire", "a");
    assert_only(&both.verdict(20_000), PROGRESS, 6000, &[0]);
}

#[test]
fn waiting_for_a_held_resource_is_correct() {
    let mut story = story();
    story.locks(1000, 1, "enter", "b");
    story
        .locks(1000, 0, "acquire", "a")
        .locks(1000, 0, "acquire", "b");
    assert_none(&story.verdict(20_000));
    story.locks(20_000, 1, "release", "b");
    assert_none(&story.verdict(25_000));
    assert_only(&story.verdict(26_000), NON_INTERFERENCE, 25_000, &[0]);
}

#[test]
fn robots_that_wait_for_each_other_are_reported_together() {
    let mut story = story();
    story
        .locks(1000, 0, "acquire", "a")
        .locks(1000, 0, "acquire", "b");
    story
        .locks(2000, 1, "acquire", "b")
        .locks(2000, 1, "acquire", "c");
    story.locks(2500, 2, "acquire", "c");
    let verdict = story.verdict(20_000);
    assert_only(&verdict, PROGRESS, 6000, &[0]);
    // A holder at the end of the row is waited for.
    let mut story = story_with_a_holder();
    assert_none(&story.verdict(20_000));
    story.locks(3000, 2, "release", "d");
    assert_only(&story.verdict(20_000), PROGRESS, 8000, &[0, 1]);
}

fn story_with_a_holder() -> Story {
    let mut story = story();
    story.locks(500, 2, "enter", "d");
    story
        .locks(1000, 0, "acquire", "a")
        .locks(1000, 0, "acquire", "b");
    story
        .locks(2000, 1, "acquire", "b")
        .locks(2000, 1, "acquire", "d");
    story
}

#[test]
fn a_request_that_is_withdrawn_is_over() {
    let mut story = story();
    story
        .locks(1000, 0, "acquire", "a")
        .locks(5000, 0, "withdraw", "a");
    assert_none(&story.verdict(20_000));
}

#[test]
fn robots_that_are_down_or_apart_excuse() {
    let mut story = story();
    story
        .locks(1000, 0, "acquire", "a")
        .fault(2000, Some(2), "crash");
    assert_none(&story.verdict(20_000));
    story.fault(20_000, Some(2), "restart");
    assert_none(&story.verdict(25_000));
    assert_only(&story.verdict(26_000), NON_INTERFERENCE, 25_000, &[0]);

    let mut apart = self::story();
    apart
        .locks(1000, 0, "acquire", "a")
        .fault(2000, None, "partition");
    assert_none(&apart.verdict(20_000));
    apart.fault(20_000, None, "heal");
    assert_none(&apart.verdict(25_000));
    assert_only(&apart.verdict(26_000), NON_INTERFERENCE, 25_000, &[0]);
}

#[test]
fn no_robot_is_overtaken_for_ever() {
    let mut story = story();
    story.locks(0, 0, "acquire", "a");
    for turn in 1..=101 {
        story
            .locks(turn * 100, 1, "enter", "a")
            .locks(turn * 100 + 50, 1, "release", "a");
    }
    assert_only(&story.verdict(12_000), PROGRESS, 10_100, &[0, 1]);
}

/// The same datagrams, delivered twice: before a partition and, where `late`, during it.
fn asks_in_a_partition(late: bool) -> Story {
    let mut story = story();
    story.sends(500, 1, 3, 0).sends(500, 2, 7, 0);
    story.fault(1000, None, "partition");
    story.locks(1200, 0, "acquire", "a");
    if late {
        for (from, sequence) in [(1, 3), (2, 7)] {
            let from = RobotId(from);
            story.record(1500, Some(0), Event::Delivered { from, sequence });
        }
    } else {
        story.sends(1500, 1, 4, 0).sends(1500, 2, 8, 0);
    }
    story
}

#[test]
fn a_late_copy_from_before_a_mutex_was_used_does_not_bridge_a_partition() {
    assert_none(&asks_in_a_partition(true).verdict(20_000));
    let bridged = asks_in_a_partition(false);
    assert_only(&bridged.verdict(20_000), NON_INTERFERENCE, 6200, &[0]);
}
