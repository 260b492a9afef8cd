//! One environment as expressions ask about it: a state of variables for each robot, and the robots themselves.

use starl_core::RobotId;
use starl_lang::machine::{Host, HostCall, List, Object, State};
use std::borrow::Cow;

/// The numbers of what expressions ask, by their places in [`super::wording::ASKED`].
const ALL: u32 = 0;
const POSITION: u32 = 1;
const HEADING: u32 = 2;
const VELOCITY: u32 = 3;
const PEERS: u32 = 4;

/// The machine's host.
pub struct Court<'a> {
    pub robots: &'a [starl_motion::State],
    /// The quantities of each robot.
    pub states: &'a [State],
    /// All robots, as a list.
    pub all: &'a Object,
}

/// All robots of an environment, as the machine holds them.
pub fn all(robots: usize) -> Object {
    List::of_scalars((0..robots as u64).collect()).into()
}

impl Host for Court<'_> {
    fn call(&mut self, function: u32, call: &mut HostCall<'_>) -> Result<u64, Cow<'static, str>> {
        if let ALL | PEERS = function {
            call.set_object(0, self.all.clone());
            return Ok(0);
        }
        let robot = self.robots.get(call.robot(0).index());
        let robot = robot.ok_or("there is no such robot")?;
        match function {
            POSITION => call.set_point(0, robot.pose.position),
            HEADING => call.set_float(0, robot.pose.yaw),
            VELOCITY => call.set_point(0, robot.twist.linear),
            _ => return Err("an environment does not know this".into()),
        }
        Ok(0)
    }

    fn state_of(&self, robot: RobotId) -> Option<&State> {
        self.states.get(robot.index())
    }
}
