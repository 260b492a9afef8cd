//! Connected robots eventually show the same leader, and a robot that stands has one, within the
//! bound.

use crate::support::{Story, assert_none, assert_only, seconds};
use starl_core::{RobotId, Value};

/// Three robots take part and stand, and are judged after 5 s.
fn three(algorithm: &'static str) -> Story {
    let mut story = Story::of_ground_robots(3);
    story.setting.properties.election_bound = seconds(5);
    for robot in 0..3 {
        begins(&mut story, 0, robot, algorithm);
    }
    story
}

fn begins(story: &mut Story, millis: u64, robot: u32, algorithm: &'static str) {
    let participants: Vec<RobotId> = (0..3).map(RobotId).collect();
    let fields = [
        ("algorithm", algorithm.into()),
        ("participants", Value::from(participants)),
    ];
    story.report(millis, robot, ("election", "start"), fields);
    story.report(millis, robot, ("election", "elect"), []);
}

fn shows(story: &mut Story, millis: u64, robot: u32, leader: u32) {
    let fields = [("leader", RobotId(leader).into())];
    story.report(millis, robot, ("election", "leader"), fields);
}

#[test]
fn robots_that_agree_in_time_are_right() {
    let mut story = three("ballots");
    shows(&mut story, 1000, 0, 0);
    shows(&mut story, 1000, 1, 1);
    shows(&mut story, 2000, 2, 1);
    shows(&mut story, 5900, 0, 1);
    assert_none(&story.verdict(30_000));
}

#[test]
fn robots_that_show_different_leaders_for_longer_are_reported() {
    let mut story = three("ballots");
    shows(&mut story, 1000, 0, 0);
    shows(&mut story, 1000, 2, 0);
    shows(&mut story, 1200, 1, 1);
    let verdict = story.verdict(30_000);
    assert_only(&verdict, "election.agreement", 6200, &[1, 0, 2]);
    assert_eq!(
        verdict[0].text,
        "robot 1 shows robot 1 as leader, robots 0 and 2 another, for 5s"
    );
}

#[test]
fn robots_in_different_parts_may_show_different_leaders_until_they_meet() {
    let mut story = three("ballots");
    story.fault(500, None, "partition");
    shows(&mut story, 1000, 0, 0);
    shows(&mut story, 1000, 1, 0);
    shows(&mut story, 1200, 2, 2);
    story.sends(1300, 0, 1, 1);
    story.fault(20_000, None, "heal");
    let mut agreeing = story.clone();
    shows(&mut agreeing, 24_000, 2, 0);
    assert_none(&agreeing.verdict(60_000));
    let verdict = story.verdict(60_000);
    assert_eq!(verdict.len(), 1, "{verdict:?}");
    assert_eq!(verdict[0].property, "election.agreement");
}

#[test]
fn robots_that_were_unwell_have_the_bound_from_then_on() {
    let mut story = three("ballots");
    shows(&mut story, 1000, 0, 0);
    shows(&mut story, 1000, 1, 0);
    shows(&mut story, 1200, 2, 2);
    story.fault(5000, Some(2), "corrupt state");
    shows(&mut story, 9000, 2, 0);
    assert_none(&story.verdict(60_000));
}

#[test]
fn standing_without_a_leader_for_too_long_is_reported() {
    for algorithm in ["bully", "leases"] {
        let mut story = three(algorithm);
        shows(&mut story, 1000, 0, 0);
        shows(&mut story, 1000, 1, 0);
        let verdict = story.verdict(12_000);
        assert_only(&verdict, "election.progress", 5000, &[2]);
        assert_eq!(
            verdict[0].text,
            "robot 2 is a candidate and has had no leader for 5s"
        );
    }
}

#[test]
fn a_robot_that_does_not_stand_needs_no_leader() {
    let mut story = three("bully");
    shows(&mut story, 1000, 0, 0);
    shows(&mut story, 1000, 1, 0);
    story.report(1000, 2, ("election", "resign"), []);
    assert_none(&story.verdict(30_000));
}

#[test]
fn with_leases_a_robot_without_a_majority_has_no_leader() {
    let mut story = three("leases");
    story.fault(100, Some(0), "crash");
    story.fault(100, Some(1), "crash");
    assert_none(&story.verdict(30_000));
}

/// Robot 0 votes, robot 1 has restarted, robot 2 is down: no other robot knows the promises of robot 2.
#[test]
fn with_leases_robots_that_wait_for_one_with_memory_need_no_leader() {
    let mut story = three("leases");
    for robot in 0..3 {
        story.report(1000, robot, ("election", "vote"), [("anew", false.into())]);
        shows(&mut story, 1100, robot, 2);
    }
    story.fault(2000, Some(2), "crash");
    story.fault(2000, Some(1), "crash");
    story.fault(2500, Some(1), "restart");
    begins(&mut story, 2500, 1, "leases");
    story.report(3000, 0, ("election", "lost"), []);
    assert_none(&story.verdict(30_000));
    story.fault(30_000, Some(2), "restart");
    begins(&mut story, 30_000, 2, "leases");
    let verdict = story.verdict(60_000);
    assert!(!verdict.is_empty());
    assert!(
        verdict
            .iter()
            .all(|found| found.property == "election.progress")
    );
}

/// Robot 2 is down, robot 1 recovers. If robot 0 recovers with it, they start again together; if it voted already,
/// robot 2 is needed to continue. Within a second the two cases cannot be distinguished.
#[test]
fn with_leases_a_robot_that_voted_within_a_second_may_have_voted_before() {
    let verdict = |millis| {
        let mut story = three("leases");
        story.fault(100, Some(2), "crash");
        story.report(millis, 0, ("election", "vote"), [("anew", false.into())]);
        story.verdict(30_000)
    };
    assert_none(&verdict(900));
    let violated = verdict(1100);
    assert_eq!(violated.len(), 2, "{violated:?}");
    for found in violated {
        assert_eq!(found.property, "election.progress");
        assert_eq!(found.at, starl_core::Time(5_000_000_000));
    }
}
