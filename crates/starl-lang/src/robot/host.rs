//! The machine's host on a robot.

use super::atomic::Script;
use super::context::Context;
use super::failure::Failure;
use super::primitives::Slot;

/// A robot as the machine sees it.
pub struct RobotHost<'a, 'r> {
    pub context: Context<'a, 'r>,
    pub bound: &'a mut [Slot],
    /// Why the program cannot continue, once it has said so.
    pub failure: Option<Failure>,
    /// Whether an action has fired.
    pub has_fired: bool,
    /// The treatment of calls.
    pub script: Script,
}

impl<'a, 'r> RobotHost<'a, 'r> {
    /// A host on which nothing has happened.
    pub fn new(
        context: Context<'a, 'r>,
        bound: &'a mut [Slot],
        script: Script,
    ) -> RobotHost<'a, 'r> {
        RobotHost {
            context,
            bound,
            failure: None,
            has_fired: false,
            script,
        }
    }
}
