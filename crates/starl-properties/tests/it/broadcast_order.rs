//! Deliveries are judged by the order of the instance.

use crate::support::{Story, assert_none, assert_only, seconds};
use starl_core::RobotId;
use starl_properties::{Excuse, Violation};

/// Three robots, whose broadcasts have 5 s.
fn story() -> Story {
    let mut story = Story::of_ground_robots(3);
    story.setting.properties.broadcast_bound = seconds(5);
    story
}

fn sends(story: &mut Story, millis: u64, robot: u32, number: u32, order: &'static str) {
    let fields = [
        ("number", number.into()),
        ("incarnation", 7u32.into()),
        ("retry_span", 4.0.into()),
        ("order", order.into()),
    ];
    story.report(millis, robot, ("broadcast", "broadcast"), fields);
}

fn handed(story: &mut Story, millis: u64, robot: u32, message: (u32, u32)) {
    story.delivers(millis, robot, "broadcast", message);
}

fn passes(story: &mut Story, millis: u64, robot: u32, (from, number): (u32, u32)) {
    let fields = [
        ("from", RobotId(from).into()),
        ("number", number.into()),
        ("incarnation", 7u32.into()),
    ];
    story.report(millis, robot, ("broadcast", "pass_over"), fields);
}

#[test]
fn unsent_messages_are_not_delivered() {
    let mut story = story();
    sends(&mut story, 1000, 0, 1, "fifo");
    for robot in 1..3 {
        handed(&mut story, 1100, robot, (0, 1));
    }
    assert_none(&story.verdict(9000));
    handed(&mut story, 1200, 1, (0, 2));
    assert_only(&story.verdict(9000), "broadcast.integrity", 1200, &[1, 0]);
}

#[test]
fn messages_are_delivered_once_per_life() {
    let mut twice = story();
    sends(&mut twice, 1000, 0, 1, "causal");
    for robot in 1..3 {
        handed(&mut twice, 1100, robot, (0, 1));
    }
    let mut again = twice.clone();
    handed(&mut twice, 2000, 1, (0, 1));
    assert_only(&twice.verdict(9000), "broadcast.integrity", 2000, &[1, 0]);
    again.fault(1500, Some(1), "crash");
    again.fault(1600, Some(1), "restart");
    handed(&mut again, 2000, 1, (0, 1));
    assert_none(&again.verdict(9000));
}

#[test]
fn a_senders_messages_are_delivered_in_order() {
    let mut story = story();
    sends(&mut story, 1000, 0, 1, "fifo");
    sends(&mut story, 1010, 0, 2, "fifo");
    for robot in 1..3 {
        handed(&mut story, 1100, robot, (0, u32::from(robot == 1) + 1));
        handed(&mut story, 1200, robot, (0, u32::from(robot == 2) + 1));
    }
    assert_only(&story.verdict(9000), "broadcast.fifo", 1200, &[1, 0]);
}

/// Robot 0 sends, robot 1 answers, robot 2 delivers the answer.
fn answer() -> Story {
    let mut story = story();
    sends(&mut story, 1000, 0, 1, "causal");
    handed(&mut story, 1100, 1, (0, 1));
    sends(&mut story, 1200, 1, 1, "causal");
    handed(&mut story, 1300, 0, (1, 1));
    story
}

#[test]
fn an_answer_is_delivered_after_its_question() {
    let mut before = answer();
    handed(&mut before, 1300, 2, (1, 1));
    handed(&mut before, 1400, 2, (0, 1));
    assert_only(
        &before.verdict(9000),
        "broadcast.causal_order",
        1300,
        &[2, 1],
    );
    let mut after = answer();
    handed(&mut after, 1300, 2, (0, 1));
    handed(&mut after, 1400, 2, (1, 1));
    assert_none(&after.verdict(30_000));
}

#[test]
fn messages_that_were_passed_over_are_not_delivered() {
    let mut passed = answer();
    passes(&mut passed, 1300, 2, (0, 1));
    handed(&mut passed, 1301, 2, (1, 1));
    assert_none(&passed.verdict(9000));
    handed(&mut passed, 1400, 2, (0, 1));
    assert_only(
        &passed.verdict(9000),
        "broadcast.causal_order",
        1400,
        &[2, 0],
    );
}

/// Robot 2 has delivered a message of robot 0 before its next one, which it will pass over.
fn known_sender() -> Story {
    let mut story = story();
    sends(&mut story, 500, 0, 1, "causal");
    handed(&mut story, 600, 2, (0, 1));
    sends(&mut story, 1000, 0, 2, "causal");
    story
}

