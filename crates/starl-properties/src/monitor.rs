//! Properties that are judged on the running programs themselves: what records do not show, such as a program's
//! variables.

use super::{Excuse, Violation};
use starl_core::event::Name;
use starl_core::motion::Obstacles;
use starl_core::{Duration, Point, Pose, RobotId, Time, WayPoint};
use std::any::Any;

/// Judges properties of live programs. Traces do not contain its observations, so only a new run can repeat its
/// verdicts.
pub trait Monitor: dyn_clone::DynClone + Send + Sync {
    /// The properties it watches, always in the same order.
    fn properties(&self) -> Vec<Name>;

    /// Observes the state after a step and adds violations to `violations`, each under one of the names of
    /// [`Monitor::properties`].
    fn observe(&mut self, witness: &dyn Witness, violations: &mut Vec<Violation>);

    /// Whether the property with this index among [`Monitor::properties`] is open: its deadline has not passed.
    fn is_open(&self, property: usize) -> bool;

    /// How often something was excused that speaks against the property with this place, by reason.
    fn excused(&self, property: usize) -> Vec<(Excuse, u64)> {
        let _ = property;
        Vec::new()
    }
}

dyn_clone::clone_trait_object!(Monitor);

/// The true state of the run at a moment, as known by the host, independent of the robots' beliefs.
pub trait Witness {
    /// The time.
    fn now(&self) -> Time;

    /// The time since the start or since the last fault began or ended; zero while the network is partitioned, a
    /// motor is stuck or sensors are frozen. A robot that is down counts when it crashes and when it restarts,
    /// not in between.
    fn undisturbed(&self) -> Duration;

    /// How long it is since the start and since a fault last overwrote the state of robots at random.
    fn uncorrupted(&self) -> Duration;

    /// The application's waypoints.
    fn way_points(&self) -> &[WayPoint];

    /// The existing obstacles that all robots know, including the walls around the world.
    fn obstacles(&self) -> Obstacles;

    /// All robots, those that are down included.
    fn robots(&self) -> &[RobotId];

    /// The inspection of a robot's program ([`starl_core::Program::inspect`]); for a robot that is down the last one.
    /// None if it shows nothing, or the robot does not exist.
    fn program(&self, robot: RobotId) -> Option<&dyn Any>;

    /// A robot's true pose; none if there is no such robot.
    fn pose(&self, robot: RobotId) -> Option<Pose>;

    /// A robot's true velocity, metres per second; none if there is no such robot.
    fn velocity(&self, robot: RobotId) -> Option<Point>;

    /// Whether a robot is there and has not crashed.
    fn is_up(&self, robot: RobotId) -> bool;

    /// Whether a robot is up and its program has reached its goal.
    fn has_finished(&self, robot: RobotId) -> bool;
}
