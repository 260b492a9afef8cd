//! Multicopters with a PX4 or ArduPilot autopilot, flown over MAVLink 2.
//!
//! [`MavlinkVehicle`] is the driver. [`wire`] packs messages of the crate `mavlink` into datagrams and finds them there;
//! [`autopilot`] is what PX4 and ArduPilot call their modes. An emulated vehicle uses both in the other direction.
//!
//! Sources: the MAVLink common message set; PX4 User Guide, "Offboard Mode"; ArduPilot, "Copter Commands in Guided Mode".

pub mod autopilot;
mod driver;
mod link;
mod state;
pub mod wire;

pub use autopilot::Autopilot;
pub use driver::{MavlinkOptions, MavlinkVehicle};
pub use mavlink::dialects::common;

/// The UDP port at which PX4 sends to a companion computer.
pub const PX4_PORT: u16 = 14540;
/// The UDP port at which ArduPilot's tools send to ground stations.
pub const ARDUPILOT_PORT: u16 = 14550;
