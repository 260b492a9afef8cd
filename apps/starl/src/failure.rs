//! Why a command could not be carried out: exit status 2.

use std::fmt;
use std::path::Path;

/// One message for the user of the command: the place, the problem, and a suggested fix.
#[derive(Debug)]
pub struct Failure(pub String);

impl Failure {
    /// A failure to do something with a file.
    pub fn file(path: &Path, what: impl fmt::Display) -> Failure {
        Failure(format!("{}: {what}", path.display()))
    }
}

impl From<starl_sim::read::Problems> for Failure {
    fn from(problems: starl_sim::read::Problems) -> Failure {
        Failure(problems.to_string())
    }
}

impl From<starl_sim::read::Problem> for Failure {
    fn from(problem: starl_sim::read::Problem) -> Failure {
        Failure(problem.to_string())
    }
}

impl From<starl_sweep::Error> for Failure {
    fn from(error: starl_sweep::Error) -> Failure {
        Failure(error.to_string())
    }
}
