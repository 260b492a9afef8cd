//! Remembers where robots have been, for the picture at the end.

use crate::plot::{PlotData, RobotPath};
use crate::report::{Ending, Report};
use starl_core::event::Mark;
use starl_core::{Event, Point, Record};
use starl_sim::{Outcome, Scenario};
use std::collections::BTreeMap;

/// The robots' paths so far.
pub struct Paths(PlotData);

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
        Paths(PlotData {
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
        })
    }

    /// Takes in what happened next.
    pub fn observe(&mut self, record: &Record) {
        let Some(robot) = record.robot else { return };
        let Some(RobotPath { path, marks, .. }) = self.0.robots.get_mut(robot.index()) else {
            return;
        };
        let last = path.last().copied().unwrap_or(Point::ZERO);
        match &record.event {
            Event::Moved(pose) if pose.position != last => path.push(pose.position),
            Event::Collided { .. } => self.0.collisions.push(last),
            Event::Draw(Mark { label, shape }) => {
                marks.insert(label.to_string(), shape.clone());
            }
            _ => {}
        }
    }

    /// The world with the whole paths and what came of the run.
    pub fn finish(mut self, report: &Report) -> PlotData {
        let outcome = match report.outcome {
            Ending::Over(Outcome::Reached) => "goal reached",
            Ending::Over(Outcome::Violated) => "goal reached, a property violated",
            Ending::Over(Outcome::TimedOut) => "goal not reached in time",
            Ending::Over(Outcome::Failed) => "failed",
            Ending::Interrupted => "interrupted",
        };
        self.0.subtitle = format!(
            "seed {}, {outcome} after {:.1} s",
            report.seed, report.sim_seconds
        );
        self.0
    }
}
