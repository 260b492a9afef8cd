//! Remembers where robots have been, for the picture at the end.

use crate::plot::{Crash, Place, PlotData, RobotPath, Thing};
use crate::report::{Ending, Report};
use starl_core::event::{Fault, Mark};
use starl_core::intervention::NetworkKnob;
use starl_core::{Event, Intervention, Point, Record, Time};
use starl_sim::{Outcome, Scenario};
use std::collections::BTreeMap;

/// The robots' paths so far.
pub struct Paths {
    data: PlotData,
    /// Where each thing of the world is, by its place in the list of the picture; none for one that was removed.
    things: Vec<Option<usize>>,
    /// Robots that are to join, at their starts.
    joining: Vec<RobotPath>,
}

impl Paths {
    /// The world, with every robot at its start.
    pub fn new(scenario: &Scenario) -> Paths {
        let mut robots = Vec::new();
        for group in &scenario.fleet.groups {
            let body = group.model.body();
            for start in &group.starts {
                robots.push(RobotPath {
                    name: scenario
                        .fleet
                        .name(starl_core::RobotId(robots.len() as u32)),
                    model: group.model.name().to_string(),
                    radius: body.radius,
                    flies: body.flies(),
                    detector: group.sensors.detector.map(|detector| detector.range),
                    path: vec![Place {
                        at: Time::ZERO,
                        position: start.position,
                    }],
                    marks: BTreeMap::new(),
                });
            }
        }
        let world = &scenario.world;
        let data = PlotData {
            title: scenario.title.clone(),
            subtitle: String::new(),
            arena: world.bounds.map(|bounds| (bounds.low, bounds.high)),
            obstacles: world
                .obstacles
                .iter()
                .map(|entry| entry.obstacle.clone())
                .collect(),
            way_points: world.way_points.clone(),
            things: (world.things.iter())
                .map(|thing| Thing {
                    name: thing.name.clone(),
                    position: thing.position,
                    is_gone: false,
                })
                .collect(),
            robots,
            collisions: Vec::new(),
            crashes: Vec::new(),
            radio_range: scenario.network.range,
        };
        Paths {
            things: (0..data.things.len()).map(Some).collect(),
            data,
            joining: Vec::new(),
        }
    }

    /// Adds the next record.
    pub fn observe(&mut self, record: &Record) {
        let Some(robot) = record.robot else {
            if let Event::Intervention(what) = &record.event {
                self.steered(record.at, what);
            }
            return;
        };
        let index = robot.index();
        let Some(RobotPath { path, marks, .. }) = self.data.robots.get_mut(index) else {
            if let Event::Moved(pose) = &record.event {
                self.joined(pose.position);
            }
            return;
        };
        let last = path.last().map_or(Point::ZERO, |place| place.position);
        let here = Place {
            at: record.at,
            position: last,
        };
        match &record.event {
            Event::Moved(pose) => {
                // A rest is kept as its first and its last moment.
                if let [.., before, end] = &path[..]
                    && [before.position, end.position] == [pose.position; 2]
                {
                    path.pop();
                }
                path.push(Place {
                    at: record.at,
                    position: pose.position,
                });
            }
            Event::Collided { .. } => self.data.collisions.push(here),
            Event::Fault(Fault::Crash) => self.data.crashes.push(Crash {
                robot: index,
                place: here,
                restarted: None,
            }),
            Event::Fault(Fault::Restart) => {
                let mut crashes = self.data.crashes.iter_mut().rev();
                if let Some(crash) = crashes.find(|crash| crash.robot == index) {
                    crash.restarted = Some(record.at);
                }
            }
            Event::Draw(Mark { label, shape }) => {
                marks.insert(label.to_string(), shape.clone());
            }
            Event::Took(thing) => self.taken(*thing),
            Event::PutDown { thing, position } => self.put_down(*thing, *position),
            _ => {}
        }
    }

    /// A thing is no more where it was.
    fn taken(&mut self, thing: u32) {
        if let Some(&Some(place)) = self.things.get(thing as usize) {
            self.data.things[place].is_gone = true;
        }
    }

    /// A thing is in another place.
    fn put_down(&mut self, thing: u32, position: Point) {
        let Some(Some(place)) = self.things.get_mut(thing as usize) else {
            return;
        };
        let before = &mut self.data.things[*place];
        before.is_gone = true;
        let name = before.name.clone();
        *place = self.data.things.len();
        self.data.things.push(Thing {
            name,
            position,
            is_gone: false,
        });
    }

    /// The index of the thing with this name that has not been removed.
    fn find(&self, name: &str) -> Option<u32> {
        let mut things = self.things.iter();
        let found = things
            .position(|place| place.is_some_and(|place| self.data.things[place].name == name))?;
        Some(found as u32)
    }

    /// The picture shows all places where obstacles and waypoints were.
    fn steered(&mut self, at: Time, what: &Intervention) {
        match what {
            Intervention::AddObstacle { obstacle, .. }
            | Intervention::MoveObstacle { obstacle, .. } => {
                self.data.obstacles.push(obstacle.clone());
            }
            Intervention::SetWayPoint(way_point) => self.data.way_points.push(way_point.clone()),
            Intervention::Join { like, name, pose } => {
                let like = self.data.robots.get(like.index());
                self.joining.extend(like.map(|like| RobotPath {
                    name: name.clone(),
                    model: like.model.clone(),
                    path: vec![Place {
                        at,
                        position: pose.position,
                    }],
                    marks: BTreeMap::new(),
                    ..*like
                }));
            }
            Intervention::SetThing { name, position } => match self.find(name) {
                Some(thing) => self.put_down(thing, *position),
                None => {
                    self.things.push(Some(self.data.things.len()));
                    self.data.things.push(Thing {
                        name: name.clone(),
                        position: *position,
                        is_gone: false,
                    });
                }
            },
            Intervention::RemoveThing { name } => {
                if let Some(thing) = self.find(name) {
                    self.taken(thing);
                    self.things[thing as usize] = None;
                }
            }
            Intervention::Network(knobs) => {
                for knob in knobs {
                    if let NetworkKnob::Range(range) = knob {
                        self.data.radio_range = *range;
                    }
                }
            }
            _ => {}
        }
    }

    /// A robot appears where one was to join.
    fn joined(&mut self, place: Point) {
        let mut joining = self.joining.iter();
        if let Some(found) = joining.position(|robot| robot.path[0].position == place) {
            self.data.robots.push(self.joining.swap_remove(found));
        }
    }

    /// The world with the whole paths and what came of the run.
    pub fn finish(mut self, report: &Report) -> PlotData {
        let outcome = match report.outcome {
            Ending::Over(Outcome::Reached) if report.only_lasts() => "ran to the end,",
            Ending::Over(Outcome::Violated) if report.only_lasts() => {
                "ran to the end, a property violated"
            }
            Ending::Over(Outcome::Reached) => "goal reached",
            Ending::Over(Outcome::Violated) => "goal reached, a property violated",
            Ending::Over(Outcome::TimedOut) => "goal not reached in time",
            Ending::Over(Outcome::Failed) => "failed",
            Ending::Interrupted => "interrupted",
        };
        self.data.subtitle = format!(
            "seed {}, {outcome} after {:.1} s",
            report.seed, report.sim_seconds
        );
        self.data
    }
}
