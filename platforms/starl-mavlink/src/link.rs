//! The datagrams between this computer and the one vehicle that it flies.

use crate::common::{COMMAND_LONG_DATA, MavCmd, MavMessage};
use crate::{Autopilot, wire};
use mavlink::MavHeader;
use std::io::{self, ErrorKind};
use std::net::{SocketAddr, UdpSocket};
use std::time::{Duration, Instant};

/// By convention a computer has another system's number than the autopilot, and the component of an onboard computer.
const SYSTEM: u32 = 245;
const COMPONENT: u8 = 191;

#[derive(Debug)]
pub(crate) struct Link {
    socket: UdpSocket,
    /// Where the vehicle listens, if it waits for the first message.
    first: Option<SocketAddr>,
    /// The vehicle: where its messages come from, and its system.
    peer: Option<(SocketAddr, u8)>,
    sequence: u8,
    heard: Instant,
}

impl Link {
    pub fn open(listen: SocketAddr, first: Option<SocketAddr>) -> io::Result<Link> {
        let socket = UdpSocket::bind(listen)?;
        socket.set_nonblocking(true)?;
        Ok(Link {
            socket,
            first,
            peer: None,
            sequence: 0,
            heard: Instant::now(),
        })
    }

    pub fn address(&self) -> io::Result<SocketAddr> {
        self.socket.local_addr()
    }

    pub fn has_peer(&self) -> bool {
        self.peer.is_some()
    }

    /// The vehicle's system; 1, the default of every vehicle, until it is known.
    pub fn system(&self) -> u8 {
        self.peer.map_or(1, |(_, system)| system)
    }

    /// How long the vehicle has been silent.
    pub fn silence(&self) -> Duration {
        self.heard.elapsed()
    }

    /// Listens to any vehicle again.
    pub fn forget_peer(&mut self) {
        self.peer = None;
    }

    /// Sends a message. If no process listens, there is no error, only silence.
    pub fn send(&mut self, message: &MavMessage) -> io::Result<()> {
        let known = self.peer.map(|(address, _)| address);
        let Some(address) = known.or(self.first) else {
            return Ok(());
        };
        let header = MavHeader {
            system_id: SYSTEM,
            component_id: COMPONENT,
            sequence: self.sequence,
        };
        self.sequence = self.sequence.wrapping_add(1);
        let mut datagram = Vec::new();
        wire::encode(header, message, &mut datagram);
        match self.socket.send_to(&datagram, address) {
            Err(error) if error.kind() != ErrorKind::ConnectionRefused => Err(error),
            _ => Ok(()),
        }
    }

    pub fn command(&mut self, command: MavCmd, parameters: [f32; 7]) -> io::Result<()> {
        let [param1, param2, param3, param4, param5, param6, param7] = parameters;
        self.send(&MavMessage::COMMAND_LONG(COMMAND_LONG_DATA {
            param1,
            param2,
            param3,
            param4,
            param5,
            param6,
            param7,
            command,
            target_system: self.system(),
            target_component: 1,
            confirmation: 0,
        }))
    }

    /// The messages that have arrived from the vehicle. The first autopilot that is heard is the vehicle; its first
    /// message is returned with the kind of autopilot. Others are ignored.
    pub fn receive(&mut self) -> io::Result<Vec<(Option<Autopilot>, MavMessage)>> {
        let mut messages = Vec::new();
        let mut buffer = [0; 2048];
        loop {
            let (length, from) = match self.socket.recv_from(&mut buffer) {
                Ok(received) => received,
                Err(error) => match error.kind() {
                    ErrorKind::WouldBlock => return Ok(messages),
                    ErrorKind::Interrupted | ErrorKind::ConnectionRefused => continue,
                    _ => return Err(error),
                },
            };
            for (header, message) in wire::decode(&buffer[..length]) {
                let Ok(system) = u8::try_from(header.system_id) else {
                    continue;
                };
                let mut new = None;
                if let (None, MavMessage::HEARTBEAT(data)) = (self.peer, &message) {
                    new = Autopilot::of(data.autopilot);
                    self.peer = new.map(|_| (from, system));
                }
                if self.peer == Some((from, system)) {
                    self.heard = Instant::now();
                    messages.push((new, message));
                }
            }
        }
    }
}
