//! A subject of tests: a target that was read and compiled once, however often it runs.

use crate::args::TestArguments;
use crate::failure::Failure;
use crate::origin::Origin;
use crate::run::start_error;
use crate::target::{self, Selection};
use starl_catalog::programs::Registry;
use starl_catalog::trial;

/// A target.
pub struct Subject {
    /// As it was given.
    pub target: String,
    /// Where its files come from.
    pub origin: Origin,
    /// Its scenario and programs.
    pub tested: trial::Subject,
}

impl Subject {
    /// Reads a target, and runs it once to see how long it takes.
    pub fn read(
        target: &str,
        arguments: &TestArguments,
        registry: &Registry,
    ) -> Result<Subject, Failure> {
        let quiet = arguments.quiet || arguments.json;
        let selection = target::read(&arguments.changes.of(target, None, quiet), registry)?;
        let Selection {
            application,
            origin,
            ..
        } = selection;
        let tested = trial::Subject::new(&application, arguments.demand_goal)
            .map_err(|error| start_error(&application, &error))?;
        Ok(Subject {
            target: target.to_string(),
            origin,
            tested,
        })
    }
}
