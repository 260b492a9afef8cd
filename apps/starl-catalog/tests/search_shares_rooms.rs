//! No room is searched by two robots at once, but while the network is parted; none is searched again because the
//! robot that searched it starts again; and robots go to their rooms by short ways.

mod search_support;

use rayon::prelude::*;
use search_support::{Deed, Story, search};
use starl_core::{Duration, Point, RobotId, Time};
use std::collections::BTreeMap;

/// Nobody sees the item, so that all rooms are searched.
const BLIND: &str = "robots.0.sensors.detector.range=1mm";

/// After this time no two robots are in one room.
fn shared_out_after(story: &Story, start: Time) {
    let mut inside: BTreeMap<RobotId, i64> = BTreeMap::new();
    let mut checked = false;
    for &(at, robot, deed, room) in &story.deeds {
        if at > start && !checked {
            checked = true;
            assert!(!inside.is_empty());
        }
        match deed {
            Deed::Enters => inside.insert(robot, room),
            Deed::Searched | Deed::Leaves => inside.remove(&robot),
        };
        let others = inside
            .iter()
            .filter(|(other, theirs)| **other != robot && **theirs == room);
        assert!(
            at <= start || deed != Deed::Enters || others.count() == 0,
            "{at} {robot} {inside:?}"
        );
    }
    assert!(checked);
}

#[test]
fn after_a_partition_no_two_search_one_room() {
    (1..=6).into_par_iter().for_each(|seed: u32| {
        let parted = "[[fault]]\nat = \"1s\"\nkind = \"partition\"\n\
            groups = [[\"searcher0\", \"searcher2\"], [\"searcher1\", \"searcher3\"]]\n\
            [[fault]]\nat = \"30s\"\nkind = \"heal\"\n";
        let story = search("search", &[BLIND, &format!("seed={seed}")], parted);
        assert!(story.violations.is_empty(), "{:?}", story.violations);
        let twice = story.deeds.iter().any(|deed| deed.2 == Deed::Leaves);
        assert!(twice, "{seed}: the parts searched one room");
        shared_out_after(&story, Time::ZERO + Duration::from_seconds(33));
        for room in 1..=6 {
            assert!(story.times_searched(room) >= 1, "{room}");
        }
    });
}

#[test]
fn what_a_robot_searched_before_a_crash_is_not_searched_again() {
    (1..=4).into_par_iter().for_each(|seed: u32| {
        let sets = [BLIND, &*format!("seed={seed}")];
        let calm = search("search", &sets, "");
        let first = calm.deeds.iter().find(|deed| deed.2 == Deed::Searched);
        let &(at, robot, _, room) = first.expect("rooms are searched");
        let crash = |at: f64, kind: &str| {
            format!(
                "[[fault]]\nat = \"{at}s\"\nkind = \"{kind}\"\nrobots = [\"searcher{}\"]\n",
                robot.0
            )
        };
        let at = at.seconds();
        let faults = crash(at + 3.0, "crash") + &crash(at + 6.0, "restart");
        let story = search("search", &sets, &faults);
        assert!(story.violations.is_empty(), "{:?}", story.violations);
        assert_eq!(story.times_searched(room), 1, "{seed}");
    });
}

/// Along a path, metres.
fn length(path: &[Point]) -> f64 {
    path.windows(2).map(|leg| leg[0].distance(leg[1])).sum()
}

/// From the lobby the farthest way to the entrance of a room that is nearest is along the lobby.
#[test]
fn nobody_goes_round_the_building() {
    (1..=4).into_par_iter().for_each(|seed: u32| {
        let sets = ["duration=4s", &*format!("seed={seed}")];
        let story = search("search-building", &sets, "");
        assert!(story.paths.len() >= 10, "{seed}: {}", story.paths.len());
        for (robot, path) in &story.paths {
            assert!(length(path) < 30.0, "{seed} {robot}: {path:?}");
        }
    });
}
