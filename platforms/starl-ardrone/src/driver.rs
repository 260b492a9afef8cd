//! The driver: commands of the platform to AT commands, navdata to readings.

use crate::at::{AtCommand, Tilt};
use crate::configuration::Configuration;
use crate::navdata::{ControlState, Navdata, state};
use crate::{AT_PORT, NAVDATA_PORT};
use starl_core::{Command, Estimate, Point};
use starl_node::{Device, DeviceError, Reading};
use std::io::ErrorKind;
use std::net::{IpAddr, Ipv4Addr, SocketAddr, UdpSocket};
use std::time::{Duration, Instant};

/// How to fly an AR.Drone. The limits are those of the model `drone`; the driver configures the drone with them.
#[derive(Clone, Copy, Debug)]
pub struct ArdroneOptions {
    /// Where the drone takes AT commands.
    pub commands: SocketAddr,
    /// Where the drone gives navdata.
    pub navdata: SocketAddr,
    /// Greatest pitch and roll, radians, up to 0.52.
    pub tilt: f64,
    /// Greatest rate of climb, metres per second, 0.2 to 2.
    pub vertical_speed: f64,
    /// Greatest rate of turn, radians per second, 0.7 to 6.1.
    pub yaw_rate: f64,
}

impl ArdroneOptions {
    /// A drone at `address`; a drone that makes its own network is at 192.168.1.1.
    pub fn new(address: IpAddr) -> ArdroneOptions {
        ArdroneOptions {
            commands: (address, AT_PORT).into(),
            navdata: (address, NAVDATA_PORT).into(),
            tilt: 20f64.to_radians(),
            vertical_speed: 1.0,
            yaw_rate: 200f64.to_radians(),
        }
    }
}

/// A drone that sends nothing for so long is switched off or out of reach. It sends navdata every 67 ms or faster.
const SILENCE: Duration = Duration::from_millis(1000);
/// How often a drone that is silent is asked for navdata.
const ASKING: Duration = Duration::from_millis(200);

/// How long the drone may say that it hears nothing before its commands are numbered from 1 again, and how often.
const UNHEARD: Duration = Duration::from_millis(300);

/// An AR.Drone on the network.
///
/// The drone flies on for 2 s after its last command; the driver sends some at each call. There are readings once the
/// drone is configured, and until then it does not take off. A drone that is in the air when the driver connects stays
/// there.
#[derive(Debug)]
pub struct Ardrone {
    commands: UdpSocket,
    navdata: UdpSocket,
    options: ArdroneOptions,
    configuration: Configuration,
    sequence: u32,
    /// When the commands were last numbered from 1, or the drone last said that it hears them.
    counted: Instant,
    /// Whether it is to be in the air; unknown until the drone says whether it is.
    fly: Option<bool>,
    latest: Option<Navdata>,
    fresh: bool,
    heard: Instant,
    asked: Option<Instant>,
}

impl Ardrone {
    /// Opens the sockets. A drone that does not answer shows in [`Device::read`].
    ///
    /// # Errors
    /// If no socket can be opened, or the network has no way to the drone.
    pub fn connect(options: &ArdroneOptions) -> Result<Ardrone, DeviceError> {
        let entries = vec![
            ("general:navdata_demo", "TRUE".to_string()),
            ("control:euler_angle_max", format!("{:.3}", options.tilt)),
            (
                "control:control_vz_max",
                format!("{:.0}", 1000.0 * options.vertical_speed),
            ),
            ("control:control_yaw", format!("{:.3}", options.yaw_rate)),
        ];
        Ok(Ardrone {
            commands: socket(options.commands)?,
            navdata: socket(options.navdata)?,
            options: *options,
            configuration: Configuration::new(entries),
            sequence: 0,
            counted: Instant::now(),
            fly: None,
            latest: None,
            fresh: false,
            heard: Instant::now(),
            asked: None,
        })
    }

