//! The contract of every primitive.

use crate::motion::Path;
use crate::{Message, Order, Port, Robot, RobotId, TimerKey};
use serde::{Deserialize, Serialize};

/// All that can happen to a state machine. What a robot knows at that moment is in its
/// [`crate::View`], so a recorded sequence of views and inputs is at once a log, a replay and a test.
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
        /// Way-points from the robot to the target; none where the planner gave up.
        path: Option<Path>,
    },
    /// The program's failure detector believes that a robot has failed; it may be wrong. A robot that
    /// was noticed to have restarted is suspected and trusted again at once, since it has lost what it
    /// knew.
    Suspected(RobotId),
    /// The program's failure detector trusts a robot again.
    Trusted(RobotId),
    /// An operator tells the program something, or its way-points have changed
    /// ([`Order::WAY_POINTS`]).
    Order(Order),
}

/// A building block of programs: a pure state machine that answers inputs with effects.
///
/// A program owns its primitives as fields, calls their methods, and reads their flags. Inputs reach
/// those that it shows by [`crate::Primitives`]: a message or timer goes to the one primitive whose
/// port it names, every other input to all of them, before the program itself sees it. What a failure
/// detector among them finds out reaches all of them next.
pub trait Primitive {
    /// The endpoint of this instance.
    fn port(&self) -> Port;

    /// Takes an input and pushes effects through the handle.
    fn handle(&mut self, robot: &mut Robot<'_>, input: &Input);

    /// Saves what is to outlast a crash ([`Robot::save`]), if it has changed. Called after each input on robots
    /// with storage, and on no others. What was saved is there at [`Input::Start`].
    fn save(&mut self, robot: &mut Robot<'_>) {
        let _ = robot;
    }
}
