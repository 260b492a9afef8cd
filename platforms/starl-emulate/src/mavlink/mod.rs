//! An emulated multicopter with PX4 or ArduPilot: the model `drone` behind MAVLink 2.
//!
//! It differs from the real software in this: it has no parameters, missions, GPS or failsafes of its battery; it holds
//! its place where set-points stop, and lands once no ground station or computer is heard for 3 s. North is the world's x
//! axis, and the origin of its local frame is where it was started.

mod flight;

use crate::BodyHandle;
use crate::service::Service;
use flight::Flight;
use starl_mavlink::{Autopilot, wire};
use std::io::{self, ErrorKind};
use std::net::{SocketAddr, UdpSocket};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// A vehicle on a UDP port. Dropping it stops the body where it is and closes the port.
#[derive(Debug)]
pub struct EmulatedVehicle {
    socket: Arc<UdpSocket>,
    flight: Arc<Mutex<Flight>>,
    service: Service,
}

/// How long the vehicle waits for messages before it looks what else there is to do.
const WAIT: Duration = Duration::from_millis(5);

impl EmulatedVehicle {
    /// Puts `body` behind `address`; port 0 takes any free port. It sends to `client`, as PX4 does to port 14540, or to
    /// any client that sends it a heartbeat.
    ///
    /// # Errors
    /// If the address is in use or not this machine's.
    pub fn start(
        body: BodyHandle,
        autopilot: Autopilot,
        address: SocketAddr,
        client: Option<SocketAddr>,
    ) -> io::Result<EmulatedVehicle> {
        let socket = Arc::new(UdpSocket::bind(address)?);
        socket.set_read_timeout(Some(WAIT))?;
        let flight = Arc::new(Mutex::new(Flight::new(body, autopilot, client)));
        let service = {
            let (socket, flight) = (socket.clone(), flight.clone());
            Service::start(move || turn(&socket, &flight))
        };
        Ok(EmulatedVehicle {
            socket,
            flight,
            service,
        })
    }

    /// Where it listens.
    ///
    /// # Errors
    /// If the system does not tell the port.
    pub fn address(&self) -> io::Result<SocketAddr> {
        self.socket.local_addr()
    }

    /// Has a pilot switch to the mode with this number, in which the vehicle holds its place.
    pub fn switch(&self, mode: u32) {
        let mut flight = self.flight.lock().unwrap_or_else(PoisonError::into_inner);
        flight.switch(mode);
    }

    /// The number of its mode.
    pub fn mode(&self) -> u32 {
        let flight = self.flight.lock().unwrap_or_else(PoisonError::into_inner);
        flight.mode()
    }

    /// The time between two messages of this number, seconds; `None` if it never sends them.
    pub fn interval(&self, number: u32) -> Option<f64> {
        let flight = self.flight.lock().unwrap_or_else(PoisonError::into_inner);
        flight.interval(number)
    }

    /// Sends its client bytes between its messages.
    pub fn interfere(&self, bytes: &[u8]) {
        let flight = self.flight.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(client) = flight.client() {
            let _ = self.socket.send_to(bytes, client);
        }
    }
}

impl Drop for EmulatedVehicle {
    fn drop(&mut self) {
        self.service.end();
        let flight = self.flight.lock().unwrap_or_else(PoisonError::into_inner);
        flight.halt();
    }
}

fn turn(socket: &UdpSocket, flight: &Mutex<Flight>) -> io::Result<()> {
    let mut buffer = [0; 2048];
    let received = match socket.recv_from(&mut buffer) {
        Ok((length, from)) => Some((length, from)),
        Err(error) => match error.kind() {
            ErrorKind::WouldBlock
            | ErrorKind::TimedOut
            | ErrorKind::Interrupted
            | ErrorKind::ConnectionRefused => None,
            _ => return Err(error),
        },
    };
    let mut flight = flight.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((length, from)) = received {
        for (_, message) in wire::decode(&buffer[..length]) {
            flight.take(&message, from);
        }
    }
    flight.tick();
    if let Some(client) = flight.client() {
        for datagram in flight.outbox() {
            // A client that is gone is noticed by its silence.
            let _ = socket.send_to(&datagram, client);
        }
    }
    Ok(())
}
