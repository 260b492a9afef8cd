//! A simulated device whose body is in a world of another process, together with emulated robots: it collides with them and
//! with the world's obstacles.
//!
//! Every few milliseconds it sends the body's command in a datagram, and the world answers with the body's state. Datagrams
//! are in postcard's encoding and not protected, since the world stands for the physical one.

use crate::motors::PositionSource;
use crate::simulated::reading;
use crate::{Device, DeviceError, Reading};
use serde::{Deserialize, Serialize};
use starl_core::sensor::Contact;
use starl_core::{Command, Duration, Estimate, Pose, Twist, message};
use starl_motion::Model;
use std::io::ErrorKind;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, UdpSocket};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// A world that does not answer for longer is missing.
const SILENCE: std::time::Duration = std::time::Duration::from_millis(1000);

/// Answers overtake each other by less than this.
const RESTART: Duration = Duration::from_millis(1000);

/// A body's command, until the next one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Drive {
    /// The body's name in the world.
    pub body: String,
    /// The command.
    pub command: Command,
}

/// The answer: the state of the body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Driven {
    /// The world's time.
    pub elapsed: Duration,
    /// Where the body is.
    pub pose: Pose,
    /// How it moves, world frame.
    pub twist: Twist,
    /// The place where it touches something.
    pub contact: Option<Contact>,
}

impl Drive {
    /// The content of its datagram.
    pub fn encode(&self) -> Vec<u8> {
        message::encode(self).to_vec()
    }

    /// Reads a datagram.
    pub fn decode(bytes: &[u8]) -> Option<Drive> {
        message::decode(bytes)
    }
}

impl Driven {
    /// The content of its datagram.
    pub fn encode(&self) -> Vec<u8> {
        message::encode(self).to_vec()
    }

    /// Reads a datagram; numbers that are not finite are no state.
    pub fn decode(bytes: &[u8]) -> Option<Driven> {
        let driven: Driven = message::decode(bytes)?;
        let Pose {
            position,
            yaw,
            pitch,
            roll,
        } = driven.pose;
        let is_finite = position.is_finite()
            && driven.twist.linear.is_finite()
            && [yaw, pitch, roll, driven.twist.yaw]
                .iter()
                .all(|number| number.is_finite())
            && driven
                .contact
                .is_none_or(|contact| contact.bearing.is_finite());
        is_finite.then_some(driven)
    }
}

/// A body in a world. Clones are the same body.
#[derive(Clone, Debug)]
pub struct WorldBody(Arc<Mutex<Link>>);

#[derive(Debug)]
struct Link {
    socket: UdpSocket,
    world: SocketAddr,
    model: Arc<dyn Model>,
    drive: Drive,
    latest: Option<(Instant, Driven)>,
    heard: Instant,
}

impl WorldBody {
    /// The body of this name in the world at this address, which need not be there yet.
    ///
    /// # Errors
    /// If no socket can be opened.
    pub fn new(
        world: SocketAddr,
        name: &str,
        model: Arc<dyn Model>,
    ) -> Result<WorldBody, DeviceError> {
        let any: IpAddr = match world {
            SocketAddr::V4(_) => Ipv4Addr::UNSPECIFIED.into(),
            SocketAddr::V6(_) => Ipv6Addr::UNSPECIFIED.into(),
        };
        let socket = UdpSocket::bind((any, 0))?;
        socket.connect(world)?;
        socket.set_nonblocking(true)?;
        let drive = Drive {
            body: name.to_string(),
            command: Command::Stop,
        };
        Ok(WorldBody(Arc::new(Mutex::new(Link {
            socket,
            world,
            model,
            drive,
            latest: None,
            heard: Instant::now(),
        }))))
    }

    /// Its motors and sensors.
    pub fn device(&self) -> WorldDevice {
        WorldDevice {
            body: self.clone(),
            last: None,
        }
    }

    /// The source of its positions, with this period.
    pub fn positions(&self, period: Duration) -> WorldPositions {
        WorldPositions {
            body: self.clone(),
            period: period.into(),
            next: Instant::now(),
        }
    }

