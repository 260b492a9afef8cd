//! The inputs of state machines.

use crate::motion::Path;
use crate::{Message, Order, RobotId, TimerKey};
use serde::{Deserialize, Serialize};

/// The inputs of a state machine. The robot's knowledge at that moment is in its [`crate::View`], so
/// a recorded sequence of views and inputs serves as a log, a replay and a test.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Input {
    /// The robot starts, or starts again after a crash.
    Start,
    /// A control period has passed.
    Activate,
    /// The view holds a new position estimate.
    Estimate,
    /// A message arrived.
    Message(Message),
    /// A timer fired.
    Timer(TimerKey),
    /// A planner answers [`crate::MotionRequest::Plan`].
    Planned {
        /// The request's.
        ticket: u32,
        /// Waypoints from the robot to the target; none where the planner gave up.
        path: Option<Path>,
    },
    /// The program's failure detector suspects that a robot has failed; it may be wrong. When a restart is detected,
    /// the robot is suspected and immediately trusted again, because it has lost its state.
    Suspected(RobotId),
    /// The program's failure detector trusts a robot again.
    Trusted(RobotId),
    /// An operator sends an order to the program, or its waypoints have changed ([`Order::WAY_POINTS`]).
    Order(Order),
    /// The robot has long been pushed harder than its drive can hold against, as a drone by strong wind, while
    /// it tracks a waypoint.
    Overpowered,
}
