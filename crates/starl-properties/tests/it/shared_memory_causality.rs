//! No robot shows a write of a causal variable without those that its writer showed.

use crate::support::{Story, assert_none, assert_only};
use starl_core::Value;

/// Robot 0 writes `y`, then `x`.
fn two_writes() -> Story {
    let mut story = Story::of_ground_robots(3);
    for robot in 0..3 {
        for variable in ["x", "y"] {
            let variable = ("variable", Value::Text(variable.into()));
            story.report(100, robot, ("shared_memory", "causal"), [variable]);
        }
    }
    story.shows(1000, 0, "write", "y", (1000, 0, 5));
    story.shows(2000, 0, "write", "x", (2000, 0, 6));
    story
}

#[test]
fn the_first_may_be_shown_before_the_second() {
    let mut story = two_writes();
    story.shows(3000, 1, "update", "y", (1000, 0, 5));
    story.shows(3100, 1, "update", "x", (2000, 0, 6));
    story.shows(3100, 2, "update", "y", (1000, 0, 5));
    story.shows(3100, 2, "update", "x", (2000, 0, 6));
    assert_none(&story.verdict(10_000));
}

#[test]
fn the_second_may_not_be_shown_without_the_first() {
    let mut story = two_writes();
    story.shows(3000, 1, "update", "x", (2000, 0, 6));
    story.shows(3100, 1, "update", "y", (1000, 0, 5));
    let verdict = story.verdict(10_000);
    assert_only(&verdict, "shared_memory.causality", 3000, &[1, 0]);
    assert_eq!(
        verdict[0].text,
        "robot 1 shows what robot 0 wrote to x and not what robot 0 had written to y before"
    );
}

#[test]
fn a_later_write_satisfies_the_dependency() {
    let mut story = two_writes();
    story.shows(2500, 2, "write", "y", (2500, 2, 7));
    story.shows(3000, 1, "update", "y", (2500, 2, 7));
    story.shows(3100, 1, "update", "x", (2000, 0, 6));
    assert_none(&story.verdict(10_000));
}

#[test]
fn dependencies_are_transitive_over_overwritten_values() {
    let mut story = two_writes();
    let z = ("variable", Value::Text("z".into()));
    story.report(100, 0, ("shared_memory", "causal"), [z]);
    story.shows(2500, 0, "write", "z", (2500, 0, 8));
    // Robot 2 has overwritten x without knowing of y.
    story.shows(2600, 2, "write", "x", (2600, 2, 9));
    story.shows(3000, 1, "update", "x", (2600, 2, 9));
    story.shows(3100, 1, "update", "z", (2500, 0, 8));
    let verdict = story.verdict(10_000);
    assert_only(&verdict, "shared_memory.causality", 3100, &[1, 0]);
}

#[test]
fn a_restarted_robot_shows_nothing() {
    let mut story = two_writes();
    story.shows(3000, 1, "update", "y", (1000, 0, 5));
    story
        .fault(3500, Some(1), "crash")
        .fault(4000, Some(1), "restart");
    story.shows(5000, 1, "update", "x", (2000, 0, 6));
    let verdict = story.verdict(10_000);
    assert_only(&verdict, "shared_memory.causality", 5000, &[1, 0]);
}

#[test]
fn a_corruption_excuses_also_a_moment_before() {
    let mut story = two_writes();
    story.shows(3000, 1, "update", "x", (2000, 0, 6));
    story.fault(3010, Some(1), "corrupt state");
    assert_none(&story.verdict(10_000));
}

#[test]
fn other_variables_are_not_judged() {
    let mut story = Story::of_ground_robots(2);
    story.shows(1000, 0, "write", "y", (1000, 0, 5));
    story.shows(2000, 0, "write", "x", (2000, 0, 6));
    story.shows(3000, 1, "update", "x", (2000, 0, 6));
    assert_none(&story.verdict(10_000));
}
