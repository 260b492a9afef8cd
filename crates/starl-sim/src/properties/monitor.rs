//! Properties that are judged on the simulation itself: what records do not show, such as a program's
//! variables.

use super::Violation;
use crate::Scenario;
use crate::engine::Simulation;
use starl_core::event::Name;
use starl_core::motion::Obstacles;
use starl_core::{Duration, Point, Pose, RobotId, Time};
use std::any::Any;

/// Watches properties on a live simulation. A trace does not hold what it sees, so its verdicts come
/// again only by running again.
pub trait Monitor: dyn_clone::DynClone + Send + Sync {
    /// The properties it watches, always in the same order.
    fn properties(&self) -> Vec<Name>;

    /// Takes in the state of affairs after a step; what does not hold is added to `violations`, each
    /// under one of the names of [`Monitor::properties`].
    fn observe(&mut self, witness: &Witness<'_>, violations: &mut Vec<Violation>);

    /// Whether it is still open if the property with this place among [`Monitor::properties`] holds:
    /// it demands something by a time that has not come.
    fn is_open(&self, property: usize) -> bool;
}

dyn_clone::clone_trait_object!(Monitor);

/// The true state of affairs between two steps. Nothing here is as a robot believes it to be.
#[derive(Clone, Copy)]
pub struct Witness<'a> {
    simulation: &'a Simulation,
}

impl<'a> Witness<'a> {
    /// The state of a simulation.
    pub fn new(simulation: &'a Simulation) -> Witness<'a> {
        Witness { simulation }
    }

    /// The time, a multiple of the physics step.
    pub fn now(&self) -> Time {
        self.simulation.now()
    }

    /// How long it is since the start and since the last fault began or was mended; zero while the network is
    /// parted, a motor is stuck or sensors are frozen. A robot that is down disturbs when it crashes and when it
    /// starts again, not in between.
    pub fn undisturbed(&self) -> Duration {
        self.simulation.undisturbed()
    }

    /// How long it is since the start and since a fault last overwrote the state of robots at random.
    pub fn uncorrupted(&self) -> Duration {
        self.simulation.uncorrupted()
    }

    /// What is simulated.
    pub fn scenario(&self) -> &'a Scenario {
        self.simulation.scenario()
    }

    /// The obstacles that stand and that all robots know of, the walls around the world included.
    pub fn obstacles(&self) -> Obstacles {
        self.simulation.known_obstacles()
    }

    /// All robots, those that are down included.
    pub fn robots(&self) -> &'a [RobotId] {
        self.simulation.robots()
    }

    /// The group of a robot, by its place in the fleet; none if there is no such robot.
    pub fn group(&self, robot: RobotId) -> Option<usize> {
        let known = robot.index() < self.robots().len();
        known.then(|| self.simulation.group(robot))
    }

    /// What a robot's program shows ([`starl_core::Program::inspect`]); of one that is down what it
    /// showed last. None if it shows nothing, or there is no such robot.
    pub fn program(&self, robot: RobotId) -> Option<&'a dyn Any> {
        let known = robot.index() < self.robots().len();
        known.then(|| self.simulation.program(robot).inspect())?
    }

    /// A robot's true pose; none if there is no such robot.
    pub fn pose(&self, robot: RobotId) -> Option<Pose> {
        let known = robot.index() < self.robots().len();
        known.then(|| self.simulation.state(robot).pose)
    }

    /// A robot's true velocity, metres per second; none if there is no such robot.
    pub fn velocity(&self, robot: RobotId) -> Option<Point> {
        let known = robot.index() < self.robots().len();
        known.then(|| self.simulation.state(robot).twist.linear)
    }

    /// Whether a robot is there and has not crashed.
    pub fn is_up(&self, robot: RobotId) -> bool {
        self.group(robot).is_some() && self.simulation.is_up(robot)
    }

    /// Whether a robot is up and its program has reached its goal.
    pub fn has_finished(&self, robot: RobotId) -> bool {
        self.group(robot).is_some() && self.simulation.has_finished(robot)
    }
}
