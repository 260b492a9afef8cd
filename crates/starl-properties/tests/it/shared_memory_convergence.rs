//! Every connected robot with a shared memory shows the latest write within the bound.

use crate::support::{Story, assert_none, assert_only, seconds};
use starl_core::Event;

const PROPERTY: &str = "shared_memory.convergence";

/// Three robots share a memory, with a bound of 5 s. Robot 0 writes to `x` at 1 s, robot 1 shows it.
fn robot_2_shows_nothing() -> Story {
    let mut story = Story::of_ground_robots(4);
    story.setting.properties.shared_memory_bound = seconds(5);
    for robot in 0..3 {
        story.shares(0, robot);
    }
    story.shows(1000, 0, "write", "x", (1000, 0, 5));
    story.shows(1030, 1, "update", "x", (1000, 0, 5));
    story
}

#[test]
fn a_robot_that_misses_a_write_is_reported_once() {
    let verdict = robot_2_shows_nothing().verdict(60_000);
    assert_only(&verdict, PROPERTY, 6000, &[0, 2]);
    assert_eq!(
        verdict[0].text,
        "robot 2 did not show what robot 0 wrote to x at 1.000s within 5s"
    );
}

#[test]
fn all_robots_that_miss_a_write_are_named_together() {
    let mut story = Story::of_ground_robots(4);
    story.setting.properties.shared_memory_bound = seconds(5);
    for robot in 0..3 {
        story.shares(0, robot);
    }
    story.shows(1000, 0, "write", "x[]", (1000, 0, 5));
    let verdict = story.verdict(60_000);
    assert_only(&verdict, PROPERTY, 6000, &[0, 1, 2]);
    assert!(verdict[0].text.starts_with("robots 1 and 2 did not"));
    assert!(verdict[0].text.contains("x[0]"));
}

#[test]
fn the_last_moment_is_in_time_and_the_next_is_not() {
    let mut story = robot_2_shows_nothing();
    story.shows(6000, 2, "update", "x", (1000, 0, 5));
    assert_none(&story.verdict(60_000));
    let mut late = robot_2_shows_nothing();
    late.shows(6001, 2, "update", "x", (1000, 0, 5));
    assert_only(&late.verdict(60_000), PROPERTY, 6000, &[0, 2]);
}

#[test]
fn a_bound_that_has_not_run_out_is_not_judged() {
    assert_none(&robot_2_shows_nothing().verdict(6000));
}

#[test]
fn a_later_write_will_do_and_an_earlier_one_will_not() {
    let mut story = robot_2_shows_nothing();
    story.shows(3000, 1, "write", "x", (3000, 1, 6));
    story.shows(3030, 0, "update", "x", (3000, 1, 6));
    story.shows(3030, 2, "update", "x", (3000, 1, 6));
    assert_none(&story.verdict(60_000));
    let mut stale = robot_2_shows_nothing();
    stale.shows(500, 0, "write", "x", (500, 0, 4));
    stale.shows(530, 1, "update", "x", (500, 0, 4));
    stale.shows(530, 2, "update", "x", (500, 0, 4));
    assert_only(&stale.verdict(60_000), PROPERTY, 6000, &[0, 2]);
}

/// Another value is not the winner just because a robot shows it later.
#[test]
fn robots_that_settle_on_different_writes_are_found_out() {
    let mut story = robot_2_shows_nothing();
    story.shows(1010, 2, "write", "x", (990, 2, 6));
    assert_only(&story.verdict(60_000), PROPERTY, 6000, &[0, 2]);
}

#[test]
fn each_write_is_judged_though_later_ones_follow() {
    let mut story = robot_2_shows_nothing();
    for second in 2..40 {
        let write = (second * 1000, 0, second as i64);
        story.shows(second * 1000, 0, "write", "x", write);
        story.shows(second * 1000 + 30, 1, "update", "x", write);
        if second >= 10 {
            story.shows(second * 1000 + 30, 2, "update", "x", write);
        }
    }
    let verdict = story.verdict(60_000);
    let at: Vec<_> = verdict
        .iter()
        .map(|violation| violation.at.0 / 1_000_000)
        .collect();
    assert_eq!(at, [6000, 7000, 8000, 9000, 10_000]);
}

#[test]
fn a_robot_that_was_down_has_the_bound_from_its_restart() {
    let down = || {
        let mut story = robot_2_shows_nothing();
        story.fault(500, Some(2), "crash");
        story.fault(20_000, Some(2), "restart");
        story
    };
    let mut in_time = down();
    in_time.shares(20_100, 2);
    in_time.shows(25_100, 2, "update", "x", (1000, 0, 5));
    assert_none(&in_time.verdict(60_000));
    let mut late = down();
    late.shares(20_100, 2);
    assert_only(&late.verdict(60_000), PROPERTY, 25_100, &[0, 2]);
    // It has no memory since then.
    assert_none(&down().verdict(60_000));
}

