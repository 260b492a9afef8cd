//! The fleet whose properties are judged.

use crate::machine::State;
use starl_core::motion::Obstacles;
use starl_core::{Duration, Point, Pose, RobotId, WayPoint};
use starl_primitives::SharedMemory;

/// The true state of robots that run a program.
pub trait Fleet {
    /// The robots that run the program, in ascending order.
    fn robots(&self) -> &[RobotId];

    /// The variables of a robot; for one that is down, its last variables. None if it has not started or does not run
    /// the program.
    fn state_of(&self, robot: RobotId) -> Option<&State>;

    /// The robot's copies of the program's shared variables; none if they are not known here.
    fn memory(&self, robot: RobotId) -> Option<&SharedMemory> {
        let _ = robot;
        None
    }

    /// A number that changes whenever the robot's variables change, if there is one: a robot whose number is unchanged
    /// need not be judged again.
    fn version(&self, robot: RobotId) -> Option<u64> {
        let _ = robot;
        None
    }

    /// A robot's true pose; none if there is no such robot.
    fn pose(&self, robot: RobotId) -> Option<Pose>;

    /// A robot's true velocity, metres per second; none if there is no such robot.
    fn velocity(&self, robot: RobotId) -> Option<Point>;

    /// Whether a robot's program has reached its goal.
    fn has_finished(&self, robot: RobotId) -> bool;

    /// Whether a robot is there and has not crashed.
    fn is_up(&self, robot: RobotId) -> bool;

    /// The time since the latest of the start and the last beginning or end of a fault; unlimited if unknown.
    fn undisturbed(&self) -> Duration {
        Duration(u64::MAX)
    }

    /// The time since the start or since a fault last overwrote the state of robots; unlimited if unknown.
    fn uncorrupted(&self) -> Duration {
        Duration(u64::MAX)
    }

    /// The target of a robot's present or last motion, if known.
    fn target(&self, robot: RobotId) -> Option<Point> {
        let _ = robot;
        None
    }

    /// All robots of the application; none if they are those of [`Fleet::robots`].
    fn everyone(&self) -> Option<&[RobotId]> {
        None
    }

    /// The application's waypoints, if known.
    fn way_points(&self) -> Option<&[WayPoint]> {
        None
    }

    /// The obstacles of the world, if they are known here.
    fn obstacles(&self) -> Option<Obstacles> {
        None
    }
}