#[test]
fn a_missing_message_is_waited_for() {
    let mut early = known_sender();
    passes(&mut early, 2400, 2, (0, 2));
    assert_only(
        &early.verdict(9000),
        "broadcast.causal_order",
        2400,
        &[2, 0],
    );
    let mut late = known_sender();
    passes(&mut late, 2600, 2, (0, 2));
    assert_none(&late.verdict(9000));
}

#[test]
fn a_message_that_will_not_come_is_not_waited_for() {
    let mut crashed = known_sender();
    crashed.fault(1100, Some(0), "crash");
    passes(&mut crashed, 1400, 2, (0, 2));
    assert_none(&crashed.verdict(9000));
    let mut restarted = known_sender();
    restarted.fault(1100, Some(2), "crash");
    restarted.fault(1200, Some(2), "restart");
    passes(&mut restarted, 1400, 2, (0, 2));
    assert_none(&restarted.verdict(9000));
    let mut given_up = known_sender();
    let fields = [
        ("number", 2u32.into()),
        ("incarnation", 7u32.into()),
        ("to", vec![RobotId(2)].into()),
    ];
    given_up.report(1300, 0, ("broadcast", "fail"), fields);
    passes(&mut given_up, 1400, 2, (0, 2));
    let verdict = given_up.verdict(9000);
    let is_about_order = |found: &Violation| found.property == "broadcast.causal_order";
    assert!(!verdict.iter().any(is_about_order));
}

/// Robot 0 sends a message in each of two lives; robot 1 delivers both and sends one.
fn two_lives() -> Story {
    let mut story = story();
    sends(&mut story, 1000, 0, 1, "causal");
    handed(&mut story, 1100, 1, (0, 1));
    story.fault(1200, Some(0), "crash");
    story.fault(1300, Some(0), "restart");
    let fields = [
        ("number", 1u32.into()),
        ("incarnation", 8u32.into()),
        ("retry_span", 4.0.into()),
        ("order", "causal".into()),
    ];
    story.report(1400, 0, ("broadcast", "broadcast"), fields);
    handed_of_second_life(&mut story, 1500, 1);
    sends(&mut story, 1600, 1, 1, "causal");
    story
}

fn handed_of_second_life(story: &mut Story, millis: u64, robot: u32) {
    let fields = [
        ("from", RobotId(0).into()),
        ("number", 1u32.into()),
        ("incarnation", 8u32.into()),
    ];
    story.report(millis, robot, ("broadcast", "deliver"), fields);
}

#[test]
fn messages_of_an_earlier_life_are_not_required_after_one_of_a_later_life() {
    let causal = |story: &Story| -> Vec<u64> {
        let verdict = story.verdict(2500);
        let found = verdict
            .iter()
            .filter(|v| v.property == "broadcast.causal_order");
        found.map(|violation| violation.at.0 / 1_000_000).collect()
    };
    let mut later = two_lives();
    handed_of_second_life(&mut later, 1700, 2);
    handed(&mut later, 1800, 2, (1, 1));
    assert_eq!(causal(&later), []);
    handed(&mut later, 1900, 2, (0, 1));
    assert_eq!(causal(&later), [1900], "nor may it come then");

    let mut nothing = two_lives();
    handed(&mut nothing, 1800, 2, (1, 1));
    assert_eq!(causal(&nothing), [1800], "both lives' messages are owed");
}

#[test]
fn concurrent_messages_may_be_delivered_in_any_order() {
    let mut story = story();
    sends(&mut story, 1000, 0, 1, "causal");
    sends(&mut story, 1000, 1, 1, "causal");
    handed(&mut story, 1100, 2, (0, 1));
    handed(&mut story, 1200, 2, (1, 1));
    handed(&mut story, 1100, 0, (1, 1));
    handed(&mut story, 1100, 1, (0, 1));
    assert_none(&story.verdict(9000));
}

/// Robots 0 and 1 each send a message, which all deliver in the order of `places`.
fn ordered(places: [[(u32, u32); 2]; 3]) -> Story {
    let mut story = story();
    (0..3).for_each(|robot| enters(&mut story, 500, robot));
    sends(&mut story, 1000, 0, 1, "total");
    sends(&mut story, 1000, 1, 1, "total");
    for (robot, sequence) in places.into_iter().enumerate() {
        for (place, message) in sequence.into_iter().enumerate() {
            let millis = 1100 + 100 * place as u64 + robot as u64;
            handed(&mut story, millis, robot as u32, message);
        }
    }
    story
}

