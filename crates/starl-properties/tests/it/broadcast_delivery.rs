//! Every broadcast reaches every robot that is up and connected within the bound.

use crate::support::{Story, assert_none, assert_only, at, seconds};
use starl_core::event::DropReason;
use starl_core::{Event, RobotId};

/// Robot 0 broadcasts message 1 at 1 s to robots 1 and 2, which have 5 s to deliver it.
fn broadcast_at_1s() -> Story {
    let mut story = Story::of_ground_robots(3);
    story.setting.properties.broadcast_bound = seconds(5);
    story.broadcasts(1000, 0, 1);
    story
}

/// Robot 2 does not deliver it.
fn robot_2_hears_nothing() -> Story {
    let mut story = broadcast_at_1s();
    story.delivers(1100, 1, "broadcast", (0, 1));
    story
}

pub fn dropped(story: &mut Story, millis: u64, (from, to): (u32, u32), reason: DropReason) {
    let event = Event::Dropped {
        from: RobotId(from),
        to: Some(RobotId(to)),
        sequence: 0,
        reason,
    };
    story.record(millis, Some(from), event);
}

#[test]
fn a_message_that_does_not_arrive_is_reported_once_when_its_time_is_up() {
    let verdict = robot_2_hears_nothing().verdict(60_000);
    assert_only(&verdict, "broadcast.delivery", 6000, &[0, 2]);
    assert_eq!(
        verdict[0].text,
        "message 1 that robot 0 broadcast at 1.000s did not reach robot 2 within 5s"
    );
}

#[test]
fn all_robots_that_it_does_not_reach_are_named_together() {
    let verdict = broadcast_at_1s().verdict(60_000);
    assert_only(&verdict, "broadcast.delivery", 6000, &[0, 1, 2]);
    assert!(verdict[0].text.contains("did not reach robots 1 and 2"));
}

#[test]
fn the_last_moment_is_in_time_and_the_next_is_not() {
    let mut story = robot_2_hears_nothing();
    story.delivers(6000, 2, "broadcast", (0, 1));
    assert_none(&story.verdict(60_000));
    let mut late = robot_2_hears_nothing();
    late.delivers(6001, 2, "broadcast", (0, 1));
    assert_only(&late.verdict(60_000), "broadcast.delivery", 6000, &[0, 2]);
}

#[test]
fn a_bound_that_has_not_run_out_is_not_judged() {
    assert_none(&robot_2_hears_nothing().verdict(6000));
}

#[test]
fn messages_are_identified_by_sender_and_number() {
    let mut story = robot_2_hears_nothing();
    story.broadcasts(1000, 0, 2);
    story.broadcasts(1000, 1, 1);
    for robot in [1, 2] {
        story.delivers(1100, robot, "broadcast", (0, 2));
    }
    for robot in [0, 2] {
        story.delivers(1100, robot, "broadcast", (1, 1));
    }
    assert_only(&story.verdict(60_000), "broadcast.delivery", 6000, &[0, 2]);
}

#[test]
fn several_messages_are_each_judged() {
    let mut story = robot_2_hears_nothing();
    for number in 2..50 {
        let sent = 1000 + 50 * u64::from(number);
        story.broadcasts(sent, 0, number);
        story.delivers(sent + 30, 1, "broadcast", (0, number));
        if number != 20 {
            story.delivers(sent + 60, 2, "broadcast", (0, number));
        }
    }
    let verdict = story.verdict(60_000);
    let at: Vec<_> = verdict.iter().map(|violation| violation.at.0).collect();
    assert_eq!(at, [6_000_000_000, 7_000_000_000]);
}

#[test]
fn a_sender_that_gives_up_admits_it() {
    let mut story = robot_2_hears_nothing();
    story.fails(3000, 0, 1, &[2]);
    let verdict = story.verdict(60_000);
    assert_only(&verdict, "broadcast.delivery", 3000, &[0, 2]);
    assert!(
        verdict[0]
            .text
            .ends_with("before its sender gave up after 2.000 s")
    );
}

#[test]
fn a_sender_that_only_missed_the_acknowledgements_has_done_its_duty() {
    let mut story = robot_2_hears_nothing();
    story.delivers(1200, 2, "broadcast", (0, 1));
    story.fails(3000, 0, 1, &[1, 2]);
    assert_none(&story.verdict(60_000));
}

#[test]
fn giving_up_one_robot_does_not_let_off_the_others() {
    let mut story = broadcast_at_1s();
    story.fault(500, Some(2), "crash");
    story.fails(3000, 0, 1, &[2]);
    assert_only(&story.verdict(60_000), "broadcast.delivery", 6000, &[0, 1]);
}