    fn lock(&self) -> MutexGuard<'_, Link> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Link {
    fn command(&mut self, command: Command) -> Result<(), DeviceError> {
        self.drive.command = command;
        self.send()
    }

    fn send(&self) -> Result<(), DeviceError> {
        match self.socket.send(&self.drive.encode()) {
            // No process listens there: treated as silence.
            Err(error) if error.kind() != ErrorKind::ConnectionRefused => Err(error.into()),
            _ => Ok(()),
        }
    }

    /// Takes the answers that have arrived.
    fn listen(&mut self) -> Result<(), DeviceError> {
        let mut buffer = [0; 512];
        loop {
            match self.socket.recv(&mut buffer) {
                Ok(length) => {
                    let driven = Driven::decode(&buffer[..length]);
                    let latest = self.latest.map(|(_, latest)| latest.elapsed);
                    // A world whose time is much earlier has restarted.
                    let is_new = |driven: &Driven| {
                        latest.is_none_or(|latest| {
                            driven.elapsed > latest || driven.elapsed + RESTART < latest
                        })
                    };
                    if let Some(driven) = driven.filter(is_new) {
                        self.heard = Instant::now();
                        self.latest = Some((self.heard, driven));
                    }
                }
                Err(error) => match error.kind() {
                    ErrorKind::WouldBlock | ErrorKind::ConnectionRefused => break,
                    ErrorKind::Interrupted => {}
                    _ => return Err(error.into()),
                },
            }
        }
        if self.heard.elapsed() > SILENCE {
            return Err(DeviceError::Fault(format!(
                "the world at {} has no body `{}` or does not answer; `starl fleet up --emulate` and `starl emulate fleet` serve it",
                self.world, self.drive.body
            )));
        }
        Ok(())
    }
}

impl Drop for Link {
    fn drop(&mut self) {
        let model = &self.model;
        let _ = self.command(end(&**model));
    }
}

/// The command that ends all motion.
fn end(model: &dyn Model) -> Command {
    match model.accepts(&Command::Land) {
        true => Command::Land,
        false => Command::Stop,
    }
}

/// The motors, the bumper and the odometry of a [`WorldBody`].
#[derive(Debug)]
pub struct WorldDevice {
    body: WorldBody,
    last: Option<Pose>,
}

impl Device for WorldDevice {
    fn drive(&mut self, command: &Command, _: &Estimate) -> Result<(), DeviceError> {
        let mut link = self.body.lock();
        if !link.model.accepts(command) {
            link.command(Command::Stop)?;
            let model = link.model.name();
            return Err(DeviceError::Fault(format!(
                "the model {model} cannot do {command:?}"
            )));
        }
        link.command(*command)
    }

    fn stop(&mut self) -> Result<(), DeviceError> {
        let mut link = self.body.lock();
        let command = end(&*link.model);
        link.command(command)
    }

    fn read(&mut self) -> Result<Option<Reading>, DeviceError> {
        let mut link = self.body.lock();
        link.send()?;
        link.listen()?;
        let Some((_, driven)) = link.latest else {
            return Ok(None);
        };
        let last = self.last.replace(driven.pose).unwrap_or(driven.pose);
        Ok(Some(Reading {
            bumper: Some(driven.contact),
            ..reading(&last, &driven.pose, &driven.twist)
        }))
    }
}

/// Tells where a [`WorldBody`] is.
#[derive(Debug)]
pub struct WorldPositions {
    body: WorldBody,
    period: std::time::Duration,
    next: Instant,
}

impl PositionSource for WorldPositions {
    fn poll(&mut self) -> Result<Option<(Instant, Pose)>, DeviceError> {
        let now = Instant::now();
        let latest = self.body.lock().latest;
        // The same state twice is no new position.
        let Some((at, driven)) = latest.filter(|(at, _)| now >= self.next && *at >= self.next)
        else {
            return Ok(None);
        };
        self.next = now + self.period;
        Ok(Some((at, driven.pose)))
    }
}
