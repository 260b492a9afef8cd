//! Judges the properties of a program on the true state of the fleet.
//!
//! A [`Judge`] is shown the fleet whenever its state changes, and returns the violations. It does not depend on a
//! simulator: a [`Fleet`] is any source of the robots' variables and poses.
//!
//! Meaning, with the moments at which the judge is shown the fleet for time:
//! - `always p` holds if p is true at every moment;
//! - `eventually p within d` if p is true at some moment no later than d after the start;
//! - `eventually always p within d` if p is true at every moment later than d after the start;
//! - `always p leads_to q within d` if for each moment at which p is true there is one, the same or a
//!   later one but by no more than d, at which q is true.
//!
//! Faults are excused unless the property says otherwise. Deadlines count from the last fault. Robots that are down are
//! not judged; a robot whose target is blocked by a wreck does not have to reach it. Variables are not judged for a
//! time after a fault has overwritten some ([`RECOVERY`]). A property is not judged while its assumption does not hold.
//!
//! Without `within` there is no deadline, so that a condition that has not become true stays open. A property of each
//! robot, each pair of robots and so on is judged for each such tuple separately, tuples with a repeated robot
//! included, and is reported once for each tuple that violates it. A robot is judged from the moment its program has
//! started.

mod condition;
mod evaluation;
mod history;
mod judge;
mod observables;
mod reads;
mod shared;
mod violation;

pub use condition::Condition;
pub use judge::{Judge, Standing};
pub(super) use observables::Run;
pub use violation::{Reason, Violation};

use crate::machine::State;
use observables::{OBSERVABLES, Observable};
use shared::SHARED;
use starl_core::motion::Obstacles;
use starl_core::{Duration, Point, Pose, RobotId, WayPoint};
use starl_primitives::SharedMemory;

/// The reason for which a false property is excused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Excuse {
    /// A robot is down, or a wreck keeps it from its target.
    Down,
    /// A fault has just overwritten variables.
    Corruption,
    /// A fault was so recent that the time since has not passed.
    Recovery,
    /// The property's assumption is false.
    Assumption,
}

/// For this time after a fault has overwritten variables, a property of them is not judged, unless it says otherwise.
/// Meanwhile each robot is activated, finds that an invariant of its variables is false, and restarts.
pub const RECOVERY: Duration = Duration::from_seconds(1);

/// All values that properties can read.
pub(super) fn observables() -> impl Iterator<Item = &'static Observable> {
    OBSERVABLES.iter().chain(SHARED)
}

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
