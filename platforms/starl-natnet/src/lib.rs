//! Positions from OptiTrack's motion capture, by the protocol NatNet.
//!
//! [`NatNet`] is the client: it follows one rigid body by its name. [`message`] and [`frame`] are the wire format, both
//! ways, for versions 3.0 to 4.1 of the protocol (Motive 2 and 3). Decoders take any bytes.
//!
//! Motive must stream to single clients: Streaming, Transmission Type "Unicast".
//!
//! Source: NatNet SDK 4.1, its description of direct depacketization.

mod bytes;
mod client;
pub mod frame;
pub mod message;

pub use client::{NatNet, NatNetError, NatNetOptions, UpAxis};
pub use frame::{Frame, RigidBody};
pub use message::{Message, ServerInfo};

/// The UDP port on which a server takes requests.
pub const COMMAND_PORT: u16 = 1510;

/// A version of the protocol: major and minor.
pub type Version = (u8, u8);

/// From this version on each section of a message tells its length.
const WITH_LENGTHS: Version = (4, 1);
