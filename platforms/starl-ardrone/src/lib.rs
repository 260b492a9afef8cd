//! The Parrot AR.Drone 2, flown over Wi-Fi.
//!
//! [`Ardrone`] is the driver. [`at`] and [`navdata`] are the wire formats, both ways: the driver sends AT commands to
//! UDP port 5556 and gets navdata from UDP port 5554, an emulated drone does the opposite. Decoders take any bytes.
//!
//! Source: AR.Drone Developer Guide, SDK 2.0 (2012). It leaves signs open; they are those that published drivers use.

pub mod at;
mod configuration;
mod driver;
pub mod navdata;

pub use driver::{Ardrone, ArdroneOptions};

/// The UDP port of the drone that takes AT commands.
pub const AT_PORT: u16 = 5556;
/// The drone's UDP port for navdata: it answers any client that sends it a packet.
pub const NAVDATA_PORT: u16 = 5554;