    /// Makes a drone that has cut its motors ready to take off again. Put it on the floor first.
    ///
    /// # Errors
    /// If the drone cannot be reached.
    pub fn clear_emergency(&mut self) -> Result<(), DeviceError> {
        self.fly = Some(false);
        let [on, off] = [true, false].map(|emergency| AtCommand::Reference {
            fly: false,
            emergency,
        });
        self.send(&[off.clone(), on, off])
    }

    /// Fails while the drone is silent or its motors are cut.
    fn check(&self) -> Result<(), DeviceError> {
        if self.heard.elapsed() > SILENCE {
            return Err(DeviceError::Fault(
                "the AR.Drone is silent; is it switched on and in reach?".into(),
            ));
        }
        let cut = |latest: Navdata| latest.state & state::EMERGENCY != 0;
        if self.latest.is_some_and(cut) {
            return Err(DeviceError::Fault(
                "the AR.Drone has cut its motors; look at it, then clear the emergency".into(),
            ));
        }
        Ok(())
    }

    fn send(&mut self, commands: &[AtCommand]) -> Result<(), DeviceError> {
        let mut datagram = String::new();
        for command in commands {
            self.sequence += 1;
            command.encode(self.sequence, &mut datagram);
        }
        send(&self.commands, datagram.as_bytes())
    }

    fn take(&mut self, navdata: Navdata) {
        let newest = self.latest.map_or(0, |latest| latest.sequence);
        if navdata.sequence <= newest {
            return;
        }
        if self.fly.is_none() {
            self.fly = Some(navdata.state & state::FLYING != 0);
        }
        self.heard = Instant::now();
        self.fresh = true;
        self.latest = Some(navdata);
        // The drone ignores sequence numbers that it has received already. The first command of a driver resets the
        // count. If that command is lost, or another sender has used a greater number, the drone ignores all commands.
        if navdata.state & state::WATCHDOG == 0 {
            self.counted = self.heard;
        } else if self.counted.elapsed() > UNHEARD {
            self.counted = self.heard;
            self.sequence = 0;
        }
    }

    /// Takes what has arrived.
    fn listen(&mut self) -> Result<(), DeviceError> {
        let mut buffer = [0; 4096];
        loop {
            match self.navdata.recv(&mut buffer) {
                Ok(length) => {
                    if let Some(navdata) = Navdata::decode(&buffer[..length]) {
                        self.take(navdata);
                    }
                }
                Err(error) => match error.kind() {
                    // No process listens there: treated as silence.
                    ErrorKind::WouldBlock | ErrorKind::ConnectionRefused => return Ok(()),
                    ErrorKind::Interrupted => {}
                    _ => return Err(error.into()),
                },
            }
        }
    }

    fn ask(&mut self) -> Result<(), DeviceError> {
        if self.asked.is_none_or(|asked| asked.elapsed() > ASKING) {
            self.asked = Some(Instant::now());
            send(&self.navdata, &[1, 0, 0, 0])?;
        }
        Ok(())
    }

    /// The AT command for a command of the model, and whether the drone is in the air afterwards.
    fn translate(&self, command: &Command) -> Option<(Option<Tilt>, Option<bool>)> {
        let ArdroneOptions {
            tilt,
            vertical_speed,
            yaw_rate: most_yaw,
            ..
        } = self.options;
        let part = |value: f64, most: f64| (value / most).clamp(-1.0, 1.0) as f32;
        Some(match *command {
            Command::TakeOff => (None, Some(true)),
            Command::Land => (None, Some(false)),
            Command::Hover | Command::Stop => (None, self.fly),
            Command::Attitude {
                yaw_rate,
                pitch,
                roll,
                gaz,
            } if [yaw_rate, pitch, roll, gaz]
                .iter()
                .all(|number| number.is_finite()) =>
            {
                let tilt = Tilt {
                    roll: part(roll, tilt),
                    pitch: -part(pitch, tilt),
                    climb: part(gaz, vertical_speed),
                    yaw: -part(yaw_rate, most_yaw),
                };
                (Some(tilt), self.fly)
            }
            _ => return None,
        })
    }
}

