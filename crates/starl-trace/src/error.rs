//! Errors of reading and writing traces.

use core::fmt;
use starl_core::{RobotId, Time};
use thiserror::Error;

/// How far reading came before it failed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Progress {
    /// Where in the file, bytes from its start.
    pub offset: u64,
    /// How many records were read before.
    pub records: u64,
    /// The time of the last of them.
    pub last: Option<Time>,
}

impl fmt::Display for Progress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.last {
            None => write!(f, "at byte {}, before the first record", self.offset),
            Some(last) => write!(
                f,
                "at byte {}, after {} records up to {last} that can be read",
                self.offset, self.records
            ),
        }
    }
}

/// Why a message or record is not what its place calls for, in words.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{0}")]
pub(crate) struct Malformed(pub String);

impl From<&str> for Malformed {
    fn from(reason: &str) -> Malformed {
        Malformed(reason.into())
    }
}

impl From<serde_json::Error> for Malformed {
    fn from(error: serde_json::Error) -> Malformed {
        Malformed(error.to_string())
    }
}

/// Why a trace cannot be read, or not further.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum TraceError {
    /// The file is not an MCAP file.
    #[error(
        "not a trace: the file does not begin as an MCAP file does; give a file that `starl run --trace` wrote"
    )]
    NotMcap,
    /// It is an MCAP file that StarL did not write.
    #[error(
        "not a trace of StarL: the MCAP file has no metadata record `starl` before its messages; give a file that `starl run --trace` wrote"
    )]
    NotStarl,
    /// It has another version of the format.
    #[error(
        "the trace has format version {found}, this StarL reads version {}: use the StarL that wrote it, or record it again",
        crate::FORMAT_VERSION
    )]
    Version {
        /// The version it says it has.
        found: String,
    },
    /// It stops in the middle.
    #[error(
        "the trace is truncated: the file stops {0}; copy it again in full, or record it again"
    )]
    Truncated(Progress),
    /// It is a whole file, but its writer stopped before the end of the run.
    #[error(
        "the trace is truncated: no end record {0}; its writer stopped before the end of the run, so record it again"
    )]
    NoEnd(Progress),
    /// It is not as it was written.
    #[error("the trace is damaged {progress}: {what}; copy it again, or record it again")]
    Damaged {
        /// Where.
        progress: Progress,
        /// The problem.
        what: String,
    },
    /// A message is not what its topic carries.
    #[error(
        "the trace has a bad message on {topic} at {at}, {progress}: {what}; record it again with `starl run --trace`"
    )]
    Message {
        /// Where.
        progress: Progress,
        /// On which topic.
        topic: String,
        /// When, by the message's own time.
        at: Time,
        /// The problem.
        what: String,
    },
    /// A chunk is compressed in a way that this reader does not undo.
    #[error(
        "the trace has a chunk compressed with `{method}` {progress}: undo it with `mcap decompress`"
    )]
    Compressed {
        /// Where.
        progress: Progress,
        /// The compression's name.
        method: String,
    },
    /// A record says that it is longer than any in a trace.
    #[error(
        "the trace is damaged {progress}: a record claims {length} bytes; copy it again, or record it again"
    )]
    TooLong {
        /// Where.
        progress: Progress,
        /// Its length, bytes.
        length: u64,
    },
    /// The bytes could not be had.
    #[error("the trace cannot be read {progress}: {what}")]
    Input {
        /// Where.
        progress: Progress,
        /// The message of the source.
        what: String,
    },
}

impl TraceError {
    /// Whether the existing part of the trace is readable, and only its end is missing.
    pub fn is_missing_end(&self) -> bool {
        matches!(self, TraceError::Truncated(_) | TraceError::NoEnd(_))
    }
}

/// Why a trace cannot be written. The writer cannot be used afterwards; the trace is readable up to the last complete
/// chunk.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum WriteError {
    /// The output failed, e.g. because the disk is full.
    Output {
        /// Its message.
        what: String,
    },
    /// An event holds a number that is infinite or not a number where only a finite one makes sense:
    /// something went wrong before it.
    NotFinite {
        /// When.
        at: Time,
        /// On which robot.
        robot: Option<RobotId>,
        /// The topic of the event.
        topic: &'static str,
    },
}

impl fmt::Display for WriteError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            WriteError::Output { what } => write!(f, "the trace cannot be written: {what}"),
            WriteError::NotFinite { at, robot, topic } => {
                write!(f, "a number for {topic} at {at}")?;
                if let Some(robot) = robot {
                    write!(f, " of robot {robot}")?;
                }
                write!(f, " is infinite or not a number")
            }
        }
    }
}

impl core::error::Error for WriteError {}

impl From<mcap::McapError> for WriteError {
    fn from(error: mcap::McapError) -> WriteError {
        WriteError::Output {
            what: match error {
                mcap::McapError::Io(error) => error.to_string(),
                other => other.to_string(),
            },
        }
    }
}