#[test]
fn a_robot_that_loses_a_write_must_show_it_again() {
    let mut story = robot_2_shows_nothing();
    story.shows(1030, 2, "update", "x", (1000, 0, 5));
    story.fault(20_000, Some(2), "crash");
    story.fault(21_000, Some(2), "restart");
    story.shares(21_000, 2);
    assert_only(&story.verdict(60_000), PROPERTY, 26_000, &[0, 2]);
}

#[test]
fn a_late_joiner_must_get_all_values() {
    for (joined, late) in [(30_000, 35_000), (3000, 8000)] {
        let mut story = robot_2_shows_nothing();
        story.shows(1030, 2, "update", "x", (1000, 0, 5));
        story.shares(joined, 3);
        let verdict = story.verdict(60_000);
        assert_only(&verdict, PROPERTY, late, &[0, 3]);
        assert_eq!(
            verdict[0].text,
            "robot 3 did not show what robot 0 wrote to x at 1.000s within 5s"
        );
    }
}

/// Of many writes that a robot could not get to know it is owed the latest.
#[test]
fn writes_during_a_partition_have_one_deadline() {
    let mut story = robot_2_shows_nothing();
    story.fault(900, None, "partition");
    story.sends(1000, 0, 0, 1);
    for second in 2..15 {
        let write = (second * 1000, 0, second as i64);
        story.shows(second * 1000, 0, "write", "x", write);
        story.shows(second * 1000 + 30, 1, "update", "x", write);
    }
    story.fault(20_000, None, "heal");
    let verdict = story.verdict(60_000);
    assert_only(&verdict, PROPERTY, 25_000, &[0, 2]);
    assert!(
        verdict[0].text.contains("at 14.000s"),
        "{}",
        verdict[0].text
    );
}

#[test]
fn a_lost_write_is_not_required() {
    let mut story = Story::of_ground_robots(3);
    story.setting.properties.shared_memory_bound = seconds(5);
    for robot in 0..3 {
        story.shares(0, robot);
    }
    story.shows(1000, 0, "write", "x", (1000, 0, 5));
    story.fault(1010, Some(0), "crash");
    assert_none(&story.verdict(60_000));
}

#[test]
fn one_other_robot_that_has_it_is_enough() {
    let mut story = robot_2_shows_nothing();
    story.fault(2000, Some(0), "crash");
    let verdict = story.verdict(60_000);
    assert_only(&verdict, PROPERTY, 6030, &[0, 2]);
}

#[test]
fn a_program_that_failed_owes_and_is_owed_nothing() {
    let mut story = robot_2_shows_nothing();
    story.record(2000, Some(2), Event::Failed("lost".into()));
    assert_none(&story.verdict(60_000));
    let mut holders = robot_2_shows_nothing();
    for robot in 0..2 {
        holders.record(2000, Some(robot), Event::Failed("lost".into()));
    }
    assert_none(&holders.verdict(60_000));
}

#[test]
fn faults_that_do_not_stop_a_robot_from_talking_excuse_nothing() {
    for fault in ["stuck motor", "frozen sensor"] {
        let mut story = robot_2_shows_nothing();
        story.fault(2000, Some(2), fault);
        assert_only(&story.verdict(60_000), PROPERTY, 6000, &[0, 2]);
    }
}

#[test]
fn a_robot_in_another_part_has_the_bound_from_the_healing() {
    let mut story = robot_2_shows_nothing();
    story.fault(900, None, "partition");
    story.sends(1000, 0, 0, 1);
    story.fault(20_000, None, "heal");
    assert_only(&story.verdict(60_000), PROPERTY, 25_000, &[0, 2]);
    story.shows(24_000, 2, "update", "x", (1000, 0, 5));
    assert_none(&story.verdict(60_000));
}

#[test]
fn a_partition_that_sets_in_meanwhile_excuses_too() {
    let mut story = robot_2_shows_nothing();
    story.fault(5000, None, "partition");
    story.fault(6500, None, "heal");
    assert_only(&story.verdict(60_000), PROPERTY, 11_500, &[0, 2]);
}

#[test]
fn a_partition_that_never_heals_is_never_judged_across() {
    let mut story = robot_2_shows_nothing();
    story.fault(900, None, "partition");
    story.sends(1000, 0, 0, 1);
    assert_none(&story.verdict(120_000));
}