impl Device for Ardrone {
    /// Takes `TakeOff`, `Land`, `Hover`, `Stop` (which hovers) and `Attitude`. Any other command makes it hover and is
    /// a fault. A landing continues until `TakeOff`: hovering would make a drone take off that has just landed.
    fn drive(&mut self, command: &Command, _: &Estimate) -> Result<(), DeviceError> {
        let understood = self.translate(command);
        let (tilt, fly) = understood.unwrap_or((None, self.fly));
        let mut commands = vec![AtCommand::Watchdog];
        if let Some(latest) = self.latest {
            commands.extend(self.configuration.next(latest.state));
        }
        if self.configuration.complete()
            && let Some(fly) = fly
        {
            self.fly = Some(fly);
            commands.push(AtCommand::Reference {
                fly,
                emergency: false,
            });
            commands.push(AtCommand::Fly(tilt));
        }
        self.send(&commands)?;
        if understood.is_none() {
            return Err(DeviceError::Fault(format!(
                "an AR.Drone cannot do {command:?}; use TakeOff, Land, Hover, Stop or Attitude"
            )));
        }
        self.check()
    }

    fn stop(&mut self) -> Result<(), DeviceError> {
        self.fly = Some(false);
        let land = AtCommand::Reference {
            fly: false,
            emergency: false,
        };
        self.send(&[AtCommand::Watchdog, land, AtCommand::Fly(None)])
    }

    fn read(&mut self) -> Result<Option<Reading>, DeviceError> {
        self.listen()?;
        if self.latest.is_none() || self.heard.elapsed() > ASKING {
            self.ask()?;
        }
        if self.heard.elapsed() > SILENCE {
            // The drone may restart its sequence numbers and its configuration.
            self.latest = None;
            self.configuration.restart();
        }
        self.check()?;
        let Some(latest) = self.latest else {
            return Ok(None);
        };
        if !std::mem::take(&mut self.fresh) {
            return Ok(None);
        }
        if !self.configuration.complete() {
            // The drone is not driven before the first reading, so it is configured here.
            self.drive(&Command::Stop, &Estimate::default())?;
            return Ok(None);
        }
        Ok(latest.demo.map(|demo| {
            let [ahead, right, down] = demo.velocity.map(|speed| 0.001 * f64::from(speed));
            Reading {
                velocity: Some(Point::new(ahead, -right, -down)),
                height: Some(0.001 * f64::from(demo.altitude)),
                heading: Some(-(0.001 * f64::from(demo.yaw)).to_radians()),
                battery: Some((0.01 * f64::from(demo.battery)).clamp(0.0, 1.0)),
                ..Reading::default()
            }
        }))
    }
}

impl Drop for Ardrone {
    /// Lands a drone in the air. Sends the command several times, since there is no acknowledgement.
    fn drop(&mut self) {
        let landed = |latest: Navdata| {
            latest
                .demo
                .is_some_and(|demo| demo.control == ControlState::Landed)
        };
        for _ in 0..5 {
            let _ = self.stop();
            if self.latest.is_some_and(landed) {
                return;
            }
            std::thread::sleep(Duration::from_millis(10));
        }
    }
}

/// A socket that hears only `peer`, and does not block.
fn socket(peer: SocketAddr) -> Result<UdpSocket, DeviceError> {
    let any: IpAddr = match peer {
        SocketAddr::V4(_) => Ipv4Addr::UNSPECIFIED.into(),
        SocketAddr::V6(_) => std::net::Ipv6Addr::UNSPECIFIED.into(),
    };
    let socket = UdpSocket::bind((any, 0))?;
    socket.connect(peer)?;
    socket.set_nonblocking(true)?;
    Ok(socket)
}

/// Sends a datagram. If no process listens, there is no error, only silence.
fn send(socket: &UdpSocket, datagram: &[u8]) -> Result<(), DeviceError> {
    match socket.send(datagram) {
        Err(error) if error.kind() != ErrorKind::ConnectionRefused => Err(error.into()),
        _ => Ok(()),
    }
}
