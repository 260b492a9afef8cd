//! An emulated VRPN server: streams the true poses of a world as Vicon and others do.
//!
//! The bodies of the world are trackers of the same names. Clients connect over TCP, or ask by UDP to be connected to;
//! either way the stream goes over TCP.

use crate::World;
use crate::service::Service;
use starl_core::Point;
use starl_vrpn::wire::{self, Decoder, KIND_NAME, Message, PING, PLACE, PONG, Place, SENDER_NAME};
use std::collections::BTreeMap;
use std::io::{self, ErrorKind, Read, Write};
use std::net::{SocketAddr, TcpListener, TcpStream, UdpSocket};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

/// A server of a world's poses. Dropping it ends the stream.
#[derive(Debug)]
pub struct EmulatedVrpn {
    address: SocketAddr,
    _service: Service,
}

/// Time between two poses.
const PERIOD: Duration = Duration::from_millis(10);
/// The numbers of the kinds of messages.
const KINDS: [&str; 3] = [PLACE, PING, PONG];

impl EmulatedVrpn {
    /// Streams from `address`, on TCP and UDP; port 0 takes any port that is free for TCP.
    ///
    /// # Errors
    /// If the address is in use or not this machine's.
    pub fn start(world: World, address: SocketAddr) -> io::Result<EmulatedVrpn> {
        let (listener, requests) = bind(address)?;
        let address = listener.local_addr()?;
        listener.set_nonblocking(true)?;
        requests.set_nonblocking(true)?;
        let mut server = Server {
            listener,
            requests,
            world,
            clients: Vec::new(),
            due: Instant::now(),
        };
        Ok(EmulatedVrpn {
            address,
            _service: Service::start(move || {
                server.turn();
                Ok(())
            }),
        })
    }

    /// Where it takes connections.
    pub fn address(&self) -> SocketAddr {
        self.address
    }
}

/// Both sockets at one port. A port that is free for TCP may be in use for UDP; then another one is taken, if any will do.
fn bind(address: SocketAddr) -> io::Result<(TcpListener, UdpSocket)> {
    let mut tries = if address.port() == 0 { 20 } else { 1 };
    loop {
        tries -= 1;
        let listener = TcpListener::bind(address)?;
        match UdpSocket::bind(listener.local_addr()?) {
            Ok(requests) => return Ok((listener, requests)),
            Err(error) if tries == 0 || error.kind() != ErrorKind::AddrInUse => {
                return Err(error);
            }
            Err(_) => {}
        }
    }
}

struct Server {
    listener: TcpListener,
    requests: UdpSocket,
    world: World,
    clients: Vec<Client>,
    due: Instant,
}

impl Server {
    fn turn(&mut self) {
        while let Ok((stream, _)) = self.listener.accept() {
            self.clients.extend(Client::new(stream).ok());
        }
        let mut buffer = [0; 256];
        while let Ok((length, from)) = self.requests.recv_from(&mut buffer) {
            self.clients.extend(call_back(&buffer[..length], from));
        }
        let poses = self.world.poses();
        let names: Vec<&str> = poses.iter().map(|(name, _)| name.as_str()).collect();
        let is_due = Instant::now() >= self.due;
        if is_due {
            self.due = Instant::now() + PERIOD;
        }
        self.clients.retain_mut(|client| {
            let listened = client.listen(&names);
            for (number, (_, pose)) in (0..).zip(&poses).filter(|_| is_due) {
                let Point { x, y, z } = pose.position;
                let place = Place {
                    sensor: 0,
                    position: [x, y, z],
                    rotation: pose.quaternion(),
                };
                client.put(number, PLACE, place.encode());
            }
            listened.and_then(|()| client.flush()).is_ok()
        });
        let wait = self.due.saturating_duration_since(Instant::now());
        std::thread::sleep(wait.min(Duration::from_millis(2)));
    }
}

/// Connects to a client that has asked for it: `ADDRESS PORT`. Only to the machine that has asked.
fn call_back(request: &[u8], from: SocketAddr) -> Option<Client> {
    let text = str::from_utf8(request).ok()?.trim_end_matches('\0');
    let port: u16 = text.split_once(' ')?.1.trim().parse().ok()?;
    let address = SocketAddr::new(from.ip(), port);
    let stream = TcpStream::connect_timeout(&address, Duration::from_millis(200)).ok()?;
    Client::new(stream).ok()
}

struct Client {
    stream: TcpStream,
    decoder: Decoder,
    /// The client's own names of senders and kinds.
    senders: BTreeMap<i32, String>,
    kinds: BTreeMap<i32, String>,
    /// The number of bodies whose names it has received.
    told: usize,
    out: Vec<u8>,
}

impl Client {
    fn new(stream: TcpStream) -> io::Result<Client> {
        stream.set_nonblocking(true)?;
        stream.set_nodelay(true)?;
        let mut out = wire::greeting().to_vec();
        for (number, kind) in (0..).zip(KINDS) {
            Message::naming(KIND_NAME, number, kind).encode(&mut out);
        }
        Ok(Client {
            stream,
            decoder: Decoder::default(),
            senders: BTreeMap::new(),
            kinds: BTreeMap::new(),
            told: 0,
            out,
        })
    }

    /// Takes what the client has sent, and answers its questions.
    fn listen(&mut self, names: &[&str]) -> io::Result<()> {
        for (number, name) in (0..).zip(names).skip(self.told) {
            Message::naming(SENDER_NAME, number, name).encode(&mut self.out);
        }
        self.told = names.len();
        let mut buffer = [0; 2048];
        loop {
            match self.stream.read(&mut buffer) {
                Ok(0) => return Err(ErrorKind::ConnectionAborted.into()),
                Ok(length) => self.decoder.push(&buffer[..length]),
                Err(error) if error.kind() == ErrorKind::WouldBlock => break,
                Err(error) => return Err(error),
            }
        }
        while let Some(message) = self.decoder.pop().map_err(io::Error::other)? {
            match (message.kind, message.name()) {
                (SENDER_NAME, Some(name)) => {
                    self.senders.insert(message.sender, name);
                }
                (KIND_NAME, Some(name)) => {
                    self.kinds.insert(message.sender, name);
                }
                (kind, _) if self.kinds.get(&kind).is_some_and(|name| name == PING) => {
                    let sender = self.senders.get(&message.sender);
                    let number = names
                        .iter()
                        .position(|name| Some(*name) == sender.map(|s| &**s));
                    if let Some(number) = number {
                        self.put(number as i32, PONG, Vec::new());
                    }
                }
                _ => {}
            }
        }
        Ok(())
    }

    fn put(&mut self, sender: i32, kind: &str, body: Vec<u8>) {
        let now = SystemTime::now()
            .duration_since(UNIX_EPOCH)
            .unwrap_or_default();
        let kind = KINDS.iter().position(|name| *name == kind);
        let message = Message {
            time: (now.as_secs() as u32, now.subsec_micros()),
            sender,
            kind: kind.map_or(0, |kind| kind as i32),
            body,
        };
        message.encode(&mut self.out);
    }

    /// Sends what it can. A client that does not read for long is dropped.
    fn flush(&mut self) -> io::Result<()> {
        while !self.out.is_empty() {
            match self.stream.write(&self.out) {
                Ok(length) => drop(self.out.drain(..length)),
                Err(error) if error.kind() == ErrorKind::WouldBlock => break,
                Err(error) => return Err(error),
            }
        }
        match self.out.len() > 1 << 20 {
            true => Err(ErrorKind::TimedOut.into()),
            false => Ok(()),
        }
    }
}
