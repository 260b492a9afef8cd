//! An epoch has one leader, epochs grow, no two robots lead at once, and a leader has stood for election.

use crate::support::{Story, assert_none, assert_only};
use starl_core::{RobotId, Value};

fn ids(robots: &[u32]) -> Value {
    let ids: Vec<RobotId> = robots.iter().copied().map(RobotId).collect();
    ids.into()
}

/// Three robots take part and stand.
fn three() -> Story {
    let mut story = Story::of_ground_robots(4);
    for robot in 0..3 {
        begins(&mut story, 0, robot);
    }
    story
}

fn begins(story: &mut Story, millis: u64, robot: u32) {
    let fields = [
        ("algorithm", "leases".into()),
        ("participants", ids(&[0, 1, 2])),
    ];
    story.report(millis, robot, ("election", "start"), fields);
    story.report(millis, robot, ("election", "elect"), []);
    story.report(
        millis + 1,
        robot,
        ("election", "vote"),
        [("anew", false.into())],
    );
}

fn shows(story: &mut Story, millis: u64, robot: u32, leader: u32, epoch: i64) {
    let fields = [
        ("leader", RobotId(leader).into()),
        ("epoch", Value::Int(epoch)),
    ];
    story.report(millis, robot, ("election", "leader"), fields);
}

fn loses(story: &mut Story, millis: u64, robot: u32) {
    story.report(millis, robot, ("election", "lost"), []);
}

/// Robot 1 leads in epoch 5, and robot 2 then in epoch 7.
fn two_leaders() -> Story {
    let mut story = three();
    shows(&mut story, 1000, 1, 1, 5);
    shows(&mut story, 1010, 0, 1, 5);
    loses(&mut story, 2000, 1);
    shows(&mut story, 2000, 2, 2, 7);
    shows(&mut story, 2010, 0, 2, 7);
    shows(&mut story, 2010, 1, 2, 7);
    story
}

#[test]
fn one_leader_after_the_other_is_right() {
    assert_none(&two_leaders().verdict(10_000));
}

#[test]
fn an_epoch_with_two_leaders_is_reported() {
    let mut story = three();
    shows(&mut story, 1000, 1, 1, 5);
    loses(&mut story, 2000, 1);
    shows(&mut story, 2100, 0, 2, 5);
    let verdict = story.verdict(10_000);
    assert_only(&verdict, "election.uniqueness", 2100, &[1, 2]);
    assert_eq!(verdict[0].text, "epoch 5 has two leaders, robots 1 and 2");
}

/// Faults excuse nothing: the number of an epoch is all that protects what leaders do.
#[test]
fn an_epoch_with_two_leaders_is_reported_after_a_crash_of_all_and_a_corruption() {
    let mut story = three();
    shows(&mut story, 1000, 1, 1, 5);
    for robot in 0..3 {
        story.fault(2000, Some(robot), "crash");
        story.fault(3000, Some(robot), "restart");
        begins(&mut story, 3000, robot);
    }
    story.fault(3500, Some(0), "corrupt state");
    shows(&mut story, 4000, 2, 2, 5);
    let verdict = story.verdict(10_000);
    assert_only(&verdict, "election.uniqueness", 4000, &[1, 2]);
}

#[test]
fn an_epoch_that_is_led_twice_is_reported() {
    let mut story = three();
    shows(&mut story, 1000, 1, 1, 5);
    for robot in 0..2 {
        story.fault(2000, Some(robot), "crash");
        begins(&mut story, 3000, robot);
    }
    shows(&mut story, 4000, 1, 1, 5);
    let verdict = story.verdict(10_000);
    assert_only(&verdict, "election.uniqueness", 4000, &[1]);
}

#[test]
fn an_epoch_before_the_last_is_reported() {
    let mut story = two_leaders();
    loses(&mut story, 3000, 2);
    shows(&mut story, 3010, 0, 0, 6);
    let verdict = story.verdict(10_000);
    assert_only(&verdict, "election.order", 3010, &[0, 2]);
    assert_eq!(
        verdict[0].text,
        "robot 0 leads in epoch 6 after robot 2 did in epoch 7"
    );
}

