//! The machine's host on a robot.

use super::atomic::Script;
use super::context::Context;
use super::failure::Failure;
use super::primitives::Slot;

/// A robot as the machine sees it.
pub struct RobotHost<'a, 'r> {
    /// The context of functions.
    pub context: Context<'a, 'r>,
    /// The bound primitives.
    pub bound: &'a mut [Slot],
    /// Why the program cannot continue, once it has said so.
    pub failure: Option<Failure>,
    /// Whether an action has fired.
    pub has_fired: bool,
    /// The treatment of calls.
    pub script: Script,
}
