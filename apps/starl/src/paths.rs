//! Remembers where robots have been, for the picture at the end.

use crate::plot::{PlotData, RobotPath};
use crate::report::{Ending, Report};
use starl_core::event::Mark;
use starl_core::{Event, Intervention, Point, Record};
use starl_sim::{Outcome, Scenario};
use std::collections::BTreeMap;

/// The robots' paths so far.
pub struct Paths {
    data: PlotData,
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
                    path: vec![start.position],
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
            robots,
            collisions: Vec::new(),
        };
        let joining = Vec::new();
        Paths { data, joining }
    }

    /// Takes in what happened next.
    pub fn observe(&mut self, record: &Record) {
        let Some(robot) = record.robot else {
            if let Event::Intervention(what) = &record.event {
                self.steered(what);
            }
            return;
        };
        let Some(RobotPath { path, marks, .. }) = self.data.robots.get_mut(robot.index()) else {
            if let Event::Moved(pose) = &record.event {
                self.joined(pose.position);
            }
            return;
        };
        let last = path.last().copied().unwrap_or(Point::ZERO);
        match &record.event {
            Event::Moved(pose) if pose.position != last => path.push(pose.position),
            Event::Collided { .. } => self.data.collisions.push(last),
            Event::Draw(Mark { label, shape }) => {
                marks.insert(label.to_string(), shape.clone());
            }
            _ => {}
        }
    }

    /// The picture shows all places where obstacles and waypoints were.
    fn steered(&mut self, what: &Intervention) {
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
                    path: vec![pose.position],
                    marks: BTreeMap::new(),
                    ..*like
                }));
            }
            _ => {}
        }
    }

    /// A robot appears where one was to join.
    fn joined(&mut self, place: Point) {
        let mut joining = self.joining.iter();
        if let Some(found) = joining.position(|robot| robot.path.first() == Some(&place)) {
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
