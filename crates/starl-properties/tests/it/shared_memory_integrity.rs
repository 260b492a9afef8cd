//! No robot shows a value in a shared memory that was never written.

use crate::support::{Story, assert_none, assert_only};

/// Robot 0 writes 5 to `x` at 1 s.
fn one_write() -> Story {
    let mut story = Story::of_ground_robots(3);
    story.shows(1000, 0, "write", "x", (1000, 0, 5));
    story
}

#[test]
fn written_values_may_be_shown() {
    let mut story = one_write();
    story.shows(1030, 1, "update", "x", (1000, 0, 5));
    story.shows(9000, 2, "update", "x", (1000, 0, 5));
    story.shows(9000, 0, "write_again", "x", (9000, 0, 5));
    story.shows(9030, 2, "update", "x", (9000, 0, 5));
    assert_none(&story.verdict(10_000));
}

#[test]
fn another_value_time_writer_or_variable_may_not() {
    for (variable, forged) in [
        ("x", (1000, 0, 6)),
        ("x", (1001, 0, 5)),
        ("x", (1000, 2, 5)),
        ("y", (1000, 0, 5)),
        ("x[]", (1000, 0, 5)),
    ] {
        let mut story = one_write();
        story.shows(1030, 1, "update", variable, forged);
        let verdict = story.verdict(10_000);
        assert_only(&verdict, "shared_memory.integrity", 1030, &[1, forged.1]);
    }
}

#[test]
fn the_violation_names_the_observation() {
    let mut story = one_write();
    story.shows(1030, 1, "update", "pos[]", (1000, 2, 6));
    let verdict = story.verdict(10_000);
    assert_eq!(
        verdict[0].text,
        "robot 1 shows a value in pos[2] that robot 2 did not write"
    );
}

#[test]
fn it_is_reported_once() {
    let mut story = one_write();
    story.shows(1030, 1, "update", "x", (2000, 0, 6));
    story.shows(1060, 2, "update", "x", (2000, 0, 6));
    let verdict = story.verdict(10_000);
    assert_only(&verdict, "shared_memory.integrity", 1030, &[1, 0]);
}

#[test]
fn a_write_is_not_known_before_it_happens() {
    let mut story = one_write();
    story.shows(1030, 1, "update", "x", (2000, 0, 6));
    story.shows(2000, 0, "write", "x", (2000, 0, 6));
    let verdict = story.verdict(10_000);
    assert_only(&verdict, "shared_memory.integrity", 1030, &[1, 0]);
}

#[test]
fn two_values_with_one_stamp_are_reported() {
    let mut story = one_write();
    story.shows(1030, 1, "update", "x", (1000, 0, 5));
    story.shows(1060, 0, "write", "x", (1000, 0, 6));
    let verdict = story.verdict(10_000);
    assert_only(&verdict, "shared_memory.integrity", 1060, &[0, 0]);
    assert_eq!(
        verdict[0].text,
        "robot 0 gave two values in x one stamp: what robot 0 wrote at 1.000s by its clock (count 0)"
    );
}

#[test]
fn memories_that_were_corrupted_may_show_anything() {
    let mut story = one_write();
    story.fault(1010, Some(2), "corrupt state");
    story.shows(1030, 1, "update", "x", (2000, 7, 6));
    assert_none(&story.verdict(10_000));
}

#[test]
fn other_faults_excuse_nothing() {
    for fault in ["crash", "restart", "stuck motor", "partition"] {
        let mut story = one_write();
        story.fault(1010, Some(2), fault);
        story.shows(1030, 1, "update", "x", (2000, 0, 6));
        let verdict = story.verdict(10_000);
        assert_only(&verdict, "shared_memory.integrity", 1030, &[1, 0]);
    }
}

/// Everyone has long shown later writes, so a datagram that was under way all the time is not a forgery; what
/// is forgotten counts as written.
#[test]
fn old_writes_need_not_be_remembered() {
    let story = |value| {
        let mut story = Story::of_ground_robots(2);
        for second in 1..100 {
            let write = (second * 1000, 0, second as i64);
            story.shows(second * 1000, 0, "write", "x", write);
            story.shows(second * 1000 + 30, 1, "update", "x", write);
        }
        story.fault(99_500, Some(1), "crash");
        story.fault(99_600, Some(1), "restart");
        story.shares(99_700, 1);
        story.shows(99_800, 1, "update", "x", (2000, 0, value));
        story.shows(99_900, 1, "update", "x", (99_000, 0, 99));
        story
    };
    assert_none(&story(2).verdict(200_000));
    assert_none(&story(77).verdict(200_000));
}

#[test]
fn they_are_remembered_while_one_robot_shows_earlier_ones() {
    let mut story = one_write();
    story.shares(0, 1);
    story.shares(0, 2);
    story.shows(1030, 2, "update", "x", (1000, 0, 5));
    story.fault(1100, None, "partition");
    story.sends(1200, 0, 0, 1);
    story.shows(3000, 0, "write", "x", (3000, 0, 6));
    story.shows(3030, 1, "update", "x", (3000, 0, 6));
    story.shows(90_000, 2, "update", "x", (2000, 0, 7));
    let verdict = story.verdict(100_000);
    assert_only(&verdict, "shared_memory.integrity", 90_000, &[2, 0]);
}
