//! Registration's properties by stories: what keeps them passes, what breaks one is found and named.

use crate::support::{Story, ms, seconds};
use starl_core::{Duration, RobotId, Value};

/// A list in few words: its time in milliseconds, its coordinator, and those in it.
type List<'a> = (u64, u32, &'a [u32]);

fn named((time, coordinator, _): List<'_>) -> [(&'static str, Value); 3] {
    [
        ("time", ms(time).into()),
        ("coordinator", RobotId(coordinator).into()),
        ("incarnation", 7u32.into()),
    ]
}

fn with_members(list: List<'_>) -> [(&'static str, Value); 4] {
    let [time, coordinator, incarnation] = named(list);
    let members: Vec<RobotId> = list.2.iter().map(|&robot| RobotId(robot)).collect();
    [time, coordinator, incarnation, ("members", members.into())]
}

fn registers(story: &mut Story, at: u64, robot: u32) {
    let apart = ("apart", Duration::from_millis(200).seconds().into());
    story.report(at, robot, ("registration", "register"), [apart]);
}

fn leaves(story: &mut Story, at: u64, robot: u32) {
    story.report(at, robot, ("registration", "unregister"), []);
}

fn accepts(story: &mut Story, at: u64, robot: u32, list: List<'_>) {
    if robot == list.1 {
        let fields = with_members(list);
        story.report(at, robot, ("registration", "propose"), fields);
    } else {
        story.report(at, robot, ("registration", "accept"), named(list));
    }
}

fn shows(story: &mut Story, at: u64, robot: u32, list: List<'_>) {
    let fields = with_members(list);
    story.report(at, robot, ("registration", "agree"), fields);
}

/// All in it accept a list, and then show it.
fn agree(story: &mut Story, at: u64, list: List<'_>) {
    for &robot in list.2 {
        accepts(story, at, robot, list);
    }
    for &robot in list.2 {
        shows(story, at + 50, robot, list);
    }
}

