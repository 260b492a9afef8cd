//! The driver: commands of the platform to set-points and manoeuvres, the log to readings.

use crate::commander::{Order, SetPoint};
use crate::packet::Packet;
use crate::telemetry::{News, State, Telemetry};
use starl_core::math::{degrees, sincos};
use starl_core::{Command, Estimate, Point};
use starl_node::{Device, DeviceError, Reading};
use std::io::ErrorKind;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, UdpSocket};
use std::time::{Duration, Instant};

/// How to fly a Crazyflie.
#[derive(Clone, Copy, Debug)]
pub struct CrazyflieOptions {
    /// Where it is.
    pub address: SocketAddr,
    /// How high it takes off, metres.
    pub take_off_height: f64,
    /// How fast it takes off and lands, metres per second.
    pub take_off_speed: f64,
}

impl CrazyflieOptions {
    /// The Crazyflie at `address`.
    pub fn new(address: SocketAddr) -> CrazyflieOptions {
        CrazyflieOptions {
            address,
            take_off_height: 0.6,
            take_off_speed: 0.4,
        }
    }
}

/// A Crazyflie that is silent for so long is out of reach. It sends its state 20 times a second.
const SILENCE: Duration = Duration::from_millis(1000);
/// How often a manoeuvre is asked for until the Crazyflie shows that it flies it.
const REPEAT: Duration = Duration::from_millis(800);
/// The greatest motion of a Crazyflie between two readings, metres: a greater one means that its estimator was reset.
const JUMP: f64 = 0.5;

/// A Crazyflie.
///
/// It takes off and lands by itself, and between them follows set-points. Where these stop it levels out after 0.5 s and
/// stops its motors after 2 s, so the driver has it land when it is dropped. It estimates its own position: it needs a deck
/// for that (Flow, Lighthouse, Loco) or a system that sends it positions.
#[derive(Debug)]
pub struct Crazyflie {
    socket: UdpSocket,
    options: CrazyflieOptions,
    telemetry: Telemetry,
    /// When that began.
    begun: Instant,
    state: Option<State>,
    fresh: bool,
    heard: Instant,
    /// The position of the last reading.
    last: Option<Point>,
    /// Whether it is to be in the air; unknown until it says whether it is.
    fly: Option<bool>,
    asked: Option<Instant>,
}

impl Crazyflie {
    /// Opens the socket. A Crazyflie that does not answer shows in [`Device::read`].
    ///
    /// # Errors
    /// If no socket can be opened, or the network has no way to the Crazyflie.
    pub fn connect(options: &CrazyflieOptions) -> Result<Crazyflie, DeviceError> {
        let any: IpAddr = match options.address {
            SocketAddr::V4(_) => Ipv4Addr::UNSPECIFIED.into(),
            SocketAddr::V6(_) => Ipv6Addr::UNSPECIFIED.into(),
        };
        let socket = UdpSocket::bind((any, 0))?;
        socket.connect(options.address)?;
        socket.set_nonblocking(true)?;
        Ok(Crazyflie {
            socket,
            options: *options,
            telemetry: Telemetry::new(),
            begun: Instant::now(),
            state: None,
            fresh: false,
            heard: Instant::now(),
            last: None,
            fly: None,
            asked: None,
        })
    }

    /// Sends a packet. If no process listens, there is no error, only silence.
    fn send(&self, packet: &Packet) -> Result<(), DeviceError> {
        match self.socket.send(&packet.encode()) {
            Err(error) if error.kind() != ErrorKind::ConnectionRefused => Err(error.into()),
            _ => Ok(()),
        }
    }

    fn order(&self, order: Order) -> Result<(), DeviceError> {
        self.send(&order.encode())
    }

    /// Takes what has arrived.
    fn listen(&mut self) -> Result<(), DeviceError> {
        let mut buffer = [0; 64];
        loop {
            let length = match self.socket.recv(&mut buffer) {
                Ok(length) => length,
                Err(error) => match error.kind() {
                    // No process listens there: treated as silence.
                    ErrorKind::WouldBlock | ErrorKind::ConnectionRefused => return Ok(()),
                    ErrorKind::Interrupted => continue,
                    _ => return Err(error.into()),
                },
            };
            let packet = Packet::decode(&buffer[..length]);
            let news = packet.and_then(|packet| self.telemetry.take(&packet));
            if news.is_some() {
                self.heard = Instant::now();
            }
            if let Some(News::State(state)) = news {
                self.fly = self.fly.or(Some(state.flying()));
                self.fresh = true;
                self.state = Some(state);
            }
            if let Some(request) = self.telemetry.request() {
                self.send(&request)?;
            }
        }
    }

    /// Fails while it is silent or cannot fly.
    fn check(&self) -> Result<(), DeviceError> {
        let fault = |text: String| Err(DeviceError::Fault(text));
        if let Some(variable) = self.telemetry.missing() {
            return fault(format!(
                "the Crazyflie does not log {variable}; update its firmware"
            ));
        }
        if self.heard.elapsed() > SILENCE {
            let address = self.options.address;
            return fault(format!(
                "the Crazyflie at {address} is silent; is it switched on and in reach?"
            ));
        }
        match self.state.and_then(|state| state.fault()) {
            Some(why) => fault(format!("the Crazyflie {why}")),
            None => Ok(()),
        }
    }

