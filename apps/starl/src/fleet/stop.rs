//! `starl fleet stop`: stops the motors of all robots at once, and then the robots.

use super::connect::connect;
use super::file::Fleet;
use crate::args::FleetStopArguments;
use crate::console;
use crate::failure::Failure;
use starl_catalog::programs::Registry;
use starl_node::Operator;
use std::time::Duration;

/// A robot that does not confirm for so long may still run.
const PATIENCE: Duration = Duration::from_secs(4);

/// Stops a fleet; whether all robots have confirmed it.
pub fn stop(arguments: &FleetStopArguments, registry: &Registry) -> Result<bool, Failure> {
    let fleet = Fleet::read(&arguments.fleet, None, true, registry)?;
    let mut operator = connect(&fleet)?;
    let silent = halt(&fleet, &mut operator);
    let stopped = fleet.robots.len() - silent.len();
    console::print(&format!("stopped {}\n", console::counted(stopped, "robot")))?;
    if !silent.is_empty() {
        let names = silent.join(", ");
        console::error(&format!(
            "no answer from {names}: not running, or not reachable from here"
        ));
    }
    Ok(silent.is_empty())
}

/// Stops all robots; gives the names of those that do not confirm it.
pub fn halt<'f>(fleet: &'f Fleet, operator: &mut Operator) -> Vec<&'f str> {
    let robots = fleet.numbers();
    let stopped = operator.halt(&robots, PATIENCE);
    fleet.silent(&robots, &stopped)
}
