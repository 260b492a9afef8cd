//! The commands of real fleets, in a build without the feature `fleet`: all are refused.

use crate::args::{EmulateArguments, FleetCommand, RobotArguments};
use crate::console;
use crate::failure::Failure;
use starl_catalog::programs::Registry;

pub fn robot(_: &RobotArguments, _: &Registry) -> Result<bool, Failure> {
    refuse()
}

pub fn emulate(_: &EmulateArguments, _: &Registry) -> Result<bool, Failure> {
    refuse()
}

pub fn fleet(_: &FleetCommand, _: &Registry) -> Result<bool, Failure> {
    refuse()
}

fn refuse() -> Result<bool, Failure> {
    Err(Failure(format!(
        "this {} was built without real fleets; build it with the feature `fleet`",
        console::command()
    )))
}
