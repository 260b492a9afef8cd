//! What a program claims of itself, judged on the true state of affairs.
//!
//! A [`Judge`] is shown the fleet again and again, as often as its state changes, and says what does
//! not hold. It knows no simulator: a [`Fleet`] is whatever can tell the robots' variables and poses.
//!
//! Meaning, with the moments at which the judge is shown the fleet for time:
//! - `always p` holds if p is true at every moment;
//! - `eventually p within d` if p is true at some moment no later than d after the start;
//! - `eventually always p within d` if p is true at every moment later than d after the start;
//! - `always p leads_to q within d` if for each moment at which p is true there is one, the same or a
//!   later one but by no more than d, at which q is true.
//!
//! Faults are allowed for, unless the property says otherwise: times count from the last fault too; robots that are
//! down do not count, nor where something is to come those that a wreck keeps from their target; variables are not
//! judged in the time after a fault has overwritten some ([`RECOVERY`]); and nothing is judged where what the property
//! assumes is not so.
//!
//! Without `within` nothing is ever too late, so that what has not come stays open. A property about
//! each robot, each two robots and so on is judged for each such row of robots by itself, the rows in
//! which a robot occurs twice included, and is reported once for each for which it does not hold.
//! Robots count from when their programs have started.

mod condition;
mod docket;
mod hearing;
mod judge;
mod observables;
mod violation;

pub use condition::Condition;
pub use judge::{Judge, Standing};
pub(super) use observables::{OBSERVABLES, Run};
pub use violation::{Reason, Violation};

use crate::machine::State;
use starl_core::motion::Obstacles;
use starl_core::{Duration, Point, Pose, RobotId, WayPoint};

/// Why a property may be false.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Excuse {
    /// A robot is down, or one that is down keeps it from its target.
    Down,
    /// A fault has just overwritten variables.
    Corruption,
    /// A fault came so shortly before that the time since is not up.
    Recovery,
    /// The property assumes something that is not so.
    Assumption,
}

/// So long after a fault has overwritten variables a property of them is not judged, unless it says otherwise: each
/// robot is activated meanwhile, finds that a check is false, and starts again.
pub const RECOVERY: Duration = Duration::from_seconds(1);

/// The true state of robots that run a program.
pub trait Fleet {
    /// The robots that run the program, in ascending order.
    fn robots(&self) -> &[RobotId];

    /// The variables of a robot; of one that is down what they were last. None if it has not started,
    /// or does not run the program.
    fn state_of(&self, robot: RobotId) -> Option<&State>;

    /// A number that is another one whenever a robot's variables have other values, if there is such a
    /// number: robots of whom nothing has changed need not be judged anew.
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

    /// How long it is since the start and since the last fault began or was mended; for ever where that is not known.
    fn undisturbed(&self) -> Duration {
        Duration(u64::MAX)
    }

    /// How long it is since the start and since a fault last overwrote the state of robots; for ever where that is not
    /// known.
    fn uncorrupted(&self) -> Duration {
        Duration(u64::MAX)
    }

    /// Where a robot's motion leads, or led last, if that is known.
    fn target(&self, robot: RobotId) -> Option<Point> {
        let _ = robot;
        None
    }

    /// All robots of the application; none if they are those of [`Fleet::robots`].
    fn everyone(&self) -> Option<&[RobotId]> {
        None
    }

    /// The application's way-points, if they are known here.
    fn way_points(&self) -> Option<&[WayPoint]> {
        None
    }

    /// The obstacles of the world, if they are known here.
    fn obstacles(&self) -> Option<Obstacles> {
        None
    }
}
