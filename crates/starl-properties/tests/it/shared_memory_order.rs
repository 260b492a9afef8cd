//! The value of a shared variable that a robot shows never goes back to an earlier write while it
//! is up.

use crate::support::{Story, assert_none, assert_only};

/// Robots 0 and 2 write to `x`; robot 1 shows the later one at 2.03 s.
fn two_writes() -> Story {
    let mut story = Story::of_ground_robots(3);
    story.shows(1000, 0, "write", "x", (1000, 0, 5));
    story.shows(1030, 2, "update", "x", (1000, 0, 5));
    story.shows(2000, 2, "write", "x", (2000, 2, 6));
    story.shows(2030, 0, "update", "x", (2000, 2, 6));
    story.shows(2030, 1, "update", "x", (2000, 2, 6));
    story
}

#[test]
fn later_writes_are_correct() {
    assert_none(&two_writes().verdict(10_000));
}

#[test]
fn going_back_is_reported() {
    let mut story = two_writes();
    story.shows(2500, 1, "update", "x", (1000, 0, 5));
    let verdict = story.verdict(10_000);
    assert_only(&verdict, "shared_memory.order", 2500, &[1]);
    assert_eq!(
        verdict[0].text,
        "robot 1 went back in x from what robot 2 wrote at 2.000s by its clock (count 0) to what robot 0 \
         wrote at 1.000s by its clock (count 0)"
    );
}

/// A robot whose clock is behind knows of a write, and writes without regard to it.
#[test]
fn a_write_earlier_than_the_writers_value_is_reported() {
    let mut story = two_writes();
    story.shows(3000, 1, "write", "x", (1500, 1, 7));
    assert_only(&story.verdict(10_000), "shared_memory.order", 3000, &[1]);
}

#[test]
fn of_writes_at_one_time_that_of_the_greater_number_is_the_later() {
    for (first, then, is_violated) in [(0, 2, false), (2, 0, true)] {
        let mut story = Story::of_ground_robots(3);
        story.shows(1000, 0, "write", "x", (1000, 0, 5));
        story.shows(1000, 2, "write", "x", (1000, 2, 6));
        story.shows(
            1030,
            1,
            "update",
            "x",
            (1000, first, if first == 0 { 5 } else { 6 }),
        );
        story.shows(
            1040,
            1,
            "update",
            "x",
            (1000, then, if then == 0 { 5 } else { 6 }),
        );
        assert_eq!(!story.verdict(10_000).is_empty(), is_violated);
    }
}

#[test]
fn variables_and_elements_are_judged_separately() {
    let mut story = two_writes();
    story.shows(500, 0, "write", "y", (500, 0, 1));
    story.shows(600, 0, "write", "x[]", (600, 0, 1));
    story.shows(700, 2, "write", "x[]", (700, 2, 1));
    story.shows(2500, 1, "update", "y", (500, 0, 1));
    story.shows(2500, 1, "update", "x[]", (700, 2, 1));
    story.shows(2500, 1, "update", "x[]", (600, 0, 1));
    assert_none(&story.verdict(10_000));
}

#[test]
fn a_restarted_robot_starts_from_the_beginning() {
    let mut story = two_writes();
    story.fault(2100, Some(1), "crash");
    story.fault(2200, Some(1), "restart");
    story.shows(2500, 1, "update", "x", (1000, 0, 5));
    assert_none(&story.verdict(10_000));
}

#[test]
fn only_a_corrupted_memory_restarts() {
    for (corrupted, is_violated) in [(1, false), (2, true)] {
        let mut story = two_writes();
        story.fault(2100, Some(corrupted), "corrupt state");
        story.shows(2500, 1, "update", "x", (1000, 0, 5));
        assert_eq!(!story.verdict(10_000).is_empty(), is_violated);
    }
}

/// A fault takes effect at the beginning of the step in which it is recorded.
#[test]
fn a_fault_that_is_recorded_a_little_later_excuses_too() {
    for (fault, at, is_violated) in [
        ("corrupt state", 2510, false),
        ("crash", 2510, false),
        ("corrupt state", 2600, true),
        ("stuck motor", 2510, true),
    ] {
        let mut story = two_writes();
        story.shows(2500, 1, "update", "x", (1000, 0, 5));
        story.fault(at, Some(1), fault);
        assert_eq!(!story.verdict(10_000).is_empty(), is_violated, "{fault}");
    }
    let mut other = two_writes();
    other.shows(2500, 1, "update", "x", (1000, 0, 5));
    other.fault(2510, Some(2), "corrupt state");
    assert_only(&other.verdict(10_000), "shared_memory.order", 2500, &[1]);
}
