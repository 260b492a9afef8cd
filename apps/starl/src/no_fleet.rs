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

/// Follows no fleet.
#[cfg(feature = "web")]
pub struct Follower(std::convert::Infallible);

#[cfg(feature = "web")]
pub fn follow(_: &std::path::Path, _: &Registry) -> Result<Follower, Failure> {
    refuse()
}

#[cfg(feature = "web")]
impl Follower {
    pub fn name(&self) -> &str {
        match self.0 {}
    }

    pub fn run(self, _: impl FnMut(&[u8]) -> std::io::Result<()>) -> Result<(), Failure> {
        match self.0 {}
    }
}

fn refuse<T>() -> Result<T, Failure> {
    Err(Failure(format!(
        "this {} was built without real fleets; build it with the feature `fleet`",
        console::command()
    )))
}
