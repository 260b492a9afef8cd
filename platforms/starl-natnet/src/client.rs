//! The client: follows one body by its name.

use crate::{COMMAND_PORT, Frame, Message, RigidBody, Version};
use starl_core::{Point, Pose};
use std::io::{self, ErrorKind};
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, UdpSocket};
use std::time::{Duration, Instant};
use thiserror::Error;

/// Which axis of the server points up; a setting of Motive's stream.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UpAxis {
    /// As on our floor.
    #[default]
    Z,
    /// Motive's default. Its z axis then becomes our -y.
    Y,
}

/// The server and the body to follow.
#[derive(Clone, Debug)]
pub struct NatNetOptions {
    /// The server's command port.
    pub server: SocketAddr,
    /// The name of the rigid body in Motive.
    pub body: String,
    /// The names of other bodies whose poses are also read. The server need not know them.
    pub others: Vec<String>,
    /// Which axis points up.
    pub up: UpAxis,
}

impl NatNetOptions {
    /// The body of this name, from the server at its usual port.
    pub fn new(server: IpAddr, body: &str) -> NatNetOptions {
        NatNetOptions {
            server: (server, COMMAND_PORT).into(),
            body: body.to_string(),
            others: Vec::new(),
            up: UpAxis::default(),
        }
    }
}

/// The reason for missing positions.
#[derive(Debug, Error)]
pub enum NatNetError {
    /// The connection failed.
    #[error("the connection failed: {0}")]
    Io(#[from] io::Error),
    /// The server has said nothing for a second.
    #[error("the OptiTrack server at {0} is silent; does Motive stream unicast to this machine?")]
    Silent(SocketAddr),
    /// The server does not know the body.
    #[error("Motive has no rigid body `{body}`; it has {}", known.join(", "))]
    Unknown {
        /// The body's name.
        body: String,
        /// Those that it knows.
        known: Vec<String>,
    },
    /// The server speaks a version of the protocol that has other frames.
    #[error("Motive streams NatNet {}.{}; set its bit stream version to 3.0 to 4.1", .0.0, .0.1)]
    Version(Version),
}

/// How often the server is asked to continue, and how long it may be silent.
const KEEP_ALIVE: Duration = Duration::from_millis(500);
const SILENCE: Duration = Duration::from_millis(1000);
/// Versions whose frames are understood.
const VERSIONS: std::ops::RangeInclusive<Version> = (3, 0)..=(4, 1);

/// A body followed by motion capture.
#[derive(Debug)]
pub struct NatNet {
    socket: UdpSocket,
    options: NatNetOptions,
    version: Option<Version>,
    ticks_per_second: u64,
    bodies: Vec<(u32, String)>,
    /// The body's number, once the server has said it.
    number: Option<u32>,
    last_frame: Option<u32>,
    sighting: Option<(Instant, Pose)>,
    /// The latest pose of each of the other bodies, in the order of the options.
    others: Vec<Option<(Instant, Pose)>>,
    asked: Option<Instant>,
    heard: Instant,
}

impl NatNet {
    /// Opens a socket and asks the server for its stream. A server that does not answer shows in [`NatNet::poll`].
    ///
    /// # Errors
    /// If no socket can be opened, or the network has no way to the server.
    pub fn connect(options: NatNetOptions) -> Result<NatNet, NatNetError> {
        let any: IpAddr = match options.server {
            SocketAddr::V4(_) => Ipv4Addr::UNSPECIFIED.into(),
            SocketAddr::V6(_) => Ipv6Addr::UNSPECIFIED.into(),
        };
        let socket = UdpSocket::bind((any, 0))?;
        socket.connect(options.server)?;
        socket.set_nonblocking(true)?;
        Ok(NatNet {
            socket,
            others: vec![None; options.others.len()],
            options,
            version: None,
            ticks_per_second: 0,
            bodies: Vec::new(),
            number: None,
            last_frame: None,
            sighting: None,
            asked: None,
            heard: Instant::now(),
        })
    }

    /// The latest pose that has arrived since the last call, and when the cameras saw it; `None` if there is no new
    /// one, as when the body is hidden. Does not block. Call it several times a second, because this keeps the server
    /// sending.
    ///
    /// # Errors
    /// The server cannot be reached, is silent, or does not know the body. Call again: it may return.
    pub fn poll(&mut self) -> Result<Option<(Instant, Pose)>, NatNetError> {
        if self.asked.is_none_or(|asked| asked.elapsed() > KEEP_ALIVE) {
            self.ask()?;
        }
        let mut buffer = [0; 65_536];
        loop {
            match self.socket.recv(&mut buffer) {
                Ok(length) => self.take(&buffer[..length])?,
                Err(error) => match error.kind() {
                    // No process listens there: treated as silence.
                    ErrorKind::WouldBlock | ErrorKind::ConnectionRefused => break,
                    ErrorKind::Interrupted => {}
                    _ => return Err(error.into()),
                },
            }
        }
        if self.heard.elapsed() > SILENCE {
            self.heard = Instant::now();
            // A server that restarts may renumber its frames and bodies.
            self.version = None;
            self.number = None;
            self.last_frame = None;
            return Err(NatNetError::Silent(self.options.server));
        }
        Ok(self.sighting.take())
    }

