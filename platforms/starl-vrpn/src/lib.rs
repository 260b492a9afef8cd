//! Positions from Vicon and other motion capture, by the protocol VRPN.
//!
//! [`Vrpn`] is the client: it follows one tracker by its name. [`wire`] is the wire format, both ways. Decoders take any
//! bytes.
//!
//! Source: the VRPN library 7.35, and R. Pavlik's description of its protocol (2018).

mod client;
pub mod wire;

pub use client::{Vrpn, VrpnError, VrpnOptions};

/// The port of servers.
pub const PORT: u16 = 3883;
