//! A car that breaks down on the intersection is not run into. Those whose ways are free continue, and those whose ways
//! are not know that they are stuck. Nor is one that merely seems to have broken down.

use crate::intersection_support::{Traffic, drive};
use starl_sim::Outcome;

/// Robot1, which comes from the south, breaks down in this manner at this time, and the others continue for 90 s.
fn break_down(kind: &str, at: &str) -> Traffic {
    let faults = format!("[[fault]]\nat = \"{at}\"\nkind = \"{kind}\"\nrobots = [\"Robot1\"]\n");
    let traffic = drive("intersection", &["duration=90s"], &faults);
    assert!(
        traffic.violations.is_empty(),
        "{kind} {at} {:?}",
        traffic.violations
    );
    traffic
}

#[test]
fn where_it_crashes_the_others_go_round_it_or_know_that_they_are_stuck() {
    for at in ["4.5s", "5s", "5.5s", "6s", "6.5s", "7s", "7.5s"] {
        let traffic = break_down("crash", at);
        let passed = traffic.passed();
        let stuck = traffic.stuck_at_the_end();
        assert!(!passed.contains(&1), "{at}");
        for car in [0, 2, 3] {
            assert_ne!(passed.contains(&car), stuck.contains(&car), "{at}: {car}");
        }
        // Neither needs a zone of Robot1's.
        assert!(
            passed.contains(&0) && passed.contains(&3),
            "{at}: {passed:?}"
        );
    }
}

/// In the zone B, which Robot2 needs.
#[test]
fn where_its_wheels_stop_it_keeps_its_zones_and_knows_it() {
    let traffic = break_down("stuck_motor", "6s");
    assert_eq!(traffic.outcome, Some(Outcome::TimedOut));
    assert_eq!(traffic.passed(), [0, 3]);
    assert_eq!(traffic.stuck_at_the_end(), [1, 2]);
}

/// Its zones are asked for again once it has been silent for long, and given to those that can pass it.
#[test]
fn where_it_crashes_beyond_them_its_zones_are_used_again() {
    let traffic = break_down("crash", "8s");
    assert_eq!(traffic.passed(), [0, 2, 3]);
    assert!(traffic.stuck_at_the_end().is_empty());
}

/// Robot1 crashes with the zone B and starts again at once: it has forgotten that it holds it, and lets Robot2 have it.
#[test]
fn a_robot_keeps_its_zone_after_a_restart_without_memory() {
    for at in [7300, 7500] {
        let faults = format!(
            "[[fault]]\nat = \"{at}ms\"\nkind = \"crash\"\nrobots = [\"Robot1\"]\n\
             [[fault]]\nat = \"{}ms\"\nkind = \"restart\"\nrobots = [\"Robot1\"]\n",
            at + 270
        );
        let sets = ["positioning.position_noise=0", "motion.speed_noise=0"];
        let traffic = drive("intersection", &sets, &faults);
        let violations = &traffic.violations;
        assert!(violations.is_empty(), "{at} {violations:?}");
        assert_eq!(traffic.passed(), [0, 1, 2, 3], "{at}");
    }
}

/// No car hears another. Robot1's wheels stop when it has excluded the others and may drive: Robot2 waits until its
/// own turn, and Robot1 has given way by then, whenever its wheels are repaired.
#[test]
fn cars_that_do_not_hear_each_other_take_turns() {
    for repaired in 56..=72 {
        let faults = format!(
            "[[fault]]\nat = \"0s\"\nkind = \"partition\"\n\
             groups = [[\"Robot0\"], [\"Robot1\"], [\"Robot2\"], [\"Robot3\"]]\n\
             [[fault]]\nat = \"5.5s\"\nkind = \"stuck_motor\"\nrobots = [\"Robot1\"]\n\
             [[fault]]\nat = \"{repaired}s\"\nkind = \"repair\"\nrobots = [\"Robot1\"]\n"
        );
        let traffic = drive("intersection", &["duration=140s"], &faults);
        let violations = &traffic.violations;
        assert!(violations.is_empty(), "{repaired} {violations:?}");
        assert_eq!(traffic.passed(), [0, 1, 2, 3], "{repaired}");
    }
}
