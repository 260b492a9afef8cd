//! A target of tests, read and compiled once, however often it runs.

use crate::args::TestArguments;
use crate::failure::Failure;
use crate::origin::Origin;
use crate::run::start_error;
use crate::target::{self, Selection};
use starl_catalog::programs::Registry;
use starl_catalog::trial::Subject;

/// A target.
pub struct Target {
    /// As it was given.
    pub name: String,
    /// The origin of its files.
    pub origin: Origin,
}

impl Target {
    /// Reads a target, and runs it once to see how long it takes.
    pub fn read(
        name: &str,
        arguments: &TestArguments,
        registry: &Registry,
    ) -> Result<(Target, Subject), Failure> {
        let quiet = arguments.quiet || arguments.json;
        let selection = target::read(&arguments.changes.of(name, None, quiet), registry)?;
        let Selection {
            application,
            origin,
            ..
        } = selection;
        let subject = Subject::new(&application, arguments.demand_goal)
            .map_err(|error| start_error(&application, error))?;
        let target = Target {
            name: name.to_string(),
            origin,
        };
        Ok((target, subject))
    }
}
