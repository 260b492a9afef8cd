//! UDP: each robot has a socket, and a message to all is one packet for each other robot. No multicast is needed.

use super::{Arrival, Member, Origin, Transport};
use std::collections::BTreeMap;
use std::io;
use std::net::{SocketAddr, UdpSocket};
use std::sync::Arc;
use std::thread;
use std::time::Instant;

/// The longest UDP payload, bytes.
const LONGEST: usize = 65_507;

/// A socket and where the other members are.
#[derive(Debug)]
pub struct Udp {
    socket: Arc<UdpSocket>,
    places: BTreeMap<Member, SocketAddr>,
}

impl Udp {
    /// Opens a socket at `address`, and hands what arrives to `deliver` on a thread of its own until that returns
    /// false.
    ///
    /// # Errors
    /// If the address is not one of this machine's, or is in use.
    pub fn open(
        address: SocketAddr,
        places: BTreeMap<Member, SocketAddr>,
        mut deliver: impl FnMut(Arrival) -> bool + Send + 'static,
    ) -> io::Result<Udp> {
        let socket = Arc::new(UdpSocket::bind(address)?);
        let receiver = socket.clone();
        thread::Builder::new()
            .name("udp".to_string())
            .spawn(move || {
                let mut room = vec![0; LONGEST];
                loop {
                    match receiver.recv_from(&mut room) {
                        Ok((length, from)) => {
                            let arrival = Arrival {
                                at: Instant::now(),
                                origin: Origin::Socket(from),
                                packet: room[..length].to_vec(),
                            };
                            if !deliver(arrival) {
                                return;
                            }
                        }
                        // A peer that is not there shows as a refused connection on some systems.
                        Err(error) if is_passing(&error) => {}
                        Err(_) => thread::sleep(std::time::Duration::from_millis(10)),
                    }
                }
            })?;
        Ok(Udp { socket, places })
    }

    /// Where the socket is.
    ///
    /// # Errors
    /// If the system does not say.
    pub fn address(&self) -> io::Result<SocketAddr> {
        self.socket.local_addr()
    }
}

fn is_passing(error: &io::Error) -> bool {
    use io::ErrorKind::{ConnectionRefused, ConnectionReset, Interrupted};
    matches!(
        error.kind(),
        ConnectionRefused | ConnectionReset | Interrupted
    )
}

impl Transport for Udp {
    fn send(&mut self, to: Member, packet: &[u8]) -> io::Result<()> {
        let place = self
            .places
            .get(&to)
            .ok_or(io::ErrorKind::AddrNotAvailable)?;
        match self.socket.send_to(packet, place) {
            Err(error) if is_passing(&error) => Ok(()),
            sent => sent.map(|_| ()),
        }
    }

    fn learn(&mut self, member: Member, origin: Origin) {
        if let Origin::Socket(place) = origin {
            self.places.insert(member, place);
        }
    }
}
