//! An emulated Crazyflie: the model `drone` behind CRTP on a UDP port.
//!
//! It differs from hardware in this: it has the model's size and speed, it lands where a real one would fall because
//! its motors stop, and it has no decks, memories or trajectories. Its own frame begins where it was switched on. Like
//! the real one it levels out when set-points stop for 0.5 s, and gives up flying after 2 s.

mod flight;
mod service;
mod table;

use crate::BodyHandle;
use crate::service::Service;
use flight::Flight;
use service::Desk;
use std::io::{self, ErrorKind};
use std::net::{SocketAddr, UdpSocket};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// A Crazyflie on a UDP port. Dropping it stops the body where it is and closes the port.
#[derive(Debug)]
pub struct EmulatedCrazyflie {
    socket: Arc<UdpSocket>,
    inside: Arc<Mutex<Inside>>,
    service: Service,
}

#[derive(Debug)]
struct Inside {
    flight: Flight,
    desk: Desk,
    /// The receiver of its packets: the client that it heard last.
    client: Option<SocketAddr>,
}

/// How long it waits for packets before it looks what else there is to do.
const WAIT: Duration = Duration::from_millis(5);

impl EmulatedCrazyflie {
    /// Puts `body` behind this address; port 0 takes any free port.
    ///
    /// # Errors
    /// If the address is in use or not this machine's.
    pub fn start(body: BodyHandle, address: SocketAddr) -> io::Result<EmulatedCrazyflie> {
        let socket = Arc::new(UdpSocket::bind(address)?);
        socket.set_read_timeout(Some(WAIT))?;
        let inside = Arc::new(Mutex::new(Inside {
            flight: Flight::new(body),
            desk: Desk::default(),
            client: None,
        }));
        let service = {
            let (socket, inside) = (socket.clone(), inside.clone());
            Service::start(move || turn(&socket, &inside))
        };
        Ok(EmulatedCrazyflie {
            socket,
            inside,
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

    /// Sends its client bytes between its packets.
    pub fn interfere(&self, bytes: &[u8]) {
        if let Some(client) = lock(&self.inside).client {
            let _ = self.socket.send_to(bytes, client);
        }
    }

    /// Lies on its side from now on, and cannot fly.
    pub fn tumble(&self) {
        lock(&self.inside).flight.tumble();
    }
}

impl Drop for EmulatedCrazyflie {
    fn drop(&mut self) {
        self.service.end();
        lock(&self.inside).flight.halt();
    }
}

fn turn(socket: &UdpSocket, inside: &Mutex<Inside>) -> io::Result<()> {
    let mut buffer = [0; 64];
    // Nothing is locked while it waits: it would lock again at once, and others would wait for seconds.
    let received = match socket.recv_from(&mut buffer) {
        Ok(received) => Some(received),
        Err(error) => match error.kind() {
            ErrorKind::WouldBlock
            | ErrorKind::TimedOut
            | ErrorKind::Interrupted
            | ErrorKind::ConnectionReset
            | ErrorKind::ConnectionRefused => None,
            _ => return Err(error),
        },
    };
    let Inside {
        flight,
        desk,
        client,
    } = &mut *lock(inside);
    let mut packets = Vec::new();
    if let Some((length, from)) = received {
        *client = Some(from);
        packets = desk.answer(&buffer[..length], flight);
    }
    flight.tick();
    packets.extend(desk.due(flight));
    if let Some(client) = *client {
        for packet in packets {
            // A client that is gone no longer takes part.
            let _ = socket.send_to(&packet, client);
        }
    }
    Ok(())
}

fn lock<T>(shared: &Mutex<T>) -> MutexGuard<'_, T> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}
