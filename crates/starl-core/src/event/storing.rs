//! The events of SharedMemory and Register. Values are represented by their hashes.

use crate::{RobotId, Time};
use alloc::sync::Arc;

group! {
    /// A write to an element of a shared memory.
    Written {
        /// The element's variable.
        variable: Arc<str>,
        /// Whether the variable is an array of elements that only their owners write; this one is the writer's.
        single_writer: bool,
        /// The writer's hybrid clock.
        time: Time,
        /// Counts the writes of this time.
        count: u32,
        /// The robot that wrote it.
        writer: RobotId,
        /// In which of the writer's lives.
        incarnation: u32,
        /// The value's hash.
        value: i64,
    }
}

events! {
    /// Commands to a SharedMemory, and their results.
    SharedMemoryEvent {
        /// The memory begins, empty.
        Start = "start",
        /// A variable was given an initial value.
        Initialize = "initialize" {
            /// Which.
            variable: Arc<str>,
            /// Whether it is an array of elements that only their owners write.
            single_writer: bool,
            /// The value's hash.
            value: i64,
        },
        /// A variable is causal from now on.
        Causal = "causal" {
            /// Which.
            variable: Arc<str>,
        },
        /// This robot writes an element.
        Write = "write" {
            /// The write.
            written: Written,
        },
        /// This robot writes its value again, because a write of its own earlier life has arrived.
        WriteAgain = "write_again" {
            /// The write.
            written: Written,
        },
        /// This robot shows the write of another robot from now on.
        Update = "update" {
            /// The write of that robot.
            written: Written,
        },
    }
}

group! {
    /// Names an operation of a robot on a register.
    Operation {
        /// The robot's number for it.
        operation: u32,
        /// The register.
        register: Arc<str>,
    }
}

events! {
    /// Commands to a Register, and their results.
    RegisterEvent {
        /// This robot answers others from now on.
        Up = "up" {
            /// Counts its lives.
            life: i64,
        },
        /// It begins to read.
        Read = "read" {
            /// Which operation it is.
            operation: Operation,
        },
        /// It begins a write that does not depend on the register's value.
        Write = "write" {
            /// Which operation it is.
            operation: Operation,
            /// The value's hash.
            value: i64,
        },
        /// It begins to claim.
        Claim = "claim" {
            /// Which operation it is.
            operation: Operation,
        },
        /// It begins to write a register that it has claimed.
        Update = "update" {
            /// Which operation it is.
            operation: Operation,
            /// The hash of what it found; none where nothing was written.
            found: Option<i64>,
            /// The value's hash.
            value: i64,
        },
        /// An operation is done.
        Done = "done" {
            /// Which.
            operation: Operation,
            /// The hash of what the register held, as far as the robot knows; none where nothing was written.
            value: Option<i64>,
        },
        /// An update has not taken place: another claim came between.
        Lost = "lost" {
            /// Which.
            operation: Operation,
            /// As of `done`.
            value: Option<i64>,
        },
        /// An operation was refused.
        Refused = "refused" {
            /// Which.
            operation: Operation,
            /// As of `done`.
            value: Option<i64>,
        },
        /// An operation is given up. It may still take effect.
        Withdraw = "withdraw" {
            /// Which.
            operation: Operation,
        },
        /// An operation waits because too few robots answer.
        NoQuorum = "no_quorum" {
            /// Which.
            operation: Operation,
        },
    }
}
