//! Bodies of a world that processes of simulated robots drive: see [`starl_node::world_body`].

use crate::BodyHandle;
use crate::service::Service;
use starl_core::Command;
use starl_node::world_body::{Drive, Driven};
use std::collections::BTreeMap;
use std::io;
use std::net::{SocketAddr, UdpSocket};
use std::time::{Duration, Instant};

/// A body whose process is silent for so long stops, or lands.
pub const WATCHDOG: Duration = Duration::from_millis(500);

/// The server of these bodies. Dropping it stops it.
#[derive(Debug)]
pub struct EmulatedBodies {
    address: SocketAddr,
    _service: Service,
}

struct Server {
    socket: UdpSocket,
    bodies: BTreeMap<String, (BodyHandle, Option<Instant>)>,
}

impl EmulatedBodies {
    /// Serves these bodies by their names at `address`; port 0 takes any free port.
    ///
    /// # Errors
    /// If the address is in use or not this machine's.
    pub fn start(bodies: Vec<BodyHandle>, address: SocketAddr) -> io::Result<EmulatedBodies> {
        let socket = UdpSocket::bind(address)?;
        socket.set_read_timeout(Some(Duration::from_millis(20)))?;
        let address = socket.local_addr()?;
        let bodies = bodies.into_iter().map(|body| (body.name(), (body, None)));
        let mut server = Server {
            socket,
            bodies: bodies.collect(),
        };
        Ok(EmulatedBodies {
            address,
            _service: Service::start(move || {
                server.turn();
                Ok(())
            }),
        })
    }

    /// Where it takes commands.
    pub fn address(&self) -> SocketAddr {
        self.address
    }
}

impl Server {
    fn turn(&mut self) {
        let mut buffer = [0; 2048];
        if let Ok((length, client)) = self.socket.recv_from(&mut buffer)
            && let Some(drive) = Drive::decode(&buffer[..length])
            && let Some((body, heard)) = self.bodies.get_mut(&drive.body)
        {
            if body.model().accepts(&drive.command) {
                body.command(drive.command);
                *heard = Some(Instant::now());
            }
            let state = body.state();
            let driven = Driven {
                elapsed: body.elapsed(),
                pose: state.pose,
                twist: state.twist,
                contact: body.bumper(),
            };
            // A process that has ended hears nothing.
            let _ = self.socket.send_to(&driven.encode(), client);
        }
        for (body, heard) in self.bodies.values_mut() {
            if heard.is_some_and(|heard| heard.elapsed() > WATCHDOG) {
                *heard = None;
                let lands = body.model().accepts(&Command::Land);
                body.command(if lands { Command::Land } else { Command::Stop });
            }
        }
    }
}
