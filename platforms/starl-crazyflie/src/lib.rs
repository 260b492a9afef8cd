//! Bitcraze's Crazyflie, flown over CRTP, the Crazy RealTime Protocol, in UDP datagrams: one packet in each.
//!
//! [`Crazyflie`] is the driver. [`packet`], [`commander`] and [`log`] are the packets; an emulated Crazyflie uses them in
//! the other direction. UDP is what the simulator of the firmware, bridges to the radio, and Crazyflies with a deck for
//! Wi-Fi speak.
//!
//! Source: Bitcraze, "CRTP - Communication with the Crazyflie", protocol version 9 and later (firmware of 2024).

pub mod commander;
mod driver;
pub mod log;
pub mod packet;
mod telemetry;

pub use driver::{Crazyflie, CrazyflieOptions};
pub use packet::Packet;

/// The UDP port of the first Crazyflie of a simulator.
pub const UDP_PORT: u16 = 19850;