    /// The latest poses of the other bodies that have arrived since the last call: the place of each in
    /// [`NatNetOptions::others`], and when the cameras saw it. Bodies that are hidden or unknown are left out.
    /// [`NatNet::poll`] takes them in.
    pub fn others(&mut self) -> impl Iterator<Item = (usize, Instant, Pose)> {
        let others = self.others.iter_mut().enumerate();
        others.filter_map(|(index, seen)| seen.take().map(|(at, pose)| (index, at, pose)))
    }

    fn ask(&mut self) -> Result<(), NatNetError> {
        self.asked = Some(Instant::now());
        let message = match (self.version, self.number) {
            (None, _) => Message::Connect,
            (Some(_), None) => Message::RequestDescriptions,
            (Some(_), Some(_)) => Message::KeepAlive,
        };
        let datagram = message.encode(self.version.unwrap_or((3, 0)));
        match self.socket.send(&datagram) {
            Err(error) if error.kind() != ErrorKind::ConnectionRefused => Err(error.into()),
            _ => Ok(()),
        }
    }

    fn take(&mut self, datagram: &[u8]) -> Result<(), NatNetError> {
        let now = Instant::now();
        match Message::decode(datagram, self.version.unwrap_or((3, 0))) {
            Some(Message::ServerInfo(info)) => {
                if !VERSIONS.contains(&info.version) {
                    return Err(NatNetError::Version(info.version));
                }
                self.heard = now;
                self.ticks_per_second = info.ticks_per_second;
                self.version = Some(info.version);
                self.ask()?;
            }
            Some(Message::Descriptions(bodies)) => {
                self.heard = now;
                let named = |(number, name): &(u32, String)| {
                    (*name == self.options.body).then_some(*number)
                };
                self.number = bodies.iter().find_map(named);
                self.bodies = bodies;
                if self.number.is_none() {
                    return Err(NatNetError::Unknown {
                        body: self.options.body.clone(),
                        known: self.bodies.iter().map(|(_, name)| name.clone()).collect(),
                    });
                }
            }
            Some(Message::Frame(frame)) if self.version.is_some() => {
                self.heard = now;
                self.look(&frame, now);
            }
            _ => {}
        }
        Ok(())
    }

    fn look(&mut self, frame: &Frame, now: Instant) {
        let newer = |last: u32| (frame.number.wrapping_sub(last) as i32) > 0;
        if !self.last_frame.is_none_or(newer) {
            return;
        }
        self.last_frame = Some(frame.number);
        let at = now.checked_sub(self.age(frame)).unwrap_or(now);
        for body in frame.bodies.iter().filter(|body| body.tracked) {
            let Some(pose) = pose(body, self.options.up) else {
                continue;
            };
            if Some(body.number) == self.number {
                self.sighting = Some((at, pose));
                continue;
            }
            let named = |(number, _): &&(u32, String)| *number == body.number;
            let name = self.bodies.iter().find(named).map(|(_, name)| name);
            let wanted = self
                .options
                .others
                .iter()
                .position(|other| Some(other) == name);
            if let Some(index) = wanted {
                self.others[index] = Some((at, pose));
            }
        }
    }

    /// How long before it was sent the frame was taken; a second at most, as no camera system takes longer.
    fn age(&self, frame: &Frame) -> Duration {
        if self.ticks_per_second == 0 {
            return Duration::ZERO;
        }
        let ticks = frame.sent.saturating_sub(frame.exposed);
        Duration::from_secs_f64((ticks as f64 / self.ticks_per_second as f64).min(1.0))
    }
}

/// The pose of a body in our axes; `None` if a number is none.
fn pose(body: &RigidBody, up: UpAxis) -> Option<Pose> {
    let turned = |[x, y, z]: [f64; 3]| match up {
        UpAxis::Z => [x, y, z],
        UpAxis::Y => [x, -z, y],
    };
    let [x, y, z] = turned(body.position.map(f64::from));
    let [i, j, k, w] = body.rotation.map(f64::from);
    let [i, j, k] = turned([i, j, k]);
    Pose::of_quaternion(Point::new(x, y, z), [i, j, k, w])
}
