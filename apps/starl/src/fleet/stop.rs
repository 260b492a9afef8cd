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
pub fn halt(fleet: &Fleet, operator: &mut Operator) -> Vec<String> {
    let robots: Vec<u32> = fleet.robots.iter().map(|robot| robot.id.0).collect();
    let stopped = operator.halt(&robots, PATIENCE);
    let silent = fleet
        .robots
        .iter()
        .filter(|robot| !stopped.contains(&robot.id.0));
    silent.map(|robot| robot.name.clone()).collect()
}
