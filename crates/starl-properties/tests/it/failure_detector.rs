//! The properties of failure detectors by stories: what keeps them passes, what breaks one is found and named.

use crate::support::{Story, seconds};
use starl_core::event::Event;
use starl_core::{Intervention, RobotId};

/// Three robots and a bound of 7 s; robots 0 and 1 have suspected robot 2 once, and trust it again.
fn robots() -> Story {
    let mut story = Story::of_ground_robots(3);
    story.setting.properties.failure_detector_bound = seconds(7);
    for robot in 0..2 {
        suspects(&mut story, 100, robot, 2, "silence");
        trusts(&mut story, 200, robot, 2);
    }
    story
}

fn suspects(story: &mut Story, at: u64, robot: u32, peer: u32, reason: &'static str) {
    let fields = [("peer", RobotId(peer).into()), ("reason", reason.into())];
    story.report(at, robot, ("failure_detector", "suspect"), fields);
}

fn trusts(story: &mut Story, at: u64, robot: u32, peer: u32) {
    let fields = [("peer", RobotId(peer).into())];
    story.report(at, robot, ("failure_detector", "trust"), fields);
}

/// Datagrams of one robot reach another, four a second.
fn hears(story: &mut Story, from: u64, to: u64, robot: u32, peer: u32) {
    for (sequence, at) in (from..to).step_by(250).enumerate() {
        let event = Event::Delivered {
            from: RobotId(peer),
            sequence: sequence as u32,
        };
        story.record(at, Some(robot), event);
    }
}

fn properties(story: &Story) -> Vec<String> {
    let found = story.verdict(60_000);
    let names = found.iter().map(|violation| violation.property.to_string());
    names.collect()
}

#[test]
fn a_crash_that_is_suspected_satisfies_all_properties() {
    let mut story = robots();
    story.fault(10_000, Some(2), "crash");
    suspects(&mut story, 12_000, 0, 2, "silence");
    suspects(&mut story, 16_900, 1, 2, "silence");
    assert_eq!(properties(&story), [""; 0]);
}

#[test]
fn a_crash_that_goes_unnoticed_is_found_for_each_observer() {
    let mut story = robots();
    story.fault(10_000, Some(2), "crash");
    suspects(&mut story, 12_000, 0, 2, "silence");
    let found = story.verdict(60_000);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].property, "failure_detector.completeness");
    assert_eq!(found[0].robots, [RobotId(1), RobotId(2)]);
}

#[test]
fn a_restart_must_be_noticed_however_short() {
    let mut story = robots();
    story.fault(10_000, Some(2), "crash");
    story.fault(10_050, Some(2), "restart");
    suspects(&mut story, 10_500, 0, 2, "restart");
    trusts(&mut story, 10_500, 0, 2);
    assert_eq!(properties(&story), ["failure_detector.completeness"]);
}

#[test]
fn a_robot_that_is_suspected_already_need_not_be_suspected_again() {
    let mut story = robots();
    suspects(&mut story, 9_000, 0, 2, "silence");
    suspects(&mut story, 9_000, 1, 2, "silence");
    story.fault(10_000, Some(2), "crash");
    assert_eq!(properties(&story), [""; 0]);
}

#[test]
fn a_robot_that_leaves_need_not_be_suspected() {
    let mut story = robots();
    story.fault(10_000, Some(2), "crash");
    suspects(&mut story, 12_000, 0, 2, "silence");
    suspects(&mut story, 12_000, 1, 2, "silence");
    let leave = Intervention::Leave(vec![RobotId(2)]);
    story.record(30_000, None, Event::Intervention(Box::new(leave)));
    story.fault(30_000, Some(2), "crash");
    assert_eq!(properties(&story), [""; 0]);
}

#[test]
fn an_observer_that_has_lost_its_state_owes_nothing_at_first() {
    for fault in ["crash", "corrupt state"] {
        for at in [4_000, 12_000] {
            let mut story = robots();
            story.fault(at, Some(1), fault);
            if fault == "crash" {
                story.fault(at + 100, Some(1), "restart");
                suspects(&mut story, at + 500, 0, 1, "restart");
                trusts(&mut story, at + 500, 0, 1);
            }
            story.fault(10_000, Some(2), "crash");
            suspects(&mut story, 12_500, 0, 2, "silence");
            assert_eq!(properties(&story), [""; 0], "{fault} at {at} ms");
        }
    }
}

#[test]
fn a_bound_after_its_own_restart_an_observer_owes_as_before() {
    let mut story = robots();
    story.fault(2_000, Some(1), "crash");
    story.fault(2_100, Some(1), "restart");
    story.fault(10_000, Some(2), "crash");
    suspects(&mut story, 12_500, 0, 2, "silence");
    assert_eq!(properties(&story), ["failure_detector.completeness"]);
}

#[test]
fn a_restart_of_an_observer_that_is_up_changes_nothing() {
    let mut story = robots();
    suspects(&mut story, 5_000, 0, 2, "silence");
    suspects(&mut story, 5_000, 1, 2, "silence");
    story.fault(6_000, Some(1), "restart");
    story.fault(20_000, Some(2), "crash");
    assert_eq!(properties(&story), [""; 0]);
}

#[test]
fn a_robot_that_is_heard_and_never_trusted_is_found_once() {
    let mut story = robots();
    suspects(&mut story, 10_000, 0, 2, "silence");
    hears(&mut story, 12_000, 40_000, 0, 2);
    assert_eq!(properties(&story), ["failure_detector.accuracy"]);
}

#[test]
fn silences_and_corruptions_restart_the_time_of_trust() {
    let mut silent = robots();
    suspects(&mut silent, 10_000, 0, 2, "silence");
    hears(&mut silent, 12_000, 18_000, 0, 2);
    hears(&mut silent, 19_500, 25_000, 0, 2);
    assert_eq!(properties(&silent), [""; 0]);

    for robot in [0, 2] {
        let mut corrupted = robots();
        suspects(&mut corrupted, 10_000, 0, 2, "silence");
        hears(&mut corrupted, 12_000, 24_000, 0, 2);
        corrupted.fault(18_000, Some(robot), "corrupt state");
        assert_eq!(properties(&corrupted), [""; 0], "robot {robot}");
    }
}
