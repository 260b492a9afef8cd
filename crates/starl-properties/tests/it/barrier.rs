//! Barrier's properties by stories: what keeps them passes, what breaks one is found and named.

use crate::support::{Story, seconds};
use starl_core::{RobotId, Value};

fn participants(robots: u32) -> (&'static str, Value) {
    let all: Vec<RobotId> = (0..robots).map(RobotId).collect();
    ("participants", all.into())
}

fn arrives(story: &mut Story, at: u64, robot: u32, generation: Option<u32>) {
    story.report(at, robot, ("barrier", "arrive"), [participants(3)]);
    if let Some(generation) = generation {
        waits(story, at, robot, generation);
    }
}

fn waits(story: &mut Story, at: u64, robot: u32, generation: u32) {
    let generation = ("generation", generation.into());
    story.report(at, robot, ("barrier", "wait"), [generation]);
}

fn passes(story: &mut Story, at: u64, robot: u32, generation: u32) {
    passes_with(story, at, robot, generation, 3);
}

/// Passes with so many participants.
fn passes_with(story: &mut Story, at: u64, robot: u32, generation: u32, robots: u32) {
    let fields = [("generation", generation.into()), participants(robots)];
    story.report(at, robot, ("barrier", "pass"), fields);
}

/// Three robots and a bound of 5 s; they cross the first generation.
fn robots() -> Story {
    let mut story = Story::of_ground_robots(3);
    story.setting.properties.barrier_bound = seconds(5);
    for robot in 0..3 {
        arrives(&mut story, 100, robot, None);
    }
    for robot in 0..3 {
        waits(&mut story, 200, robot, 1);
        passes(&mut story, 300 + u64::from(robot), robot, 1);
    }
    story
}

fn properties(story: &Story) -> Vec<String> {
    let found = story.verdict(30_000);
    found
        .iter()
        .map(|violation| violation.property.to_string())
        .collect()
}

#[test]
fn robots_that_wait_for_each_other_satisfy_all_properties() {
    let mut story = robots();
    for robot in 0..3 {
        arrives(&mut story, 1000 * u64::from(robot + 1), robot, Some(2));
    }
    for robot in 0..3 {
        passes(&mut story, 3100, robot, 2);
    }
    assert_eq!(properties(&story), [""; 0]);
}

#[test]
fn passing_too_early_is_found() {
    let mut story = robots();
    arrives(&mut story, 1000, 0, Some(2));
    arrives(&mut story, 1000, 1, Some(2));
    passes(&mut story, 1500, 0, 2);
    assert_eq!(properties(&story), ["barrier.safety"]);
}

#[test]
fn a_robot_that_joins_arrives_at_the_next_generation() {
    let mut story = robots();
    (0..3).for_each(|robot| arrives(&mut story, 1000, robot, Some(2)));
    let mut early = story.clone();
    passes(&mut story, 1500, 1, 2);
    passes(&mut story, 1500, 2, 2);
    // Robot 3 has joined, and robot 0 hears that others have passed.
    passes_with(&mut story, 2500, 0, 2, 4);
    assert_eq!(properties(&story), [""; 0]);
    // It joins before any robot passes.
    passes_with(&mut early, 2500, 0, 2, 4);
    assert_eq!(properties(&early), ["barrier.safety"]);
}

#[test]
fn passing_the_same_twice_is_found() {
    let mut story = robots();
    arrives(&mut story, 1000, 0, Some(1));
    passes(&mut story, 1500, 0, 1);
    assert_eq!(properties(&story), ["barrier.safety"]);
}

#[test]
fn a_robot_that_arrived_and_crashed_has_arrived() {
    let mut story = robots();
    arrives(&mut story, 1000, 2, Some(2));
    story.fault(1200, Some(2), "crash");
    arrives(&mut story, 2000, 0, Some(2));
    arrives(&mut story, 2000, 1, Some(2));
    passes(&mut story, 2100, 0, 2);
    passes(&mut story, 2100, 1, 2);
    assert_eq!(properties(&story), [""; 0]);
}

#[test]
fn a_restarted_robot_arrives_before_it_knows_the_generation() {
    let mut story = robots();
    story.fault(1000, Some(2), "crash");
    story.fault(1500, Some(2), "restart");
    arrives(&mut story, 2000, 0, Some(2));
    arrives(&mut story, 2000, 1, Some(2));
    arrives(&mut story, 3000, 2, None);
    passes(&mut story, 3100, 0, 2);
    waits(&mut story, 3200, 2, 2);
    passes(&mut story, 3200, 2, 2);
    passes(&mut story, 3200, 1, 2);
    assert_eq!(properties(&story), [""; 0]);
}

#[test]
fn generations_restart_when_all_have_crashed() {
    let mut story = robots();
    for robot in 0..3 {
        story.fault(1000, Some(robot), "crash");
        story.fault(1500, Some(robot), "restart");
    }
    arrives(&mut story, 2000, 0, Some(1));
    passes(&mut story, 2100, 0, 1);
    assert_eq!(properties(&story), ["barrier.safety"]);
}

#[test]
fn waiting_too_long_is_found() {
    let mut story = robots();
    for robot in 0..3 {
        arrives(&mut story, 1000, robot, Some(2));
    }
    passes(&mut story, 1100, 0, 2);
    assert_eq!(properties(&story), ["barrier.progress"]);
}

#[test]
fn progress_is_not_required_while_a_robot_is_missing_or_down() {
    let mut story = robots();
    arrives(&mut story, 1000, 0, Some(2));
    arrives(&mut story, 1000, 1, Some(2));
    assert_eq!(properties(&story), [""; 0]);
    arrives(&mut story, 2000, 2, Some(2));
    story.fault(2100, Some(2), "crash");
    assert_eq!(properties(&story), [""; 0]);
}