/// Three robots with a bound of 5 s, of which so many register.
fn robots(registered: u32) -> Story {
    let mut story = Story::of_ground_robots(3);
    story.setting.properties.registration_bound = seconds(5);
    (0..registered).for_each(|robot| registers(&mut story, 0, robot));
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
fn robots_that_agree_again_keep_all() {
    let mut story = robots(2);
    agree(&mut story, 400, (400, 0, &[0, 1]));
    registers(&mut story, 1000, 2);
    agree(&mut story, 1200, (1200, 0, &[0, 1, 2]));
    leaves(&mut story, 2000, 1);
    agree(&mut story, 2200, (2200, 0, &[0, 2]));
    story.fault(8000, Some(2), "crash");
    agree(&mut story, 9000, (9000, 0, &[0]));
    assert_eq!(properties(&story), [""; 0]);
}

#[test]
fn two_lists_of_one_name() {
    let mut story = robots(2);
    for robot in 0..2 {
        accepts(&mut story, 400, robot, (400, 0, &[0, 1]));
    }
    shows(&mut story, 450, 0, (400, 0, &[0, 1]));
    shows(&mut story, 450, 1, (400, 0, &[1]));
    assert_eq!(properties(&story), ["registration.agreement"]);
}

/// Neither is wrong by itself: the robot is in each list with another of its lives.
#[test]
fn a_robot_in_two_lists_of_one_time() {
    let mut story = robots(2);
    agree(&mut story, 400, (400, 0, &[0, 1]));
    story.fault(1000, Some(1), "crash");
    story.fault(1100, Some(1), "restart");
    registers(&mut story, 1200, 1);
    registers(&mut story, 1200, 2);
    agree(&mut story, 1400, (400, 2, &[1, 2]));
    let expected = ["registration.agreement"; 2];
    assert_eq!(properties(&story)[..2], expected);
    // A list without it may have the same time.
    let mut story = robots(3);
    agree(&mut story, 400, (400, 0, &[0, 1]));
    agree(&mut story, 400, (400, 2, &[2]));
    leaves(&mut story, 500, 2);
    assert_eq!(properties(&story), [""; 0]);
}

#[test]
fn lists_too_near_to_each_other() {
    let mut story = robots(2);
    agree(&mut story, 400, (400, 0, &[0, 1]));
    agree(&mut story, 700, (550, 0, &[0, 1]));
    let expected = ["registration.agreement"; 2];
    assert_eq!(properties(&story), expected);
}

#[test]
fn robots_that_list_each_other_and_differ() {
    let mut story = robots(2);
    agree(&mut story, 400, (400, 0, &[0, 1]));
    // Robot 2 comes, and 1 goes over to a list of which 0 has accepted nothing.
    registers(&mut story, 1000, 2);
    accepts(&mut story, 1200, 1, (1200, 2, &[0, 1, 2]));
    accepts(&mut story, 1200, 2, (1200, 2, &[0, 1, 2]));
    shows(&mut story, 1300, 1, (1200, 2, &[0, 1, 2]));
    let found = properties(&story);
    assert!(
        found.contains(&"registration.soundness".to_string()),
        "{found:?}"
    );
    // Now 0 has accepted it, but continues showing the old one.
    let mut story = robots(3);
    agree(&mut story, 400, (400, 0, &[0, 1, 2]));
    for robot in 0..3 {
        accepts(&mut story, 1200, robot, (1200, 1, &[0, 1, 2]));
    }
    shows(&mut story, 1250, 0, (400, 0, &[0, 1, 2]));
    shows(&mut story, 1300, 1, (1200, 1, &[0, 1, 2]));
    shows(&mut story, 1300, 2, (1200, 1, &[0, 1, 2]));
    let found = properties(&story);
    assert!(
        found.contains(&"registration.exclusion".to_string()),
        "{found:?}"
    );
}

/// A list of a robot's earlier life does not count.
#[test]
fn a_robot_that_restarted_is_another_one() {
    let mut story = robots(2);
    agree(&mut story, 400, (400, 0, &[0, 1]));
    story.fault(2000, Some(1), "crash");
    story.fault(2500, Some(1), "restart");
    registers(&mut story, 2600, 1);
    agree(&mut story, 3000, (3000, 1, &[1]));
    agree(&mut story, 4000, (4000, 0, &[0, 1]));
    assert_eq!(properties(&story), [""; 0]);
}

#[test]
fn a_robot_that_has_not_registered_or_has_left_accepts_nothing() {
    let mut story = robots(1);
    agree(&mut story, 400, (400, 0, &[0, 1]));
    assert_eq!(properties(&story), ["registration.soundness"]);
    let mut story = robots(2);
    leaves(&mut story, 300, 1);
    agree(&mut story, 400, (400, 0, &[0, 1]));
    let found = properties(&story);
    assert_eq!(found, ["registration.soundness"]);
}

#[test]
fn waiting_too_long() {
    let mut story = robots(2);
    agree(&mut story, 400, (400, 0, &[0]));
    let found = story.verdict(15_000);
    let found: Vec<&str> = found.iter().map(|violation| &*violation.property).collect();
    assert_eq!(found, ["registration.convergence", "registration.progress"]);
}

#[test]
fn faults_put_it_off() {
    let mut story = robots(2);
    story.fault(3000, Some(2), "crash");
    story.fault(7000, None, "partition");
    story.fault(11_000, None, "heal");
    agree(&mut story, 15_000, (15_000, 0, &[0, 1]));
    assert_eq!(properties(&story), [""; 0]);
}

#[test]
fn invented_state_is_not_judged() {
    let mut story = robots(2);
    agree(&mut story, 400, (400, 0, &[0, 1]));
    story.fault(1000, Some(1), "corrupt state");
    shows(&mut story, 1100, 1, (999_000, 0, &[1, 2]));
    agree(&mut story, 3000, (3000, 0, &[0, 1]));
    assert_eq!(properties(&story), [""; 0]);
}

#[test]
fn the_time_in_which_all_agreed_does_not_count() {
    let mut story = robots(2);
    agree(&mut story, 400, (400, 0, &[0, 1]));
    // Robot 1 is suspected in error, when the first agreement lies back by almost the bound.
    agree(&mut story, 5400, (5400, 0, &[0]));
    agree(&mut story, 6000, (6000, 0, &[0, 1]));
    assert_eq!(properties(&story), [""; 0]);
}

#[test]
fn a_list_that_names_an_earlier_life_of_a_robot_excludes_nothing() {
    let mut story = robots(2);
    agree(&mut story, 400, (400, 0, &[0, 1]));
    story.fault(1000, Some(0), "crash");
    story.fault(1100, Some(0), "restart");
    registers(&mut story, 1200, 0);
    let next = (1400, 0, &[0, 1][..]);
    (0..2).for_each(|robot| accepts(&mut story, 1400, robot, next));
    shows(&mut story, 1450, 0, next);
    // It hears late that all had accepted the list before.
    shows(&mut story, 1500, 1, (400, 0, &[0, 1]));
    shows(&mut story, 1600, 1, next);
    assert_eq!(properties(&story), [""; 0]);
}
