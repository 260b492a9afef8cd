//! StarL on a real robot.
//!
//! One process runs one robot: the [`starl_host::Node`] that every host runs, with the machine's clock, a network
//! link, a source of positions, and the robot's own [`Device`].

pub mod clock;
pub mod device;
mod discovery;
pub mod link;
pub mod localise;
pub mod motors;
pub mod operator;
mod outlet;
mod planner;
mod recorder;
pub mod robot;
pub mod safety;
mod setup;
pub mod simulated;
pub mod storage;
pub mod surroundings;
pub mod world_body;
pub mod writer;

pub use clock::WallClock;
pub use device::{Device, DeviceError, Reading};
pub use operator::Operator;
pub use robot::Robot;
pub use safety::Safety;
pub use storage::Storage;

/// The page that shows how to write a [`Device`]; its code is compiled with the tests.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/how-to/port-to-a-new-robot.md")]
pub struct PortToANewRobot;
