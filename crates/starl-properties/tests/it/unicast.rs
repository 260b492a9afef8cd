//! A message to one robot reaches it within the bound, and once.

use crate::broadcast_delivery::dropped;
use crate::support::{Story, assert_none, assert_only, seconds};
use starl_core::RobotId;
use starl_core::event::DropReason;
use starl_properties::Excuse;

/// Robot 0 sends its message of this number to a robot at 1 s; it has 5 s.
fn sent(number: u32, to: u32) -> Story {
    let mut story = Story::of_ground_robots(3);
    story.setting.properties.unicast_bound = seconds(5);
    sends(&mut story, number, to);
    story
}

fn sends(story: &mut Story, number: u32, to: u32) {
    let fields = [
        ("number", number.into()),
        ("incarnation", 7u32.into()),
        ("retry_span", 4.0.into()),
        ("to", RobotId(to).into()),
    ];
    story.report(1000, 0, ("unicast", "send"), fields);
}

#[test]
fn a_message_that_does_not_arrive_is_reported_at_its_deadline() {
    let mut story = sent(1, 2);
    // Numbers are counted for each receiver.
    sends(&mut story, 1, 1);
    story.delivers(1100, 1, "unicast", (0, 1));
    assert_only(&story.verdict(60_000), "unicast.delivery", 6000, &[0, 2]);
    let mut late = sent(1, 2);
    late.delivers(6001, 2, "unicast", (0, 1));
    assert_only(&late.verdict(60_000), "unicast.delivery", 6000, &[0, 2]);
    let mut in_time = sent(1, 2);
    in_time.delivers(6000, 2, "unicast", (0, 1));
    assert_none(&in_time.verdict(60_000));
}

#[test]
fn a_message_given_up_is_reported_at_once() {
    let mut story = sent(1, 2);
    let fields = [
        ("number", 1u32.into()),
        ("incarnation", 7u32.into()),
        ("to", vec![RobotId(2)].into()),
    ];
    story.report(3000, 0, ("unicast", "fail"), fields);
    assert_only(&story.verdict(60_000), "unicast.delivery", 3000, &[0, 2]);
}

#[test]
fn a_receiver_that_was_down_excuses_and_another_robot_does_not() {
    let mut story = sent(1, 2);
    story.fault(2000, Some(2), "crash");
    story.fault(2500, Some(2), "restart");
    assert_none(&story.verdict(60_000));
    assert_eq!(
        story.excused(60_000, "unicast.delivery"),
        [(Excuse::Down, 1)]
    );
    let mut story = sent(1, 2);
    story.fault(2000, Some(1), "crash");
    assert_only(&story.verdict(60_000), "unicast.delivery", 6000, &[0, 2]);
}

#[test]
fn a_second_delivery_is_reported_unless_the_receiver_has_restarted() {
    let mut story = sent(1, 2);
    story.delivers(1100, 2, "unicast", (0, 1));
    let mut again = story.clone();
    again.delivers(1200, 2, "unicast", (0, 1));
    assert_only(&again.verdict(60_000), "unicast.integrity", 1200, &[2, 0]);
    story.fault(1150, Some(2), "crash");
    story.fault(1160, Some(2), "restart");
    story.delivers(1200, 2, "unicast", (0, 1));
    assert_none(&story.verdict(60_000));
}

#[test]
fn messages_to_other_robots_are_not_delivered() {
    let mut story = sent(1, 2);
    story.delivers(1100, 2, "unicast", (0, 1));
    story.delivers(1200, 1, "unicast", (0, 1));
    assert_only(&story.verdict(60_000), "unicast.integrity", 1200, &[1, 0]);
}

#[test]
fn no_fault_excuses_an_acknowledged_message_that_did_not_arrive() {
    let acknowledged = |story: &mut Story| {
        let fields = [
            ("number", 1u32.into()),
            ("incarnation", 7u32.into()),
            ("to", RobotId(2).into()),
        ];
        story.report(3000, 0, ("unicast", "acknowledged"), fields);
    };
    let mut story = sent(1, 2);
    story.fault(1500, Some(2), "crash");
    acknowledged(&mut story);
    assert_only(&story.verdict(60_000), "unicast.delivery", 3000, &[0, 2]);
    let mut story = sent(1, 2);
    story.delivers(1400, 2, "unicast", (0, 1));
    story.fault(1500, Some(2), "crash");
    acknowledged(&mut story);
    assert_none(&story.verdict(60_000));
}

/// A receiver has to hear from a sender that it does not know before it delivers, and a sender that it knows it need not.
#[test]
fn a_cut_of_the_way_back_excuses_only_robots_that_have_not_met() {
    let mut story = sent(1, 2);
    dropped(&mut story, 2000, (2, 0), DropReason::Partition);
    assert_none(&story.verdict(60_000));
    assert_eq!(
        story.excused(60_000, "unicast.delivery"),
        [(Excuse::Partition, 1)]
    );
    let mut met = Story::of_ground_robots(3);
    met.setting.properties.unicast_bound = seconds(5);
    sends(&mut met, 1, 2);
    met.delivers(1100, 2, "unicast", (0, 1));
    sends(&mut met, 2, 2);
    dropped(&mut met, 2000, (2, 0), DropReason::Partition);
    assert_only(&met.verdict(60_000), "unicast.delivery", 6000, &[0, 2]);
}
