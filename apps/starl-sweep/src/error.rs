//! Why a sweep cannot be planned, run or written.

use starl_catalog::Refusal;
use starl_catalog::disk::reason;
use starl_sim::read::{Place, Problem};
use std::io;
use std::path::{Path, PathBuf};

/// Why a sweep cannot be planned, run or written. Each displays as a message for the person who asked for it.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The scenario or a program has errors with the fields of some combination.
    #[error("{0}")]
    Refused(Box<Refusal>),
    /// An axis, the seeds or the profile are not as they should be.
    #[error("{0}")]
    Problem(Problem),
    /// A file cannot be read or written as asked.
    #[error("{}: {message}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// The problem and what to do.
        message: String,
    },
}

impl Error {
    /// A problem with an option, such as `--set network.loss`.
    pub(crate) fn option(option: &str, message: impl Into<String>, help: &str) -> Error {
        Error::Problem(Problem {
            place: Place::Option(option.to_string()),
            field: String::new(),
            message: message.into(),
            help: (!help.is_empty()).then(|| help.to_string()),
        })
    }

    /// A problem with a file.
    pub(crate) fn file(path: &Path, message: impl Into<String>) -> Error {
        Error::File {
            path: path.to_path_buf(),
            message: message.into(),
        }
    }

    /// A failure of the system with a file.
    pub(crate) fn io(path: &Path, what: &str, error: &io::Error) -> Error {
        let reason = reason(error);
        Error::file(path, format!("cannot be {what}: {reason}"))
    }
}

impl From<Refusal> for Error {
    fn from(refusal: Refusal) -> Error {
        Error::Refused(Box::new(refusal))
    }
}
