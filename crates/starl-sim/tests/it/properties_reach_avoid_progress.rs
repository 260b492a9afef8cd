//! No ReachAvoid is active for longer than the bound.

use crate::properties_support::{Story, assert_none, assert_only, at, seconds};
use starl_core::Event;

/// A robot is sent out at 1 s and has 5 s.
fn sent_out() -> Story {
    let mut story = Story::of_ground_robots(2);
    story.scenario.properties.progress_bound = seconds(5);
    story.starts(1000, 1, at(3.0, 0.0), &[]);
    story
}

#[test]
fn a_command_that_does_not_end_is_reported_once_when_its_time_is_up() {
    let verdict = sent_out().verdict(60_000);
    assert_only(&verdict, "reach_avoid.progress", 6000, &[1]);
    assert_eq!(
        verdict[0].text,
        "robot 1 was sent to (3.000, 0.000, 0.000) m at 1.000s and was still under way 5s later"
    );
}

#[test]
fn any_end_in_time_will_do_up_to_the_last_moment() {
    for end in ["done", "failed", "give_up", "stop"] {
        let mut story = sent_out();
        // Where it was at the end is another property.
        story.stays(0, 100, 1, at(3.0, 0.0));
        story.ends(6000, 1, end);
        assert_none(&story.verdict(60_000));
        let mut late = sent_out();
        late.stays(5900, 6000, 1, at(3.0, 0.0));
        late.ends(6001, 1, end);
        assert_only(&late.verdict(60_000), "reach_avoid.progress", 6000, &[1]);
    }
}

#[test]
fn a_new_command_has_its_own_time() {
    let mut story = sent_out();
    story.starts(4000, 1, at(0.0, 0.0), &[]);
    assert_only(&story.verdict(60_000), "reach_avoid.progress", 9000, &[1]);
}

#[test]
fn a_bound_that_has_not_run_out_is_not_judged() {
    assert_none(&sent_out().verdict(6000));
}

#[test]
fn robots_that_break_are_excused() {
    for fault in ["crash", "stuck motor", "frozen sensor", "corrupt state"] {
        let mut story = sent_out();
        story.fault(3000, Some(1), fault);
        assert_none(&story.verdict(60_000));
    }
    let mut story = sent_out();
    story.record(3000, Some(1), Event::Failed("lost".into()));
    assert_none(&story.verdict(60_000));
}

#[test]
fn a_robot_that_restarts_is_watched_again() {
    let mut story = sent_out();
    story.fault(3000, Some(1), "crash");
    story.fault(4000, Some(1), "restart");
    story.starts(5000, 1, at(0.0, 0.0), &[]);
    assert_only(&story.verdict(60_000), "reach_avoid.progress", 10_000, &[1]);
}
