//! Properties of single states.

use crate::robot::{Local, Surroundings};
use starl_core::motion::Obstacles;
use starl_core::{Pose, RobotId, Time, WayPoint};
use starl_properties::Violation;
use std::any::Any;

/// Judges single states, independent of their paths.
pub trait Invariant: dyn_clone::DynClone + Send + Sync {
    /// Adds what does not hold.
    fn judge(&self, scene: &Scene<'_>, violations: &mut Vec<Violation>);
}

dyn_clone::clone_trait_object!(Invariant);

/// A state of the fleet. Nothing here is as a robot believes it to be.
pub struct Scene<'a> {
    pub(crate) locals: Vec<&'a Local>,
    pub(crate) surroundings: &'a Surroundings,
}

impl<'a> Scene<'a> {
    /// The latest that any clock shows.
    pub fn now(&self) -> Time {
        let ticks = self.locals.iter().map(|local| local.clock).max();
        self.surroundings.time(ticks.unwrap_or_default())
    }

    /// All robots.
    pub fn robots(&self) -> &'a [RobotId] {
        &self.surroundings.fleet
    }

    /// The inspection of a robot's program ([`starl_core::Program::inspect`]); none for a robot that
    /// is down.
    pub fn program(&self, robot: RobotId) -> Option<&'a dyn Any> {
        let local = *self.locals.get(robot.index())?;
        local.is_up().then(|| local.node.program().inspect())?
    }

    /// Whether a robot is up.
    pub fn is_up(&self, robot: RobotId) -> bool {
        let local = self.locals.get(robot.index());
        local.is_some_and(|local| local.is_up())
    }

    /// Whether a robot is up and its program has reached its goal.
    pub fn has_finished(&self, robot: RobotId) -> bool {
        let local = self.locals.get(robot.index());
        local.is_some_and(|local| local.node.condition().has_finished())
    }

    /// Where a robot stands.
    pub fn pose(&self, robot: RobotId) -> Option<Pose> {
        let member = self.surroundings.model.members.get(robot.index())?;
        Some(member.pose)
    }

    /// The application's waypoints.
    pub fn way_points(&self) -> &'a [WayPoint] {
        &self.surroundings.model.way_points
    }

    /// The obstacles.
    pub fn obstacles(&self) -> Obstacles {
        self.surroundings.model.obstacles.clone()
    }
}
