//! Names of robots and of the endpoints on a robot.

use core::fmt;
use serde::{Deserialize, Serialize};

/// A robot's number in its fleet: 0, 1, 2, ... Stored small, since swarms hold many of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct RobotId(pub u32);

impl RobotId {
    /// The number as an index into per-robot arrays.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

impl fmt::Display for RobotId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.0)
    }
}

/// The endpoint on a robot that a message or timer is for: the program itself, or one instance of a primitive.
/// Instances on different robots that communicate have the same name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Port(pub u32);

impl Port {
    /// The robot's program.
    pub const PROGRAM: Port = Port(0);

    /// The endpoint of the primitive instance called `name`, e.g. `mutex/intersection-0`.
    ///
    /// The number is the 32-bit FNV-1a hash of the name (Fowler, Noll, Vo; RFC 9923), so that all
    /// robots derive the same one without talking.
    pub const fn named(name: &str) -> Port {
        let bytes = name.as_bytes();
        let mut hash: u32 = 0x811c_9dc5;
        let mut i = 0;
        while i < bytes.len() {
            hash = (hash ^ bytes[i] as u32).wrapping_mul(0x0100_0193);
            i += 1;
        }
        // 0 is the program's.
        Port(if hash == 0 { 1 } else { hash })
    }
}
