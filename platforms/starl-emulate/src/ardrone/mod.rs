//! An emulated AR.Drone 2: the model `drone` behind AT commands and navdata.
//!
//! It differs from hardware in this: it takes off to the model's safe height, an emergency lands it instead of letting it
//! fall, and it has no camera, flips or GPS. Like the real one it hovers when it has heard nothing for 2 s, until its
//! battery is almost empty, and then lands.

mod flight;

use crate::BodyHandle;
use crate::service::Service;
use flight::Flight;
use starl_ardrone::at;
use std::io::{self, ErrorKind};
use std::net::{SocketAddr, UdpSocket};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// A drone on two UDP ports. Dropping it stops the body where it is and closes the ports.
#[derive(Debug)]
pub struct EmulatedArdrone {
    commands: SocketAddr,
    sockets: Arc<Sockets>,
    flight: Arc<Mutex<Flight>>,
    service: Service,
}

#[derive(Debug)]
struct Sockets {
    commands: UdpSocket,
    navdata: UdpSocket,
    /// The receiver of navdata.
    client: Mutex<Option<SocketAddr>>,
}

/// How often navdata is sent: 15 times a second.
const PERIOD: Duration = Duration::from_millis(67);
/// How long the drone waits for commands before it looks what else there is to do.
const WAIT: Duration = Duration::from_millis(5);

impl EmulatedArdrone {
    /// Puts `body` behind these addresses; port 0 takes any free port.
    ///
    /// # Errors
    /// If an address is in use or not this machine's.
    pub fn start(
        body: BodyHandle,
        commands: SocketAddr,
        navdata: SocketAddr,
    ) -> io::Result<EmulatedArdrone> {
        let sockets = Arc::new(Sockets {
            commands: UdpSocket::bind(commands)?,
            navdata: UdpSocket::bind(navdata)?,
            client: Mutex::new(None),
        });
        sockets.commands.set_read_timeout(Some(WAIT))?;
        sockets.navdata.set_nonblocking(true)?;
        let commands = sockets.commands.local_addr()?;
        let flight = Arc::new(Mutex::new(Flight::new(body)));
        let service = {
            let (sockets, flight) = (sockets.clone(), flight.clone());
            let mut due = Instant::now();
            Service::start(move || turn(&sockets, &flight, &mut due))
        };
        Ok(EmulatedArdrone {
            commands,
            sockets,
            flight,
            service,
        })
    }

    /// Where it takes AT commands.
    pub fn commands(&self) -> SocketAddr {
        self.commands
    }

    /// Where it gives navdata.
    ///
    /// # Errors
    /// If the system does not tell the port.
    pub fn navdata(&self) -> io::Result<SocketAddr> {
        self.sockets.navdata.local_addr()
    }

    /// Sends the client bytes from the navdata port, between those of the drone.
    pub fn interfere(&self, bytes: &[u8]) {
        if let Some(client) = *lock(&self.sockets.client) {
            let _ = self.sockets.navdata.send_to(bytes, client);
        }
    }

    /// Whether its motors are cut.
    pub fn emergency(&self) -> bool {
        lock(&self.flight).emergency()
    }
}

impl Drop for EmulatedArdrone {
    fn drop(&mut self) {
        self.service.end();
        lock(&self.flight).halt();
    }
}

fn turn(sockets: &Sockets, flight: &Mutex<Flight>, due: &mut Instant) -> io::Result<()> {
    let mut buffer = [0; 2048];
    if let Some((length, _)) = arrived(sockets.commands.recv_from(&mut buffer))? {
        let mut flight = lock(flight);
        for (sequence, command) in at::decode(&buffer[..length]) {
            flight.take(sequence, &command);
        }
    }
    while let Some((_, client)) = arrived(sockets.navdata.recv_from(&mut buffer))? {
        *lock(&sockets.client) = Some(client);
        lock(flight).hear();
        *due = Instant::now();
    }
    let mut flight = lock(flight);
    flight.watch();
    if flight.lost() {
        *lock(&sockets.client) = None;
    }
    if Instant::now() >= *due {
        *due = Instant::now() + PERIOD;
        if let Some(client) = *lock(&sockets.client) {
            // A client that is gone is noticed by its silence.
            let _ = sockets.navdata.send_to(&flight.navdata().encode(), client);
        }
    }
    Ok(())
}

/// The datagram that has arrived, if any. A closed client is not an error.
fn arrived<T>(received: io::Result<T>) -> io::Result<Option<T>> {
    match received {
        Ok(what) => Ok(Some(what)),
        Err(error) => match error.kind() {
            ErrorKind::WouldBlock
            | ErrorKind::TimedOut
            | ErrorKind::Interrupted
            | ErrorKind::ConnectionReset
            | ErrorKind::ConnectionRefused => Ok(None),
            _ => Err(error),
        },
    }
}

fn lock<T>(shared: &Mutex<T>) -> MutexGuard<'_, T> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}
