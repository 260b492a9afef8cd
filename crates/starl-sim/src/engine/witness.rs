//! The simulation as monitors of properties see it.

use super::Simulation;
use starl_core::motion::Obstacles;
use starl_core::{Duration, Point, Pose, RobotId, Time, WayPoint};
use starl_properties::Witness;
use std::any::Any;

impl Simulation {
    fn known(&self, robot: RobotId) -> Option<RobotId> {
        (robot.index() < self.robots().len()).then_some(robot)
    }
}

/// The state between two steps; the time is a multiple of the physics step.
impl Witness for Simulation {
    fn now(&self) -> Time {
        self.now()
    }

    fn undisturbed(&self) -> Duration {
        self.undisturbed()
    }

    fn uncorrupted(&self) -> Duration {
        self.uncorrupted()
    }

    fn way_points(&self) -> &[WayPoint] {
        &self.scenario().world.way_points
    }

    fn obstacles(&self) -> Obstacles {
        self.known_obstacles()
    }

    fn robots(&self) -> &[RobotId] {
        self.robots()
    }

    fn program(&self, robot: RobotId) -> Option<&dyn Any> {
        self.program(self.known(robot)?).inspect()
    }

    fn pose(&self, robot: RobotId) -> Option<Pose> {
        Some(self.state(self.known(robot)?).pose)
    }

    fn velocity(&self, robot: RobotId) -> Option<Point> {
        Some(self.state(self.known(robot)?).twist.linear)
    }

    fn is_up(&self, robot: RobotId) -> bool {
        self.known(robot).is_some_and(|robot| self.is_up(robot))
    }

    fn has_finished(&self, robot: RobotId) -> bool {
        self.known(robot)
            .is_some_and(|robot| self.has_finished(robot))
    }
}
