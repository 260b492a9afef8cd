//! One environment as expressions ask about it: a state of variables for each robot, and the robots themselves.

use starl_core::RobotId;
use starl_lang::machine::{Host, HostCall, List, Object, State};
use std::borrow::Cow;

/// The machine's host.
pub struct EnvironmentHost<'a> {
    /// The quantities of each robot.
    pub states: &'a [State],
    /// All robots, as a list.
    pub all: &'a Object,
}

/// All robots of an environment, as the machine holds them.
pub fn all(robots: usize) -> Object {
    List::of_scalars((0..robots as u64).collect()).into()
}

impl Host for EnvironmentHost<'_> {
    fn call(&mut self, _: u32, call: &mut HostCall<'_>) -> Result<u64, Cow<'static, str>> {
        // Nothing else is asked.
        call.set_object(0, self.all.clone());
        Ok(0)
    }

    fn state_of(&self, robot: RobotId) -> Option<&State> {
        self.states.get(robot.index())
    }
}
