//! A resource is held by one robot at a time, and the numbers of successive holders grow.

use crate::support::{Story, assert_none, assert_only, seconds};

const SAFETY: &str = "mutex.safety";
const FENCING: &str = "mutex.fencing";

fn story() -> Story {
    Story::of_ground_robots(3)
}

/// A story whose clocks run wrong by so much at most.
fn drifting(drift_ppm: f64) -> Story {
    let mut story = story();
    story.setting.clock_drift = drift_ppm * 1e-6;
    story
}

#[test]
fn two_that_hold_the_same_are_reported() {
    let mut story = story();
    story
        .locks(1000, 0, "enter", "a")
        .locks(1000, 0, "enter", "b");
    story
        .locks(2000, 1, "enter", "b")
        .locks(3000, 1, "release", "b");
    let verdict = story.verdict(5000);
    assert_only(&verdict, SAFETY, 2000, &[1, 0]);
    assert_eq!(verdict[0].text, "robot 1 holds b while robot 0 does");
}

#[test]
fn one_after_the_other_is_as_it_should_be() {
    let mut story = story();
    story
        .locks(1000, 0, "enter", "a")
        .locks(1000, 0, "enter", "b");
    story
        .locks(2000, 0, "release", "b")
        .locks(2000, 1, "enter", "b");
    story
        .locks(3000, 0, "expire", "a")
        .locks(3100, 2, "enter", "a");
    assert_none(&story.verdict(5000));
}

#[test]
fn a_crash_ends_the_holds_of_a_robot() {
    let mut story = story();
    story
        .locks(1000, 0, "enter", "a")
        .fault(2000, Some(0), "crash");
    story.locks(3000, 1, "enter", "a");
    assert_none(&story.verdict(5000));
}

#[test]
fn after_a_corruption_of_state_it_is_judged_again_later() {
    let mut story = story();
    story.setting.properties.mutex_bound = seconds(5);
    story.setting.properties.mutex_alone_bound = seconds(5);
    story
        .locks(1000, 0, "enter", "a")
        .fault(2000, Some(2), "corrupt state");
    story
        .locks(3000, 1, "enter", "a")
        .locks(8000, 1, "release", "a");
    story
        .locks(8000, 0, "release", "a")
        .locks(8500, 0, "enter", "a");
    assert_none(&story.verdict(9000));
    story.locks(9000, 1, "enter", "a");
    assert_only(&story.verdict(10_000), SAFETY, 9000, &[1, 0]);
}

#[test]
fn a_corruption_recorded_in_the_same_step_excuses() {
    let mut story = story();
    story
        .locks(1000, 0, "enter", "a")
        .locks(2000, 1, "enter", "a");
    story.fault(2020, Some(1), "corrupt state");
    assert_none(&story.verdict(5000));
}

#[test]
fn leases_are_judged_where_clocks_keep_the_bound() {
    for (drift_ppm, is_judged) in [(9000.0, true), (11_000.0, false)] {
        let mut story = drifting(drift_ppm);
        story.leases(1000, 0, "a", 5).leases(2000, 1, "a", 6);
        let verdict = story.verdict(5000);
        if is_judged {
            assert_only(&verdict, SAFETY, 2000, &[1, 0]);
        } else {
            assert_none(&verdict);
        }
    }
}

#[test]
fn numbers_that_do_not_grow_are_reported() {
    for number in [4, 5] {
        let mut story = drifting(50.0);
        story.leases(1000, 0, "a", 5).leases(1500, 0, "b", 7);
        story
            .locks(1800, 0, "release", "a")
            .leases(2000, 1, "a", number);
        assert_only(&story.verdict(5000), FENCING, 2000, &[1, 0]);
    }
}

#[test]
fn with_wrong_clocks_numbers_may_be_late_but_are_unique() {
    let mut story = drifting(1e6);
    story.leases(1000, 0, "a", 5).leases(2000, 1, "a", 4);
    assert_none(&story.verdict(5000));
    story.leases(3000, 2, "a", 5);
    assert_only(&story.verdict(5000), FENCING, 3000, &[2, 0]);
}
