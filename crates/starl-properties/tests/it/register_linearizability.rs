//! Operations on a register take effect one after the other, each between its begin and its end.

use crate::support::{Story, assert_none, assert_only};
use starl_core::Value;

/// An operation of a robot: when it begins and ends, and what it writes or reads, 0 for nothing.
fn operation(
    story: &mut Story,
    robot: u32,
    kind: &'static str,
    register: &'static str,
    (begin, end): (u64, Option<u64>),
    value: i64,
) {
    let number = ("operation", Value::Int(begin as i64));
    let name = ("register", Value::Text(register.into()));
    let fields = [number.clone(), name.clone()];
    match kind {
        "write" => {
            let value = ("value", Value::Int(value));
            let fields = [number.clone(), name.clone(), value];
            story.report(begin, robot, ("register", kind), fields);
        }
        _ => drop(story.report(begin, robot, ("register", kind), fields.clone())),
    }
    let Some(end) = end else { return };
    if value == 0 {
        story.report(end, robot, ("register", "done"), fields);
    } else {
        let fields = [number, name, ("value", Value::Int(value))];
        story.report(end, robot, ("register", "done"), fields);
    }
}

fn story(operations: &[(u32, &'static str, u64, u64, i64)]) -> Story {
    let mut story = Story::of_ground_robots(3);
    for &(robot, kind, begin, end, value) in operations {
        let end = (end > 0).then_some(end);
        operation(&mut story, robot, kind, "x", (begin, end), value);
    }
    story
}

#[test]
fn sequential_reads_return_the_last_write() {
    let good = story(&[
        (0, "read", 100, 200, 0),
        (0, "write", 300, 400, 5),
        (1, "read", 500, 600, 5),
        (1, "write", 700, 800, 6),
        (2, "read", 900, 1000, 6),
    ]);
    assert_none(&good.verdict(2000));
}

#[test]
fn overwritten_values_cannot_be_read() {
    let bad = story(&[
        (0, "write", 300, 400, 5),
        (1, "write", 700, 800, 6),
        (2, "read", 900, 1000, 5),
    ]);
    assert_only(&bad.verdict(2000), "register.linearizability", 1000, &[2]);
    let bad = story(&[(0, "write", 300, 400, 5), (2, "read", 900, 1000, 0)]);
    assert_only(&bad.verdict(2000), "register.linearizability", 1000, &[2]);
}

#[test]
fn unwritten_values_cannot_be_read() {
    let bad = story(&[(0, "write", 300, 400, 5), (2, "read", 350, 1000, 7)]);
    assert_only(&bad.verdict(2000), "register.linearizability", 1000, &[2]);
}

#[test]
fn operations_at_the_same_time_may_take_effect_in_any_order() {
    for first in [5, 6] {
        let good = story(&[
            (0, "write", 300, 600, 5),
            (1, "write", 310, 610, 6),
            (2, "read", 700, 800, first),
            (2, "read", 900, 1000, first),
        ]);
        assert_none(&good.verdict(2000));
    }
}

#[test]
fn a_later_read_does_not_return_the_earlier_value() {
    // The write is still under way: either value may be read, but not the new one and then the old.
    let write = (0, "write", 300, 5000, 5);
    let good = story(&[write, (1, "read", 400, 500, 0), (2, "read", 600, 700, 5)]);
    assert_none(&good.verdict(6000));
    let bad = story(&[write, (1, "read", 400, 500, 5), (2, "read", 600, 700, 0)]);
    assert_only(&bad.verdict(6000), "register.linearizability", 700, &[2]);
}

#[test]
fn a_write_during_a_crash_may_take_effect_later_once() {
    let crash = |mut story: Story| {
        story.fault(500, Some(0), "crash");
        story
    };
    let write = (0, "write", 300, 0, 5);
    let good = story(&[write, (1, "read", 600, 700, 0), (2, "read", 4000, 4100, 5)]);
    assert_none(&crash(good).verdict(6000));
    let bad = story(&[
        write,
        (1, "read", 600, 700, 5),
        (1, "write", 800, 900, 6),
        (2, "read", 4000, 4100, 5),
    ]);
    assert_only(
        &crash(bad).verdict(6000),
        "register.linearizability",
        4100,
        &[2],
    );
}

#[test]
fn registers_are_judged_each_for_itself() {
    let mut story = story(&[(0, "write", 300, 400, 5)]);
    operation(&mut story, 1, "read", "y", (500, Some(600)), 0);
    operation(&mut story, 1, "read", "y", (700, Some(800)), 5);
    assert_only(&story.verdict(2000), "register.linearizability", 800, &[1]);
}

#[test]
fn a_forgetful_majority_and_a_corruption_are_excused() {
    let bad = || story(&[(0, "write", 300, 400, 5), (1, "read", 4000, 4100, 0)]);
    let mut lost = bad();
    for robot in 0..3 {
        lost.report(100, robot, ("register", "up"), [("life", Value::Int(1))]);
    }
    let mut one = lost.clone();
    one.fault(500, Some(0), "crash");
    assert_only(&one.verdict(5000), "register.linearizability", 4100, &[1]);
    lost.fault(500, Some(0), "crash")
        .fault(600, Some(1), "crash");
    assert_none(&lost.verdict(5000));
    let mut corrupted = bad();
    corrupted.fault(500, Some(2), "corrupt state");
    assert_none(&corrupted.verdict(5000));
}

/// One robot of three that crashes before the others have started is no majority.
#[test]
fn a_crash_before_the_fleet_has_started_is_no_excuse() {
    let mut bad = story(&[(1, "write", 300, 400, 5), (2, "read", 500, 600, 0)]);
    for (at, robot, life) in [(50, 0, 1), (200, 0, 2), (200, 1, 1), (200, 2, 1)] {
        bad.report(at, robot, ("register", "up"), [("life", Value::Int(life))]);
    }
    bad.fault(100, Some(0), "crash");
    bad.fault(150, Some(0), "restart");
    assert_only(&bad.verdict(2000), "register.linearizability", 600, &[2]);
}

#[test]
fn stored_values_are_not_forgotten_until_storage_is_lost() {
    let mut kept = story(&[(0, "write", 300, 400, 5), (1, "read", 4000, 4100, 0)]);
    kept.setting.keeps_storage = true;
    for robot in 0..3 {
        kept.report(100, robot, ("register", "up"), [("life", Value::Int(1))]);
        kept.fault(500, Some(robot), "crash");
    }
    assert_only(&kept.verdict(5000), "register.linearizability", 4100, &[1]);
    let mut one = kept.clone();
    one.fault(500, Some(0), "storage lost");
    assert_only(&one.verdict(5000), "register.linearizability", 4100, &[1]);
    one.fault(500, Some(1), "storage lost");
    assert_none(&one.verdict(5000));
}

#[test]
fn it_can_be_switched_off() {
    let mut story = story(&[(0, "write", 300, 400, 5), (1, "read", 4000, 4100, 0)]);
    story.setting.properties.register = false;
    assert_none(&story.verdict(5000));
}

/// A majority forgets all at 500 ms, and one of the two is up again at 2 s; then there are these operations.
fn after_a_majority_forgot(operations: &[(u32, &'static str, u64, u64, i64)]) -> Story {
    let mut story = story(operations);
    operation(&mut story, 0, "write", "x", (300, Some(400)), 5);
    for robot in 0..3 {
        story.report(100, robot, ("register", "up"), [("life", Value::Int(1))]);
    }
    for robot in [0, 1] {
        story.fault(500, Some(robot), "crash");
    }
    story.fault(1000, Some(0), "restart");
    story.report(2000, 0, ("register", "up"), [("life", Value::Int(2))]);
    story
}

#[test]
fn it_is_judged_again_when_a_majority_is_back() {
    // A write of a lost majority may exist or not, and its later state stays.
    for found in [0, 5] {
        let reads = [(2, "read", 40_000, 40_100, found)];
        assert_none(&after_a_majority_forgot(&reads).verdict(60_000));
        let wrong = [reads[0], (0, "read", 41_000, 41_100, 5 - found)];
        assert_only(
            &after_a_majority_forgot(&wrong).verdict(60_000),
            "register.linearizability",
            41_100,
            &[0],
        );
    }
    let lost = [
        (2, "write", 40_000, 40_100, 7),
        (0, "read", 41_000, 41_100, 5),
    ];
    assert_only(
        &after_a_majority_forgot(&lost).verdict(60_000),
        "register.linearizability",
        41_100,
        &[0],
    );
}

#[test]
fn it_is_not_judged_while_lost_values_may_reappear() {
    let wrong = [
        (2, "write", 40_000, 40_100, 7),
        (0, "read", 41_000, 41_100, 5),
    ];
    let story = || after_a_majority_forgot(&wrong);
    // So far nothing is excused.
    assert_eq!(story().verdict(60_000).len(), 1);
    // No majority, one that came back shortly before, and a network in parts.
    assert_none(&story().fault(30_000, Some(2), "crash").verdict(60_000));
    let mut late = story();
    late.fault(10_000, Some(1), "restart");
    late.report(11_000, 1, ("register", "up"), [("life", Value::Int(2))]);
    assert_none(&late.verdict(60_000));
    assert_none(&story().fault(3000, None, "partition").verdict(60_000));
    // Early operations say nothing of what the register holds.
    let early = [
        (2, "write", 10_000, 10_100, 7),
        (0, "read", 41_000, 41_100, 5),
    ];
    assert_none(&after_a_majority_forgot(&early).verdict(60_000));
}

#[test]
fn concurrent_operations_do_not_define_the_value_of_a_register() {
    let crowded = [
        (2, "write", 40_000, 40_300, 7),
        (0, "write", 40_100, 40_200, 8),
        (2, "read", 41_000, 41_100, 8),
        (0, "read", 42_000, 42_100, 8),
    ];
    assert_none(&after_a_majority_forgot(&crowded).verdict(60_000));
    let mut wrong = crowded;
    wrong[3].4 = 7;
    assert_only(
        &after_a_majority_forgot(&wrong).verdict(60_000),
        "register.linearizability",
        42_100,
        &[0],
    );
    // One that was given up may take effect later.
    let mut abandoned = after_a_majority_forgot(&[
        (0, "write", 40_000, 0, 9),
        (2, "write", 41_000, 41_100, 7),
        (2, "read", 42_000, 42_100, 9),
    ]);
    let name = ("register", Value::Text("x".into()));
    let fields = [("operation", Value::Int(40_000)), name];
    abandoned.report(40_500, 0, ("register", "withdraw"), fields);
    assert_none(&abandoned.verdict(60_000));
}
