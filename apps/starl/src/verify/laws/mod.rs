//! The laws of the simulated world, recomputed from the records of a trace: limits of motion, and the network.
//!
//! They hold for every run of the simulator, whatever its programs do, and need only the trace and the scenario in it.
//! A broken law is an error of the simulator or of the trace, not of a program.

mod motion;
mod network;

use starl_core::{RobotId, Time};
use starl_properties::{Checker, Violation};
use starl_sim::Scenario;

/// The checkers of a scenario's laws.
pub fn of(scenario: &Scenario) -> Vec<Box<dyn Checker>> {
    vec![
        Box::new(motion::Motion::new(scenario)),
        Box::new(network::Traffic::new(scenario)),
    ]
}

fn broken(law: &'static str, at: Time, robots: Vec<RobotId>, text: String) -> Violation {
    Violation {
        property: law.into(),
        at,
        robots,
        text,
    }
}
