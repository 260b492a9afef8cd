//! Errors of reading and writing traces.

use core::fmt;
use starl_core::{RobotId, Time};

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

/// Why a trace cannot be read, or not further.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TraceError {
    /// The file is not an MCAP file.
    NotMcap,
    /// It is an MCAP file that StarL did not write.
    NotStarl,
    /// It has another version of the format.
    Version {
        /// The version it says it has.
        found: String,
    },
    /// It stops in the middle.
    Truncated(Progress),
    /// It is a whole file, but its writer stopped before the end of the run.
    NoEnd(Progress),
    /// It is not as it was written.
    Damaged {
        /// Where.
        progress: Progress,
        /// The problem.
        what: String,
    },
    /// A message is not what its topic carries.
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
    Compressed {
        /// Where.
        progress: Progress,
        /// The compression's name.
        method: String,
    },
    /// A record says that it is longer than any in a trace.
    TooLong {
        /// Where.
        progress: Progress,
        /// Its length, bytes.
        length: u64,
    },
    /// The bytes could not be had.
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

impl fmt::Display for TraceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            TraceError::NotMcap => write!(
                f,
                "not a trace: the file does not begin as an MCAP file does; give a file that `starl run --trace` wrote"
            ),
            TraceError::NotStarl => write!(
                f,
                "not a trace of StarL: the MCAP file has no metadata record `starl` before its messages; give a file that `starl run --trace` wrote"
            ),
            TraceError::Version { found } => write!(
                f,
                "the trace has format version {found}, this StarL reads version {}: use the StarL that wrote it, or record it again",
                crate::FORMAT_VERSION
            ),
            TraceError::Truncated(progress) => write!(
                f,
                "the trace is truncated: the file stops {progress}; copy it again in full, or record it again"
            ),
            TraceError::NoEnd(progress) => write!(
                f,
                "the trace is truncated: no end record {progress}; its writer stopped before the end of the run, so record it again"
            ),
            TraceError::Damaged { progress, what } => write!(
                f,
                "the trace is damaged {progress}: {what}; copy it again, or record it again"
            ),
            TraceError::Message {
                progress,
                topic,
                at,
                what,
            } => write!(
                f,
                "the trace has a bad message on {topic} at {at}, {progress}: {what}; record it again with `starl run --trace`"
            ),
            TraceError::Compressed { progress, method } => write!(
                f,
                "the trace has a chunk compressed with `{method}` {progress}: undo it with `mcap decompress`"
            ),
            TraceError::TooLong { progress, length } => write!(
                f,
                "the trace is damaged {progress}: a record claims {length} bytes; copy it again, or record it again"
            ),
            TraceError::Input { progress, what } => {
                write!(f, "the trace cannot be read {progress}: {what}")
            }
        }
    }
}

impl core::error::Error for TraceError {}

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