#[test]
fn lost_memory_of_a_majority_is_an_excuse_and_of_a_minority_is_not() {
    for (crashed, is_excused) in [(&[2][..], false), (&[1, 2], true)] {
        let mut story = two_leaders();
        for &robot in crashed {
            story.fault(3000, Some(robot), "crash");
        }
        for &robot in crashed {
            story.fault(4000, Some(robot), "restart");
            begins(&mut story, 4000, robot);
        }
        shows(&mut story, 8000, 0, 0, 6);
        let verdict = story.verdict(10_000);
        match is_excused {
            true => assert_none(&verdict),
            false => assert_only(&verdict, "election.order", 8000, &[0, 2]),
        }
    }
}

#[test]
fn two_leaders_at_once_are_reported() {
    let mut story = three();
    shows(&mut story, 1000, 1, 1, 5);
    shows(&mut story, 2000, 2, 2, 7);
    loses(&mut story, 2500, 1);
    let verdict = story.verdict(10_000);
    assert_only(&verdict, "election.exclusion", 2000, &[1, 2]);
}

#[test]
fn a_crashed_leader_no_longer_leads() {
    let mut story = three();
    shows(&mut story, 1000, 1, 1, 5);
    story.fault(1500, Some(1), "crash");
    shows(&mut story, 2000, 2, 2, 7);
    assert_none(&story.verdict(10_000));
}

#[test]
fn a_leader_that_did_not_stand_is_reported() {
    for word in ["resign", "crash"] {
        let mut story = three();
        match word {
            "resign" => story.report(500, 1, ("election", "resign"), []),
            _ => story.fault(500, Some(1), "crash"),
        };
        shows(&mut story, 1000, 1, 1, 5);
        let verdict = story.verdict(10_000);
        assert_only(&verdict, "election.soundness", 1000, &[1]);
    }
}

#[test]
fn a_leader_that_takes_no_part_is_reported() {
    let mut story = three();
    shows(&mut story, 1000, 1, 3, 5);
    let verdict = story.verdict(10_000);
    assert_only(&verdict, "election.soundness", 1000, &[3, 1]);
}

fn believes(story: &mut Story, millis: u64, robot: u32, leader: u32, drawn: (i64, i64)) {
    let fields = [
        ("leader", RobotId(leader).into()),
        ("round", Value::Int(drawn.0)),
        ("ballot", Value::Int(drawn.1)),
    ];
    story.report(millis, robot, ("election", "leader"), fields);
}

#[test]
fn of_two_outcomes_of_ballots_the_greater_is_believed() {
    let mut story = three();
    believes(&mut story, 1000, 0, 1, (3, 50));
    believes(&mut story, 1010, 0, 2, (3, 60));
    believes(&mut story, 1020, 0, 1, (4, 10));
    assert_none(&story.verdict(10_000));
}

#[test]
fn a_lesser_outcome_of_ballots_is_not_believed() {
    let mut story = three();
    believes(&mut story, 1000, 0, 1, (3, 60));
    believes(&mut story, 1010, 0, 2, (3, 50));
    let verdict = story.verdict(10_000);
    assert_only(&verdict, "election.order", 1010, &[2, 1]);
}

#[test]
fn an_outcome_after_none_may_be_lesser() {
    let mut story = three();
    believes(&mut story, 1000, 0, 1, (3, 60));
    loses(&mut story, 1005, 0);
    believes(&mut story, 1010, 0, 2, (3, 50));
    assert_none(&story.verdict(10_000));
}

#[test]
fn only_leases_promise_one_leader_at_a_time() {
    for (algorithm, promised) in [
        (
            "leases",
            vec![
                "election.uniqueness",
                "election.order",
                "election.exclusion",
            ],
        ),
        ("ballots", vec!["election.order"]),
        ("bully", vec![]),
    ] {
        let mut story = Story::of_ground_robots(2);
        let fields = [
            ("algorithm", algorithm.into()),
            ("participants", ids(&[0, 1])),
        ];
        story.report(0, 0, ("election", "start"), fields);
        let mut applying = story.applying(1000);
        applying.retain(|property| {
            let rest = ["soundness", "agreement", "progress"];
            property.starts_with("election") && !rest.iter().any(|name| property.ends_with(name))
        });
        assert_eq!(applying, promised, "{algorithm}");
    }
}