fn joins(story: &mut Story, millis: u64, robot: u32) {
    story.report(
        millis,
        robot,
        ("broadcast", "join"),
        [("group", 1u32.into())],
    );
}

/// A robot enters the group as a voter.
fn enters(story: &mut Story, millis: u64, robot: u32) {
    joins(story, millis, robot);
    votes(story, millis, robot);
}

fn votes(story: &mut Story, millis: u64, robot: u32) {
    story.report(millis, robot, ("broadcast", "voter"), []);
}

#[test]
fn all_robots_deliver_the_same_order() {
    let (a, b) = ((0, 1), (1, 1));
    assert_none(&ordered([[a, b], [a, b], [a, b]]).verdict(9000));
    let violations = ordered([[a, b], [b, a], [a, b]]).verdict(9000);
    assert!(!violations.is_empty());
    for violation in violations {
        assert_eq!(violation.property, "broadcast.total_order");
        assert!(violation.robots.contains(&RobotId(1)), "{violation:?}");
    }
}

#[test]
fn omissions_must_be_reported_as_gaps() {
    let mut story = ordered([[(0, 1), (1, 1)]; 3]);
    sends(&mut story, 2000, 2, 1, "total");
    for robot in [0, 1, 2] {
        handed(&mut story, 2100, robot, (2, 1));
    }
    assert_none(&story.verdict(9000));
    for is_said in [false, true] {
        let mut story = ordered([[(0, 1), (1, 1)]; 3]);
        sends(&mut story, 2000, 2, 1, "total");
        sends(&mut story, 2000, 2, 2, "total");
        for robot in [0, 1] {
            handed(&mut story, 2100, robot, (2, 1));
        }
        for robot in [0, 1, 2] {
            handed(&mut story, 2200, robot, (2, 2));
        }
        if is_said {
            story.report(2150, 2, ("broadcast", "gap"), []);
            assert_none(&story.verdict(9000));
        } else {
            let violations = story.verdict(9000);
            let total = |violation: &&Violation| violation.property == "broadcast.total_order";
            assert_eq!(violations.iter().filter(total).count(), 1);
        }
    }
}

/// Robot 0 sends a message that robot 2 is not handed.
fn left_out() -> Story {
    let mut story = ordered([[(0, 1), (1, 1)]; 3]);
    sends(&mut story, 2000, 0, 2, "total");
    handed(&mut story, 2100, 0, (0, 2));
    handed(&mut story, 2100, 1, (0, 2));
    story
}

#[test]
fn a_majority_delivers_the_messages_of_its_robots() {
    assert_only(
        &left_out().verdict(9000),
        "broadcast.agreement",
        7000,
        &[0, 2],
    );
    let mut late = left_out();
    handed(&mut late, 7000, 2, (0, 2));
    assert_none(&late.verdict(90_000));
}

#[test]
fn robots_that_are_down_or_apart_or_joined_later_are_not_judged() {
    let mut down = left_out();
    down.fault(2050, Some(2), "crash");
    assert_none(&down.verdict(90_000));
    let mut apart = left_out();
    apart.fault(2050, None, "partition");
    apart.sends(2060, 0, 1, 1);
    assert_none(&apart.verdict(90_000));
    let mut later = left_out();
    joins(&mut later, 2050, 2);
    assert_none(&later.verdict(90_000));
}

#[test]
fn a_robot_is_let_in_within_half_a_minute() {
    let sent_at = |millis: u64| {
        let mut story = story();
        (0..2).for_each(|robot| enters(&mut story, 500, robot));
        sends(&mut story, millis, 0, 1, "total");
        (0..2).for_each(|robot| handed(&mut story, millis + 100, robot, (0, 1)));
        story
    };
    assert_none(&sent_at(29_000).verdict(90_000));
    assert_only(
        &sent_at(31_000).verdict(90_000),
        "broadcast.agreement",
        36_000,
        &[0, 2],
    );
    let mut entered = sent_at(31_000);
    joins(&mut entered, 35_000, 2);
    assert_none(&entered.verdict(90_000));
}

#[test]
fn after_a_fault_there_is_more_time() {
    let mut story = left_out();
    story.fault(2050, Some(1), "stuck motor");
    assert_only(
        &story.verdict(90_000),
        "broadcast.agreement",
        37_050,
        &[0, 2],
    );
}

