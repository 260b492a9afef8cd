//! The subject of an exploration: a small fleet of robots that stand still.

use starl_core::motion::{Body, Obstacles, Workspace};
use starl_core::{Point, Port, Pose, Program, RobotId, WayPoint};
use std::collections::BTreeSet;

/// A fleet and its knowledge. All robots have started when an exploration begins.
#[derive(Clone)]
pub struct Model {
    /// The robots, by number.
    pub members: Vec<Member>,
    /// The application's waypoints.
    pub way_points: Vec<WayPoint>,
    /// The obstacles that all know.
    pub obstacles: Obstacles,
    /// Decides the robots' random streams.
    pub seed: u64,
    /// Endpoints whose timers never fire, such as those of failure detectors: their verdicts are explored instead of
    /// their heartbeats.
    pub silent: BTreeSet<Port>,
    /// Whether robots have storage that survives a crash.
    pub keeps_storage: bool,
    /// Whether all robots must finish: a state without a next step is then a violation, unless all have finished.
    pub all_finish: bool,
}

/// One robot.
#[derive(Clone)]
pub struct Member {
    /// Its program.
    pub program: Box<dyn Program>,
    /// Where it stands.
    pub pose: Pose,
    /// The space that it takes.
    pub body: Body,
}

impl Model {
    /// Robots with these programs, a metre apart on an empty floor.
    pub fn new(programs: Vec<Box<dyn Program>>) -> Model {
        let member = |(index, program): (usize, Box<dyn Program>)| Member {
            program,
            pose: Pose::level(Point::planar(index as f64, 0.0), 0.0),
            body: Body {
                radius: 0.1,
                height: 0.2,
                workspace: Workspace::Ground,
            },
        };
        Model {
            members: programs.into_iter().enumerate().map(member).collect(),
            way_points: Vec::new(),
            obstacles: [].into(),
            seed: 1,
            silent: BTreeSet::new(),
            keeps_storage: false,
            all_finish: false,
        }
    }

    /// The robots' numbers.
    pub fn fleet(&self) -> Vec<RobotId> {
        (0..self.members.len() as u32).map(RobotId).collect()
    }
}
