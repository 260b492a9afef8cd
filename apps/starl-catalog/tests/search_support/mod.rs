//! Runs of the search: what its robots did, read from the records.

#![allow(dead_code, reason = "each test uses a part of it")]

use starl_catalog::examples;
use starl_core::{Event, Point, RobotId, Time, Value};
use starl_sim::Run;
use starl_sim::read::{Override, Request, Source};

/// What a robot did about a room.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Deed {
    Enters,
    Searched,
    Leaves,
}

/// What came of a run.
#[derive(Debug, Default)]
pub struct Story {
    /// Who did what about which room, in the order of the times.
    pub deeds: Vec<(Time, RobotId, Deed, i64)>,
    /// The paths that were planned, from where the robot stood.
    pub paths: Vec<(RobotId, Vec<Point>)>,
    /// What went wrong.
    pub violations: Vec<String>,
}

/// Runs an example of this name with settings and faults (the text of a file).
pub fn search(example: &str, sets: &[&str], faults: &str) -> Story {
    let example = examples::find(example).expect("it is an example");
    let request = Request {
        overrides: sets.iter().map(|set| Override::set(set).unwrap()).collect(),
        faults: (!faults.is_empty()).then(|| Source::new("faults.toml", faults)),
        ..Request::new(example.source())
    };
    let mut run = starl_catalog::read(&request, example)
        .unwrap()
        .run()
        .unwrap();
    let mut story = Story::default();
    while !run.is_over() {
        for record in run.step() {
            if let Some(robot) = record.robot {
                story.note(record.at, robot, &record.event);
            }
        }
    }
    story.conclude(&run);
    story
}

impl Story {
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
            Event::Primitive { name, fields, .. } if &**name == "path" => {
                if let Some((_, Value::Path(path))) = fields.first() {
                    self.paths.push((robot, path.to_vec()));
                }
            }
            _ => {}
        }
    }

    fn conclude(&mut self, run: &Run) {
        self.violations = run
            .violations()
            .iter()
            .map(|violation| format!("{violation:?}"))
            .collect();
        let failures = run.failures().iter();
        self.violations
            .extend(failures.map(|failure| format!("{failure:?}")));
    }

    /// How often a room has been searched to its end.
    pub fn times_searched(&self, room: i64) -> usize {
        let deeds = self.deeds.iter();
        deeds
            .filter(|deed| deed.2 == Deed::Searched && deed.3 == room)
            .count()
    }
}