fn gives_up(story: &mut Story, millis: u64, robot: u32, number: u32) {
    story.fails(millis, robot, number, &[]);
}

#[test]
fn giving_up_is_excused_only_near_a_fault() {
    let mut story = ordered([[(0, 1), (1, 1)]; 3]);
    story.fault(2000, Some(1), "stuck motor");
    let mut near = story.clone();
    sends(&mut near, 10_000, 0, 2, "total");
    gives_up(&mut near, 14_000, 0, 2);
    assert_none(&near.verdict(90_000));
    sends(&mut story, 40_000, 0, 2, "total");
    gives_up(&mut story, 44_000, 0, 2);
    let property = "broadcast.agreement";
    assert_only(&story.verdict(90_000), property, 45_000, &[0, 0, 1, 2]);
}

#[test]
fn a_robot_without_a_majority_may_give_up_long_after_the_cut_and_shortly_before_its_end() {
    let mut story = ordered([[(0, 1), (1, 1)]; 3]);
    story.fault(2000, None, "partition");
    story.sends(2300, 1, 2, 1);
    sends(&mut story, 40_000, 0, 2, "total");
    gives_up(&mut story, 44_000, 0, 2);
    story.fault(44_500, None, "heal");
    assert_none(&story.verdict(90_000));
    // In a majority it may not.
    sends(&mut story, 80_000, 0, 3, "total");
    gives_up(&mut story, 84_000, 0, 3);
    let property = "broadcast.agreement";
    assert_only(&story.verdict(90_000), property, 85_000, &[0, 0, 1, 2]);
}

/// Three robots that have delivered the same messages; then these crash and restart.
fn ordered_with_restarts(robots: &[u32]) -> Story {
    let mut story = ordered([[(0, 1), (1, 1)]; 3]);
    for &robot in robots {
        story.fault(2000, Some(robot), "crash");
        story.fault(2100, Some(robot), "restart");
    }
    story
}

#[test]
fn a_robot_that_is_down_excuses_only_where_others_have_crashed_too() {
    let crashed = |others: &[u32]| {
        let mut story = ordered_with_restarts(others);
        story.fault(2200, Some(2), "crash");
        sends(&mut story, 40_000, 0, 2, "total");
        story
    };
    let property = "broadcast.agreement";
    assert_only(&crashed(&[]).verdict(90_000), property, 45_000, &[0, 0, 1]);
    assert_none(&crashed(&[1]).verdict(90_000));
    let excused = crashed(&[1]).excused(90_000, property);
    let reasons: Vec<Excuse> = excused.into_iter().map(|(excuse, _)| excuse).collect();
    assert!(reasons.contains(&Excuse::NoMajority), "{reasons:?}");
    let mut all_up = crashed(&[1]);
    all_up.fault(2300, Some(2), "restart");
    assert_eq!(all_up.verdict(90_000).len(), 1, "nobody is down");
}

#[test]
fn a_robot_that_is_apart_excuses_only_where_another_has_crashed() {
    let cut = |crashed: &[u32]| {
        let mut story = ordered_with_restarts(crashed);
        story.fault(2200, None, "partition");
        story.sends(2300, 0, 1, 1);
        story.sends(2400, 1, 0, 1);
        sends(&mut story, 40_000, 0, 2, "total");
        story
    };
    let property = "broadcast.agreement";
    assert_only(&cut(&[]).verdict(90_000), property, 45_000, &[0, 0, 1]);
    assert_none(&cut(&[1]).verdict(90_000));
    let excused = cut(&[1]).excused(90_000, property);
    let reasons: Vec<Excuse> = excused.into_iter().map(|(excuse, _)| excuse).collect();
    assert!(reasons.contains(&Excuse::NoMajority), "{reasons:?}");
}

#[test]
fn a_robot_that_is_apart_excuses_where_another_does_not_vote() {
    let cut_off = |voters: &[u32]| {
        let mut story = story();
        (0..3).for_each(|robot| joins(&mut story, 500, robot));
        for &robot in voters {
            votes(&mut story, 600, robot);
        }
        story.fault(2200, None, "partition");
        story.sends(2300, 0, 1, 1);
        sends(&mut story, 40_000, 0, 1, "total");
        story
    };
    let property = "broadcast.agreement";
    let all = cut_off(&[0, 1, 2]);
    assert_only(&all.verdict(90_000), property, 45_000, &[0, 0, 1]);
    // Of the two voters only robot 0 can be reached.
    assert_none(&cut_off(&[0, 2]).verdict(90_000));
    let mut left = all.clone();
    left.report(
        3000,
        1,
        ("broadcast", "leave"),
        [("reason", "obsolete".into())],
    );
    assert_none(&left.verdict(90_000));
    joins(&mut left, 3100, 1);
    assert_none(&left.verdict(90_000));
    votes(&mut left, 3200, 1);
    assert_only(&left.verdict(90_000), property, 45_000, &[0, 0, 1]);
}

