//! An emulated OptiTrack server: streams the true poses of a world, or poses with errors, by NatNet.
//!
//! The bodies of the world are rigid bodies of the same names. As in Motive's "Unicast" the frames go to each client
//! that has asked within the last seconds. Axes are the world's, with z up.

use crate::World;
use crate::service::Service;
use starl_core::{Pose, Random};
use starl_natnet::{Frame, Message, RigidBody, ServerInfo};
use std::io;
use std::net::{SocketAddr, UdpSocket};
use std::time::{Duration, Instant};

/// How good the cameras are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cameras {
    /// Frames per second.
    pub rate: f64,
    /// Standard deviation of each coordinate, metres.
    pub deviation: f64,
    /// The probability that a body is hidden in a frame.
    pub hidden: f64,
    /// How long the server takes from the cameras' exposure until it sends.
    pub latency: Duration,
    /// Seeds the errors.
    pub seed: u64,
    /// The version of the protocol: from 3.0 to 4.1.
    pub version: starl_natnet::Version,
}

impl Default for Cameras {
    /// Without errors, at 100 frames a second, as Motive 3 speaks.
    fn default() -> Cameras {
        Cameras {
            rate: 100.0,
            deviation: 0.0,
            hidden: 0.0,
            latency: Duration::from_millis(5),
            seed: 0,
            version: (4, 1),
        }
    }
}

/// A server of a world's poses. Dropping it ends the stream.
#[derive(Debug)]
pub struct EmulatedNatNet {
    address: SocketAddr,
    _service: Service,
}

/// How long a client gets frames after it has asked.
const CLIENT_TIME: Duration = Duration::from_secs(3);
/// The server's clock ticks in nanoseconds.
const TICKS_PER_SECOND: u64 = 1_000_000_000;

impl EmulatedNatNet {
    /// Streams from `address`; port 0 takes any free port.
    ///
    /// # Errors
    /// If the address is in use or not this machine's.
    pub fn start(
        world: World,
        address: SocketAddr,
        cameras: Cameras,
    ) -> io::Result<EmulatedNatNet> {
        let socket = UdpSocket::bind(address)?;
        socket.set_nonblocking(true)?;
        let address = socket.local_addr()?;
        let mut server = Server {
            socket,
            world,
            cameras,
            clients: Vec::new(),
            frames: 0,
            start: Instant::now(),
            due: Instant::now(),
        };
        Ok(EmulatedNatNet {
            address,
            _service: Service::start(move || {
                server.turn();
                Ok(())
            }),
        })
    }

    /// Where it takes requests.
    pub fn address(&self) -> SocketAddr {
        self.address
    }
}

struct Server {
    socket: UdpSocket,
    world: World,
    cameras: Cameras,
    clients: Vec<(SocketAddr, Instant)>,
    frames: u32,
    start: Instant,
    due: Instant,
}

impl Server {
    fn turn(&mut self) {
        let mut buffer = [0; 2048];
        while let Ok((length, client)) = self.socket.recv_from(&mut buffer) {
            if let Some(message) = Message::decode(&buffer[..length], self.cameras.version) {
                self.answer(&message, client);
            }
        }
        let now = Instant::now();
        self.clients.retain(|(_, asked)| now - *asked < CLIENT_TIME);
        if now >= self.due {
            self.due = now + Duration::from_secs_f64(1.0 / self.cameras.rate);
            self.stream();
        }
        let wait = self.due.saturating_duration_since(Instant::now());
        std::thread::sleep(wait.min(Duration::from_millis(2)));
    }

    fn answer(&mut self, message: &Message, client: SocketAddr) {
        let answer = match message {
            Message::Connect => Message::ServerInfo(ServerInfo {
                application: "StarL emulated Motive".into(),
                version: self.cameras.version,
                ticks_per_second: TICKS_PER_SECOND,
            }),
            Message::RequestDescriptions => {
                let names = self.world.poses().into_iter().map(|(name, _)| name);
                Message::Descriptions((1..).zip(names).collect())
            }
            Message::KeepAlive => {
                self.keep(client);
                return;
            }
            _ => Message::Unrecognized,
        };
        self.keep(client);
        self.send(&answer, client);
    }

    fn keep(&mut self, client: SocketAddr) {
        self.clients.retain(|(known, _)| *known != client);
        self.clients.push((client, Instant::now()));
    }

    fn stream(&mut self) {
        self.frames = self.frames.wrapping_add(1);
        let bodies = (1u32..).zip(self.world.poses());
        let seen = bodies.map(|(number, (_, pose))| self.see(number, &pose));
        let elapsed = self.start.elapsed() + self.cameras.latency;
        let frame = Message::Frame(Frame {
            number: self.frames,
            bodies: seen.collect(),
            timestamp: elapsed.as_secs_f64(),
            exposed: (elapsed - self.cameras.latency).as_nanos() as u64,
            sent: elapsed.as_nanos() as u64,
        });
        for &(client, _) in &self.clients {
            self.send(&frame, client);
        }
    }

    fn see(&self, number: u32, pose: &Pose) -> RigidBody {
        let Cameras {
            deviation,
            hidden,
            seed,
            ..
        } = self.cameras;
        let mut random = Random::keyed(seed, &[u64::from(number), u64::from(self.frames)]);
        let mut error = || random.normal(0.0, deviation);
        let position = pose.position;
        let position = [position.x, position.y, position.z].map(|value| (value + error()) as f32);
        RigidBody {
            number,
            position,
            rotation: pose.quaternion().map(|part| part as f32),
            error: deviation as f32,
            tracked: !random.chance(hidden),
        }
    }

    /// A client that is gone is forgotten after a while.
    fn send(&self, message: &Message, client: SocketAddr) {
        let _ = self
            .socket
            .send_to(&message.encode(self.cameras.version), client);
    }
}