#[test]
fn a_receiver_that_was_down_is_excused() {
    // Down throughout; from before until after; during.
    for (crash, restart) in [(500, None), (500, Some(1500)), (2000, Some(2100))] {
        let mut story = robot_2_hears_nothing();
        story.fault(crash, Some(2), "crash");
        if let Some(restart) = restart {
            story.fault(restart, Some(2), "restart");
        }
        assert_none(&story.verdict(60_000));
    }
}

#[test]
fn a_receiver_that_was_down_before_or_after_is_not_excused() {
    for (crash, restart) in [(500, 900), (6025, 7000)] {
        let mut story = robot_2_hears_nothing();
        story.fault(crash, Some(2), "crash");
        story.fault(restart, Some(2), "restart");
        assert_only(&story.verdict(60_000), "broadcast.delivery", 6000, &[0, 2]);
    }
}

#[test]
fn a_sender_that_crashes_leaves_everyone_excused() {
    let mut story = broadcast_at_1s();
    story.fault(1500, Some(0), "crash");
    assert_none(&story.verdict(60_000));
}

#[test]
fn a_program_that_fails_is_as_good_as_down_and_one_that_finishes_is_not() {
    let mut story = robot_2_hears_nothing();
    story.record(2000, Some(2), Event::Failed("lost".into()));
    assert_none(&story.verdict(60_000));
    let mut finished = robot_2_hears_nothing();
    finished.record(2000, Some(2), Event::Finished);
    assert_only(
        &finished.verdict(60_000),
        "broadcast.delivery",
        6000,
        &[0, 2],
    );
}

#[test]
fn faults_that_do_not_stop_a_robot_from_talking_excuse_nothing() {
    for fault in ["stuck motor", "frozen sensor"] {
        let mut story = robot_2_hears_nothing();
        story.fault(2000, Some(2), fault);
        assert_only(&story.verdict(60_000), "broadcast.delivery", 6000, &[0, 2]);
    }
}

#[test]
fn a_robot_behind_a_partition_is_excused() {
    let mut story = robot_2_hears_nothing();
    story.fault(900, None, "partition");
    dropped(&mut story, 1000, (0, 2), DropReason::Partition);
    story.fault(2000, None, "heal");
    assert_none(&story.verdict(60_000));
}

#[test]
fn a_partition_between_others_or_at_another_time_excuses_no_robot() {
    for (millis, link) in [
        (1500, (0, 1)),
        (1500, (2, 0)),
        (999, (0, 2)),
        (6125, (0, 2)),
    ] {
        let mut story = robot_2_hears_nothing();
        // Robot 2 knows robot 0: it need not be heard to deliver more of its messages.
        story.broadcasts(700, 0, 9);
        story.delivers(750, 1, "broadcast", (0, 9));
        story.delivers(750, 2, "broadcast", (0, 9));
        story.stays(0, 7000, 0, at(0.0, 0.0));
        story.fault(900, None, "partition");
        dropped(&mut story, millis, link, DropReason::Partition);
        story.fault(7000, None, "heal");
        assert_only(&story.verdict(60_000), "broadcast.delivery", 6000, &[0, 2]);
    }
}

#[test]
fn a_late_message_of_an_earlier_life_makes_no_later_life_known() {
    let of_second_life = [
        ("number", 1u32.into()),
        ("incarnation", 8u32.into()),
        ("retry_span", 4.0.into()),
    ];
    for (crashes, excused) in [(true, true), (false, false)] {
        let mut story = Story::of_ground_robots(2);
        story.setting.properties.broadcast_bound = seconds(5);
        story.broadcasts(700, 0, 9);
        if crashes {
            story.fault(750, Some(0), "crash");
            story.fault(800, Some(0), "restart");
        }
        story.delivers(850, 1, "broadcast", (0, 9));
        match crashes {
            true => story.report(1000, 0, ("broadcast", "broadcast"), of_second_life.clone()),
            false => story.broadcasts(1000, 0, 1),
        };
        // Robot 0 is heard and hears nothing, so that a robot that does not know its life cannot ask for it.
        dropped(&mut story, 1500, (1, 0), DropReason::Partition);
        assert_eq!(story.verdict(60_000).is_empty(), excused, "{crashes}");
    }
}

