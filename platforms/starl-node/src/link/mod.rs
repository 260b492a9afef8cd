//! The link between robots: a transport for packets, their encryption, and the quality of the link.

pub mod beacon;
pub mod channel;
pub mod frame;
pub mod impaired;
pub mod quality;
pub mod udp;
mod window;

pub use channel::{Channel, Key, Member, OPERATORS, Refusals};
pub use impaired::{Impaired, Impairment};

use std::io;
use std::net::SocketAddr;
use std::time::Instant;

/// Carries packets between members of a fleet, as well as it can.
pub trait Transport: Send {
    /// Sends a packet to a member. It may get lost.
    ///
    /// # Errors
    /// If the network refuses it, or the member's place is not known.
    fn send(&mut self, to: Member, packet: &[u8]) -> io::Result<()>;

    /// A member was heard at this place, and its packet was authentic.
    fn learn(&mut self, member: Member, origin: Origin);
}

/// Where a packet came from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// A socket.
    Socket(SocketAddr),
    /// A transport that finds members by their numbers.
    Named,
}

/// A packet that has arrived.
#[derive(Debug)]
pub struct Arrival {
    /// When.
    pub at: Instant,
    /// From where.
    pub origin: Origin,
    /// Its content.
    pub packet: Vec<u8>,
}
