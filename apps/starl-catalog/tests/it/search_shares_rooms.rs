//! No two robots search one room, except during a partition; no room is searched again because its robot restarts; and
//! robots take short paths to their rooms.

use crate::support::Case;
use rayon::prelude::*;
use starl_core::event::{PrimitiveEvent, ReachAvoidEvent};
use starl_core::{Duration, Event, Point, RobotId, Time, Value};
use std::collections::BTreeMap;

/// No robot sees the item, so all rooms are searched.
const BLIND: &[&str] = &["robots.0.sensors.detector.range=1mm"];

/// A robot's action on a room.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Deed {
    Enters,
    Searched,
    Leaves,
}

/// The result of a run.
#[derive(Debug, Default)]
struct Story {
    /// The actions of robots on rooms, with their times.
    deeds: Vec<(Time, RobotId, Deed, i64)>,
    /// The paths that were planned.
    paths: Vec<(RobotId, Vec<Point>)>,
}

impl Story {
    /// The result of a case without failures.
    fn of(case: Case) -> Story {
        let mut run = case.start();
        let mut story = Story::default();
        while !run.is_over() {
            for record in run.step() {
                if let Some(robot) = record.robot {
                    story.note(record.at, robot, &record.event);
                }
            }
        }
        assert!(run.violations().is_empty(), "{:?}", run.violations());
        assert!(run.failures().is_empty(), "{:?}", run.failures());
        story
    }

    fn note(&mut self, at: Time, robot: RobotId, event: &Event) {
        match event {
            Event::Program { name, fields } => {
                let deed = match &**name {
                    "enters" => Deed::Enters,
                    "searched" => Deed::Searched,
                    "leaves" => Deed::Leaves,
                    _ => return,
                };
                if let Some((_, Value::Int(room))) = fields.first() {
                    self.deeds.push((at, robot, deed, *room));
                }
            }
            Event::Primitive {
                event: PrimitiveEvent::ReachAvoid(ReachAvoidEvent::Path { path }),
                ..
            } => self.paths.push((robot, path.clone())),
            _ => {}
        }
    }

    /// How often a room has been searched to its end.
    fn times_searched(&self, room: i64) -> usize {
        let searched = |deed: &&(_, _, Deed, i64)| deed.2 == Deed::Searched && deed.3 == room;
        self.deeds.iter().filter(searched).count()
    }

    /// Robots that enter a room in which another is, or that was assigned to another, after a time.
    fn intruders(&self, after: Time) -> Vec<(Time, RobotId, i64)> {
        let mut inside: BTreeMap<RobotId, i64> = BTreeMap::new();
        let mut intruders = Vec::new();
        for &(at, robot, deed, room) in &self.deeds {
            inside.remove(&robot);
            if deed == Deed::Enters {
                if at > after && inside.values().any(|theirs| *theirs == room) {
                    intruders.push((at, robot, room));
                }
                inside.insert(robot, room);
            }
        }
        intruders
    }
}

/// A fault that concerns one robot.
fn fault(at: f64, kind: &str, robot: RobotId) -> String {
    let name = robot.0;
    format!("[[fault]]\nat = \"{at}s\"\nkind = \"{kind}\"\nrobots = [\"searcher{name}\"]\n")
}

#[test]
fn after_a_partition_no_two_search_one_room() {
    (1..=6).into_par_iter().for_each(|seed| {
        let parted = "[[fault]]\nat = \"1s\"\nkind = \"partition\"\n\
            groups = [[\"searcher0\", \"searcher2\"], [\"searcher1\", \"searcher3\"]]\n\
            [[fault]]\nat = \"30s\"\nkind = \"heal\"\n";
        let story = Story::of(Case {
            faults: parted,
            ..Case::new("search", BLIND, seed)
        });
        let leaves = story.deeds.iter().any(|deed| deed.2 == Deed::Leaves);
        assert!(leaves, "{seed}: the two parts searched one room");
        let healed = Time::ZERO + Duration::from_seconds(33);
        assert_eq!(story.intruders(healed), [], "{seed}");
        assert!((1..=6).all(|room| story.times_searched(room) >= 1));
    });
}

#[test]
fn rooms_searched_before_a_crash_are_not_searched_again() {
    (1..=4).into_par_iter().for_each(|seed| {
        let case = Case::new("search", BLIND, seed);
        let calm = Story::of(case);
        let first = calm.deeds.iter().find(|deed| deed.2 == Deed::Searched);
        let &(at, robot, _, room) = first.expect("rooms are searched");
        let at = at.seconds();
        let faults = fault(at + 3.0, "crash", robot) + &fault(at + 6.0, "restart", robot);
        let story = Story::of(Case {
            faults: &faults,
            ..case
        });
        assert_eq!(story.times_searched(room), 1, "{seed}");
    });
}

/// The lobby is 20 m long, and the rooms that are given out first are the nearest to it.
#[test]
fn no_robot_drives_round_the_building() {
    (1..=4).into_par_iter().for_each(|seed| {
        let story = Story::of(Case::new("search-building", &["duration=4s"], seed));
        assert!(story.paths.len() >= 10, "{seed}: {}", story.paths.len());
        for (robot, path) in &story.paths {
            let length: f64 = path.windows(2).map(|leg| leg[0].distance(leg[1])).sum();
            assert!(length < 30.0, "{seed} {robot}: {path:?}");
        }
    });
}