#[test]
fn a_corruption_excuses_for_a_while() {
    let mut story = answer();
    story.fault(1250, Some(2), "corrupt state");
    handed(&mut story, 1300, 2, (1, 1));
    handed(&mut story, 1400, 2, (0, 1));
    assert_none(&story.verdict(9000));
}

#[test]
fn a_corruption_counts_no_more_after_a_bound() {
    let mut story = answer();
    story.fault(1250, Some(2), "corrupt state");
    passes(&mut story, 1300, 2, (1, 7_859_365));
    sends(&mut story, 9000, 1, 2, "causal");
    for robot in [0, 2] {
        handed(&mut story, 9100, robot, (1, 2));
    }
    assert_none(&story.verdict(19_000));
}

#[test]
fn only_the_properties_of_its_order_apply_to_a_broadcast() {
    let applying = answer().applying(9000);
    let has = |property: &str| applying.iter().any(|applying| applying == property);
    assert!(has("broadcast.causal_order"), "{applying:?}");
    assert!(!has("broadcast.total_order"), "{applying:?}");
}

#[test]
fn unordered_messages_are_delivered_once_in_any_order() {
    let mut story = story();
    for number in 1..=3 {
        story.broadcasts(1000, 0, number);
    }
    for (millis, number) in [(1100, 3), (1110, 1), (1120, 2)] {
        for robot in 1..3 {
            handed(&mut story, millis, robot, (0, number));
        }
    }
    assert_none(&story.verdict(9000));
    let mut twice = story.clone();
    handed(&mut twice, 1200, 2, (0, 1));
    assert_only(&twice.verdict(9000), "broadcast.integrity", 1200, &[2, 0]);
    handed(&mut story, 1200, 2, (0, 4));
    assert_only(&story.verdict(9000), "broadcast.integrity", 1200, &[2, 0]);
}

/// Robot 0 broadcasts in total order and delivers its message. The records are a simulator's, with this datagram.
fn delivered_after(millis: u64, from: u32, to: u32) -> Story {
    let mut story = story();
    story.setting.simulated = true;
    story.sends(600, 2, 1, 1);
    for robot in 0..3 {
        story.report(500, robot, ("broadcast", "join"), [("group", 1u32.into())]);
    }
    let datagram = |story: &mut Story, at: u64| {
        if at == millis {
            story.sends(at, from, 1, to);
        }
    };
    datagram(&mut story, 900);
    sends(&mut story, 1000, 0, 1, "total");
    datagram(&mut story, 1100);
    handed(&mut story, 1200, 0, (0, 1));
    for robot in 1..3 {
        story.sends(1300, 0, 1 + robot, robot);
        handed(&mut story, 1400, robot, (0, 1));
    }
    story
}

#[test]
fn no_robot_delivers_what_no_majority_can_have() {
    assert_none(&delivered_after(1100, 0, 1).verdict(9000));
    for story in [delivered_after(900, 0, 1), delivered_after(1100, 1, 2)] {
        assert_only(&story.verdict(9000), "broadcast.agreement", 1200, &[0]);
    }
}

#[test]
fn only_a_corruption_excuses_a_log_that_differs() {
    let leaves = |story: &mut Story, reason: &'static str| {
        story.report(2000, 1, ("broadcast", "leave"), [("reason", reason.into())]);
    };
    let mut lost = ordered([[(0, 1), (1, 1)]; 3]);
    leaves(&mut lost, "lost");
    assert_none(&lost.verdict(9000));
    let mut differs = ordered([[(0, 1), (1, 1)]; 3]);
    leaves(&mut differs, "corrupt");
    assert_only(&differs.verdict(9000), "broadcast.total_order", 2000, &[1]);
    let mut corrupted = ordered([[(0, 1), (1, 1)]; 3]);
    corrupted.fault(1900, Some(1), "corrupt state");
    leaves(&mut corrupted, "corrupt");
    assert_none(&corrupted.verdict(9000));
}