#[test]
fn robots_that_meet_only_after_a_cut_owe_nothing_from_before() {
    for (meets, excused) in [(3000, true), (900, false)] {
        let mut story = Story::of_ground_robots(2);
        story.setting.properties.broadcast_bound = seconds(5);
        story.broadcasts(800, 0, 1);
        story.broadcasts(1000, 0, 2);
        // Robot 0 does not hear robot 1 until 3 s.
        dropped(&mut story, 1500, (1, 0), DropReason::Partition);
        story.delivers(meets, 1, "broadcast", (0, 1));
        assert_eq!(story.verdict(60_000).is_empty(), excused, "{meets}");
    }
}

#[test]
fn a_robot_that_passes_a_message_over_is_excused_only_if_it_could_not_ask_for_it() {
    for (link, excused) in [((1, 0), true), ((1, 2), false)] {
        let mut story = Story::of_ground_robots(3);
        story.setting.properties.broadcast_bound = seconds(5);
        for (millis, number) in [(700, 1), (1000, 2)] {
            let fields = [
                ("number", number.into()),
                ("incarnation", 7u32.into()),
                ("retry_span", 4.0.into()),
                ("order", "causal".into()),
            ];
            story.report(millis, 0, ("broadcast", "broadcast"), fields);
        }
        for (millis, robot, number) in [(800, 1, 1), (800, 2, 1), (1100, 2, 2)] {
            story.delivers(millis, robot, "broadcast", (0, number));
        }
        dropped(&mut story, 1500, link, DropReason::Partition);
        let over = [
            ("from", RobotId(0).into()),
            ("number", 2u32.into()),
            ("incarnation", 7u32.into()),
        ];
        story.report(9000, 1, ("broadcast", "pass_over"), over);
        assert_eq!(story.verdict(60_000).is_empty(), excused, "{link:?}");
    }
}

#[test]
fn loss_and_range_excuse_no_robot() {
    for reason in [DropReason::Loss, DropReason::Range, DropReason::Bandwidth] {
        let mut story = robot_2_hears_nothing();
        dropped(&mut story, 1000, (0, 2), reason);
        assert_only(&story.verdict(60_000), "broadcast.delivery", 6000, &[0, 2]);
    }
}

#[test]
fn a_cut_that_is_old_when_another_partition_sets_in_is_still_known_while_it_counts() {
    let mut story = robot_2_hears_nothing();
    dropped(&mut story, 1000, (0, 2), DropReason::Partition);
    story.fault(5900, None, "partition");
    assert_none(&story.verdict(60_000));
}

#[test]
fn no_fault_excuses_an_acknowledged_message_without_delivery() {
    let acknowledged = |story: &mut Story| {
        let fields = [("number", 1u32.into()), ("incarnation", 7u32.into())];
        story.report(3000, 0, ("broadcast", "acknowledged"), fields);
    };
    let mut story = robot_2_hears_nothing();
    story.fault(1500, Some(2), "crash");
    acknowledged(&mut story);
    assert_only(&story.verdict(60_000), "broadcast.delivery", 3000, &[0, 2]);
    let mut story = robot_2_hears_nothing();
    story.delivers(1400, 2, "broadcast", (0, 1));
    story.fault(1500, Some(2), "crash");
    acknowledged(&mut story);
    assert_none(&story.verdict(60_000));
}

/// Robot 0 broadcasts message 1 in causal order at 1 s to robot 1, which has 10 s to deliver it.
fn causal_broadcast_at_1s() -> Story {
    let mut story = Story::of_ground_robots(2);
    story.setting.properties.broadcast_bound = seconds(5);
    let fields = [
        ("number", 1u32.into()),
        ("incarnation", 7u32.into()),
        ("retry_span", 4.0.into()),
        ("order", "causal".into()),
    ];
    story.report(1000, 0, ("broadcast", "broadcast"), fields);
    story
}

#[test]
fn in_causal_order_a_message_may_be_held_back_longer_than_its_sender_waits() {
    let mut story = causal_broadcast_at_1s();
    story.fails(4000, 0, 1, &[1]);
    assert_only(
        &story.verdict(60_000),
        "broadcast.delivery",
        11_000,
        &[0, 1],
    );
    story.delivers(9000, 1, "broadcast", (0, 1));
    assert_none(&story.verdict(60_000));
}

#[test]
fn a_partition_is_remembered_for_as_long_as_causal_order_has_time() {
    let mut story = causal_broadcast_at_1s();
    let mut lost = story.clone();
    lost.fault(9000, None, "partition");
    assert_only(&lost.verdict(60_000), "broadcast.delivery", 11_000, &[0, 1]);
    dropped(&mut story, 1500, (0, 1), DropReason::Partition);
    story.fault(2000, None, "heal");
    story.fault(9000, None, "partition");
    assert_none(&story.verdict(60_000));
}
