//! The robots of a test's world as an observer of their properties sees them.

use super::World;
use starl_core::{Duration, Point, Pose, RobotId};
use starl_lang::machine::State;
use starl_lang::robot::RobotProgram;
use starl_lang::robot::properties::Fleet;
use starl_primitives::SharedMemory;

/// A world, and the numbers of its robots.
pub struct Seen<'a> {
    pub world: &'a World,
    pub robots: Vec<RobotId>,
    /// The time since a fault last overwrote the state of robots.
    pub uncorrupted: Duration,
}

impl Seen<'_> {
    pub fn new(world: &World) -> Seen<'_> {
        let robots = (0..world.robots.len() as u32).map(RobotId).collect();
        Seen {
            world,
            robots,
            uncorrupted: Duration(u64::MAX),
        }
    }

    fn program(&self, robot: RobotId) -> Option<&RobotProgram> {
        let is_known = robot.index() < self.robots.len();
        is_known.then(|| self.world.program(robot.index()))
    }
}

impl Fleet for Seen<'_> {
    fn robots(&self) -> &[RobotId] {
        &self.robots
    }

    fn state_of(&self, robot: RobotId) -> Option<&State> {
        self.program(robot).map(RobotProgram::state)
    }

    fn memory(&self, robot: RobotId) -> Option<&SharedMemory> {
        self.program(robot).and_then(RobotProgram::memory)
    }

    fn version(&self, robot: RobotId) -> Option<u64> {
        self.program(robot).map(RobotProgram::version)
    }

    fn pose(&self, robot: RobotId) -> Option<Pose> {
        self.program(robot)?;
        let position = self.world.position(robot.index());
        Some(Pose {
            position,
            ..Pose::default()
        })
    }

    fn velocity(&self, robot: RobotId) -> Option<Point> {
        self.program(robot).map(|_| Point::ZERO)
    }

    fn has_finished(&self, robot: RobotId) -> bool {
        let unit = self.world.robots.get(robot.index());
        unit.is_some_and(|unit| unit.node.condition().finished)
    }

    fn uncorrupted(&self) -> Duration {
        self.uncorrupted
    }

    fn is_up(&self, robot: RobotId) -> bool {
        let unit = self.world.robots.get(robot.index());
        unit.is_some_and(|unit| !unit.node.condition().down)
    }
}
