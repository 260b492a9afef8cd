//! Why a command could not be carried out: exit status 2.

use starl_sim::read::{OneLine, Problem, Problems};
use std::fmt;
use std::path::Path;
use thiserror::Error;

/// One message for the user of the command: the place, the problem, and a suggested fix.
#[derive(Debug, Error)]
#[error("{0}")]
pub struct Failure(pub String);

impl Failure {
    /// A failure to do something with a file.
    pub fn file(path: &Path, what: impl fmt::Display) -> Failure {
        let path = path.display().to_string();
        Failure(format!("{}: {what}", OneLine(&path)))
    }
}

/// Errors that name their place.
macro_rules! whole {
    ($($error:ty),*) => {$(
        impl From<$error> for Failure {
            fn from(error: $error) -> Failure {
                Failure(error.to_string())
            }
        }
    )*};
}

whole!(Problem, Problems, starl_sweep::Error);
