//! StarL on a real robot.
//!
//! One process runs one robot: the [`starl_host::Node`] that every host runs, with the machine's clock, a network
//! link, a source of positions, and the robot's own [`Device`].

pub mod device;

pub use device::{Device, DeviceError, Reading};