    /// Whether a manoeuvre may be asked for now.
    fn may_ask(&mut self) -> bool {
        let may = self.asked.is_none_or(|at| at.elapsed() >= REPEAT);
        if may {
            self.asked = Some(Instant::now());
        }
        may
    }

    fn set_fly(&mut self, fly: bool) {
        if self.fly.replace(fly) != Some(fly) {
            self.asked = None;
        }
    }

    fn take_off(&mut self) -> Result<(), DeviceError> {
        let Some(state) = self.state else {
            return Ok(());
        };
        if state.flying() || !self.may_ask() {
            return Ok(());
        }
        if !state.armed() {
            self.order(Order::Arm(true))?;
        }
        let CrazyflieOptions {
            take_off_height,
            take_off_speed,
            ..
        } = self.options;
        self.order(Order::TakeOff {
            height: take_off_height as f32,
            duration: (take_off_height / take_off_speed) as f32,
        })
    }

    fn land(&mut self) -> Result<(), DeviceError> {
        if self.state.is_some_and(|state| !state.flying()) || !self.may_ask() {
            return Ok(());
        }
        let height = self.state.map_or(1.0, |state| state.position.z.max(0.1));
        self.order(Order::ReleaseSetPoints)?;
        self.order(Order::Land {
            duration: (height / self.options.take_off_speed) as f32,
        })
    }
}

/// The set-point for a command in the air; none if a Crazyflie cannot do it.
fn set_point(command: &Command) -> Option<SetPoint> {
    let still = SetPoint::Velocity {
        velocity: [0.0; 3],
        yaw_rate: 0.0,
    };
    match *command {
        Command::TakeOff | Command::Land | Command::Hover | Command::Stop => Some(still),
        Command::Attitude {
            yaw_rate,
            pitch,
            roll,
            gaz,
        } => {
            let is_finite = [yaw_rate, pitch, roll, gaz].iter().all(|n| n.is_finite());
            is_finite.then(|| SetPoint::Climb {
                roll: degrees(roll) as f32,
                pitch: -degrees(pitch) as f32,
                yaw_rate: degrees(yaw_rate) as f32,
                climb: gaz as f32,
            })
        }
        _ => None,
    }
}

impl Device for Crazyflie {
    /// Takes `TakeOff`, `Land`, `Hover`, `Stop` (which hovers) and `Attitude`. Any other command makes it hover and is
    /// a fault. A landing continues until `TakeOff`.
    fn drive(&mut self, command: &Command, _: &Estimate) -> Result<(), DeviceError> {
        match command {
            Command::TakeOff => self.set_fly(true),
            Command::Land => self.set_fly(false),
            _ => {}
        }
        let wanted = set_point(command);
        match (self.fly, command) {
            (Some(true), Command::TakeOff) => self.take_off()?,
            (Some(true), _) => {
                let still = set_point(&Command::Hover);
                if let (Some(wanted), Some(true)) =
                    (wanted.or(still), self.state.map(|state| state.flying()))
                {
                    self.send(&wanted.encode())?;
                }
            }
            (Some(false), _) => self.land()?,
            (None, _) => {}
        }
        if wanted.is_none() {
            return Err(DeviceError::Fault(format!(
                "a Crazyflie cannot do {command:?}; use TakeOff, Land, Hover, Stop or Attitude"
            )));
        }
        self.check()
    }

    fn stop(&mut self) -> Result<(), DeviceError> {
        self.set_fly(false);
        self.land()
    }

    fn read(&mut self) -> Result<Option<Reading>, DeviceError> {
        if let Some(request) = self.telemetry.request() {
            self.send(&request)?;
        }
        self.listen()?;
        if self.heard.elapsed() > SILENCE && self.begun.elapsed() > SILENCE {
            // It may come back with its log empty.
            self.telemetry = Telemetry::new();
            self.begun = Instant::now();
            (self.state, self.last) = (None, None);
        }
        self.check()?;
        let Some(state) = self.state.filter(|_| std::mem::take(&mut self.fresh)) else {
            return Ok(None);
        };
        let (sin, cos) = sincos(state.yaw);
        let in_frame =
            |Point { x, y, z }: Point| Point::new(cos * x + sin * y, cos * y - sin * x, z);
        let moved = self.last.replace(state.position);
        let moved = moved.map(|last| state.position - last);
        Ok(Some(Reading {
            moved: moved.filter(|way| way.length() < JUMP).map(in_frame),
            velocity: Some(in_frame(state.velocity)),
            height: Some(state.position.z),
            heading: Some(state.yaw),
            battery: Some(state.battery),
            ..Reading::default()
        }))
    }
}

impl Drop for Crazyflie {
    /// Lands a Crazyflie in the air. Sends the command several times, since there is no acknowledgement.
    fn drop(&mut self) {
        for _ in 0..5 {
            self.asked = None;
            let _ = self.stop();
            if self.state.is_some_and(|state| !state.flying()) {
                return;
            }
            std::thread::sleep(Duration::from_millis(10));
        }
    }
}
