//! Why a memory refuses a write.

use thiserror::Error;

/// Why a write was refused. The memory is as before.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum WriteError {
    /// The variable's name is longer than 255 bytes.
    #[error("the variable's name is too long")]
    NameTooLong,
    /// The value is longer than [`longest_value`](super::Options::longest_value).
    #[error("the value is too long for a datagram")]
    ValueTooLong,
    /// There are [`most_elements`](super::Options::most_elements) already.
    #[error("the memory holds as many variables as it may")]
    Full,
    /// Another variable has taken the place that this name is given in memories: rename one. The odds
    /// are one in 10^9 among 100,000 variables.
    #[error("another variable takes this name's place in the memory")]
    NameTaken,
}