/// Datagrams between robots 0 and 1, and 1 and 2, show that all three are in one part.
#[test]
fn robots_in_the_same_part_owe_each_other() {
    let mut story = robot_2_shows_nothing();
    story.fault(900, None, "partition");
    story.sends(1000, 0, 0, 1);
    story.sends(3000, 2, 0, 1);
    let verdict = story.verdict(60_000);
    assert_only(&verdict, PROPERTY, 6000, &[0, 2]);
}

/// Messages sent before the partition began do not show its parts.
#[test]
fn a_datagram_from_before_the_partition_joins_no_robots() {
    let mut story = robot_2_shows_nothing();
    story.sends(890, 0, 0, 2);
    story.fault(900, None, "partition");
    assert_none(&story.verdict(60_000));
}

/// Each partition has its own parts.
#[test]
fn another_partition_separates_those_that_one_joined() {
    let mut story = robot_2_shows_nothing();
    story.fault(900, None, "partition");
    story.sends(1000, 0, 0, 2);
    story.fault(3000, None, "partition");
    story.fault(20_000, None, "heal");
    assert_only(&story.verdict(60_000), PROPERTY, 25_000, &[0, 2]);
}

#[test]
fn a_partition_long_past_excuses_no_robot() {
    let mut story = robot_2_shows_nothing();
    story.fault(100, None, "partition");
    story.fault(900, None, "heal");
    assert_only(&story.verdict(60_000), PROPERTY, 6000, &[0, 2]);
}

#[test]
fn a_corrupted_memory_is_judged_after_its_next_report() {
    let mut story = robot_2_shows_nothing();
    story.fault(2000, Some(2), "corrupt state");
    story.shows(8000, 0, "write", "x", (8000, 0, 6));
    story.shows(8030, 1, "update", "x", (8000, 0, 6));
    assert_none(&story.verdict(60_000));
    story.shows(8100, 2, "update", "x", (8000, 0, 6));
    story.shows(20_000, 0, "write", "x", (20_000, 0, 7));
    story.shows(20_030, 1, "update", "x", (20_000, 0, 7));
    assert_only(&story.verdict(60_000), PROPERTY, 25_000, &[0, 2]);
}

/// Robots must agree on invented state of a corruption like on any other.
#[test]
fn garbage_that_spreads_must_reach_all() {
    let mut story = robot_2_shows_nothing();
    story.shows(1030, 2, "update", "x", (1000, 0, 5));
    story.fault(2000, Some(0), "corrupt state");
    story.shows(3000, 1, "update", "x", (90_000, 3, 77));
    assert_only(&story.verdict(60_000), PROPERTY, 8000, &[3, 2]);
}

/// A scenario in which no two partitions are a bound apart is judged too.
#[test]
fn constant_partitions_do_not_excuse_those_that_hear_each_other() {
    let mut story = robot_2_shows_nothing();
    for (count, second) in (1..30).step_by(2).enumerate() {
        story.fault(second * 1000 + 1, None, "partition");
        story.sends(second * 1000 + 100, 0, count as u32, 2);
        story.fault(second * 1000 + 900, None, "heal");
    }
    assert_only(&story.verdict(60_000), PROPERTY, 6000, &[0, 2]);
}

#[test]
fn a_partition_that_joins_those_that_one_separated_lets_the_bound_begin() {
    let mut story = robot_2_shows_nothing();
    story.fault(900, None, "partition");
    story.fault(3000, None, "partition");
    story.sends(3100, 0, 0, 2);
    assert_only(&story.verdict(60_000), PROPERTY, 8000, &[0, 2]);
}

#[test]
fn a_partition_is_remembered_when_another_one_ends() {
    let mut story = robot_2_shows_nothing();
    story.fault(900, None, "partition");
    story.fault(4000, None, "heal");
    story.fault(4100, None, "partition");
    story.sends(4110, 0, 0, 2);
    story.fault(4200, None, "heal");
    assert_only(&story.verdict(60_000), PROPERTY, 9000, &[0, 2]);
}

#[test]
fn a_datagram_after_the_healing_says_nothing_of_the_parts_before() {
    let mut story = robot_2_shows_nothing();
    story.fault(900, None, "partition");
    story.fault(4000, None, "heal");
    story.sends(4100, 0, 0, 2);
    assert_only(&story.verdict(60_000), PROPERTY, 9000, &[0, 2]);
}

#[test]
fn a_fault_after_the_bound_excuses_no_robot() {
    let mut story = robot_2_shows_nothing();
    story.fault(6010, Some(2), "crash");
    assert_only(&story.verdict(60_000), PROPERTY, 6000, &[0, 2]);
}
