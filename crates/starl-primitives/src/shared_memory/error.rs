//! Why a memory refuses a write.

use core::fmt;

/// Why a write was refused. The memory is as before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WriteError {
    /// The variable's name is longer than 255 bytes.
    NameTooLong,
    /// The value is longer than [`longest_value`](super::Options::longest_value).
    ValueTooLong,
    /// There are [`most_elements`](super::Options::most_elements) already.
    Full,
    /// Another variable has taken the place that this name is given in memories: rename one. The odds
    /// are one in 10^9 among 100,000 variables.
    NameTaken,
}

impl fmt::Display for WriteError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            WriteError::NameTooLong => "the variable's name is too long",
            WriteError::ValueTooLong => "the value is too long for a datagram",
            WriteError::Full => "the memory holds as many variables as it may",
            WriteError::NameTaken => "another variable takes this name's place in the memory",
        })
    }
}

impl core::error::Error for WriteError {}
