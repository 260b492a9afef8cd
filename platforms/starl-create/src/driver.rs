//! The driver: commands of the platform to speeds of wheels, the robot's stream to readings.

use crate::command::OpenInterface;
use crate::odometry::Odometry;
use crate::sensor::{self, Mode, bumps};
use crate::stream::FrameDecoder;
use crate::{Generation, Guard, SerialLine, WHEEL_SPEED};
use starl_core::sensor::Contact;
use starl_core::{Command, Estimate};
use starl_node::{Device, DeviceError, Reading};
use std::path::Path;
use std::time::{Duration, Instant};

/// How to drive a Create.
#[derive(Clone, Copy, Debug)]
pub struct CreateOptions {
    /// Which robot it is.
    pub generation: Generation,
    /// Distance between the wheels, metres.
    pub wheel_distance: f64,
    /// Bits per second of the serial line: 115200 unless the robot was set to the older 57600.
    pub baud: u32,
    /// Whether a guard process stops the robot if this process dies ([`Guard`]).
    pub guard: bool,
}

impl CreateOptions {
    /// A robot as it was sold.
    pub fn new(generation: Generation) -> CreateOptions {
        CreateOptions {
            generation,
            wheel_distance: generation.wheel_distance(),
            baud: match generation {
                Generation::Create1 => 57_600,
                Generation::Create2 => 115_200,
            },
            guard: true,
        }
    }
}

/// A robot that sends nothing for so long is switched off or not connected. It streams every 15 ms.
const SILENCE: Duration = Duration::from_millis(1000);

/// A Create on a serial line.
///
/// It is driven in safe mode: where a wheel drops or there is a cliff, the robot itself stops and leaves the mode. The
/// driver takes control again once the robot stands on the floor, and reports a fault until then.
#[derive(Debug)]
pub struct Create {
    line: SerialLine,
    frames: FrameDecoder,
    odometry: Odometry,
    wheel_distance: f64,
    packets: Vec<u8>,
    /// When the last frame arrived, or the line was opened.
    heard: Instant,
    /// When the stream was last asked for.
    greeted: Instant,
    latest: Option<Latest>,
    /// Last field, so that its last word comes after the driver's own.
    _guard: Option<Guard>,
}

/// The latest frame without odometry.
#[derive(Clone, Copy, Debug)]
struct Latest {
    mode: Option<Mode>,
    bumps: u8,
    cliff: bool,
    charge: i32,
    capacity: i32,
    fresh: bool,
}

impl Create {
    /// Opens the serial line at `path`, e.g. `/dev/ttyUSB0`, starts the robot in safe mode and asks for its sensors.
    ///
    /// # Errors
    /// If the line cannot be opened. A robot that does not answer shows in [`Device::read`].
    pub fn open(path: impl AsRef<Path>, options: &CreateOptions) -> Result<Create, DeviceError> {
        let path = path.as_ref();
        let line = SerialLine::open(path, options.baud)?;
        let odometry = match options.generation {
            Generation::Create1 => [sensor::DISTANCE, sensor::ANGLE],
            Generation::Create2 => [sensor::ENCODER_LEFT, sensor::ENCODER_RIGHT],
        };
        let cliffs = sensor::CLIFF_LEFT..=sensor::CLIFF_RIGHT;
        let packets: Vec<u8> = odometry
            .into_iter()
            .chain([sensor::BUMPS, sensor::MODE])
            .chain([sensor::CHARGE, sensor::CAPACITY])
            .chain(cliffs)
            .collect();
        let now = Instant::now();
        let mut create = Create {
            line,
            frames: FrameDecoder::new(&packets),
            odometry: Odometry::new(options.generation, options.wheel_distance),
            wheel_distance: options.wheel_distance,
            packets,
            heard: now,
            greeted: now,
            latest: None,
            _guard: match options.guard {
                true => Some(Guard::start(path)?),
                false => None,
            },
        };
        create.greet()?;
        Ok(create)
    }

    /// Opens the interface, takes control and asks for the stream.
    fn greet(&mut self) -> Result<(), DeviceError> {
        self.greeted = Instant::now();
        let mut bytes = Vec::new();
        OpenInterface::Start.encode(&mut bytes);
        OpenInterface::Safe.encode(&mut bytes);
        OpenInterface::Stream(self.packets.clone()).encode(&mut bytes);
        Ok(self.line.send(&bytes)?)
    }

    /// Fails while the robot is silent.
    fn check(&self) -> Result<(), DeviceError> {
        if self.heard.elapsed() <= SILENCE {
            return Ok(());
        }
        Err(DeviceError::Fault(
            "the Create is silent; is it switched on and connected?".into(),
        ))
    }

    fn send(&self, command: &OpenInterface) -> Result<(), DeviceError> {
        let mut bytes = Vec::new();
        command.encode(&mut bytes);
        Ok(self.line.send(&bytes)?)
    }

    fn take(&mut self, values: &[i32]) {
        let &[
            first,
            second,
            bumps,
            mode,
            charge,
            capacity,
            ref cliffs @ ..,
        ] = values
        else {
            return;
        };
        self.odometry.take([first, second]);
        self.latest = Some(Latest {
            mode: Mode::of(mode),
            bumps: bumps as u8,
            cliff: cliffs.iter().any(|&cliff| cliff != 0),
            charge,
            capacity,
            fresh: true,
        });
        self.heard = Instant::now();
    }
}

impl Device for Create {
    /// Takes `Straight`, `Turn`, `Curve`, `Wheels` and `Stop`; any other command stops the robot and is a fault.
    fn drive(&mut self, command: &Command, _: &Estimate) -> Result<(), DeviceError> {
        let Some((left, right)) = wheel_speeds(command, self.wheel_distance) else {
            self.stop()?;
            return Err(DeviceError::Fault(format!(
                "a Create cannot drive {command:?}; use Straight, Turn, Curve, Wheels or Stop"
            )));
        };
        if let Some(latest) = self.latest
            && latest.mode.is_some_and(|mode| !mode.drives())
        {
            if latest.cliff || latest.bumps & bumps::WHEEL_DROP != 0 {
                return Err(DeviceError::Fault(
                    "the robot is lifted or at a cliff; put it on the floor".into(),
                ));
            }
            self.send(&OpenInterface::Safe)?;
        }
        let [left, right] = [left, right].map(|speed| (1000.0 * speed).round() as i16);
        self.send(&OpenInterface::DriveDirect { right, left })?;
        self.check()
    }

    fn stop(&mut self) -> Result<(), DeviceError> {
        self.send(&OpenInterface::DriveDirect { right: 0, left: 0 })
    }

    fn read(&mut self) -> Result<Option<Reading>, DeviceError> {
        let mut buffer = [0; 512];
        loop {
            let bytes = self.line.receive(&mut buffer)?;
            if bytes.is_empty() {
                break;
            }
            self.frames.push(bytes);
            while let Some(values) = self.frames.pop() {
                self.take(&values);
            }
        }
        if let Err(silent) = self.check() {
            if self.greeted.elapsed() > SILENCE {
                // It may have been switched off and on.
                self.latest = None;
                self.odometry.forget();
                self.greet()?;
            }
            return Err(silent);
        }
        let Some(latest) = self.latest.as_mut().filter(|latest| latest.fresh) else {
            return Ok(None);
        };
        latest.fresh = false;
        let (moved, turned) = self.odometry.reap();
        Ok(Some(Reading {
            moved: Some(moved),
            turned: Some(turned),
            bumper: Some(contact(latest.bumps)),
            battery: (latest.capacity > 0)
                .then(|| (f64::from(latest.charge) / f64::from(latest.capacity)).clamp(0.0, 1.0)),
            ..Reading::default()
        }))
    }
}

impl Drop for Create {
    fn drop(&mut self) {
        let _ = self.stop();
    }
}

/// The speeds of the left and right wheel, as the model `create` drives them: where a wheel would be too fast, a curve
/// keeps its radius and is driven slower. `None` for commands that are not a Create's, or not finite.
pub fn wheel_speeds(command: &Command, wheel_distance: f64) -> Option<(f64, f64)> {
    let half = 0.5 * wheel_distance;
    let (left, right) = match *command {
        Command::Stop => (0.0, 0.0),
        Command::Straight { speed } => (speed, speed),
        Command::Turn { rate } => (-rate * half, rate * half),
        Command::Wheels { left, right } => (left, right),
        Command::Curve { speed, radius }
            if speed.is_finite() && radius.is_finite() && radius != 0.0 =>
        {
            let (left, right) = (1.0 - half / radius, 1.0 + half / radius);
            let fastest = left.abs().max(right.abs());
            let speed = speed.clamp(-WHEEL_SPEED / fastest, WHEEL_SPEED / fastest);
            (speed * left, speed * right)
        }
        _ => return None,
    };
    let limited = |speed: f64| speed.clamp(-WHEEL_SPEED, WHEEL_SPEED);
    (left.is_finite() && right.is_finite()).then(|| (limited(left), limited(right)))
}

/// Where the halves of the bumper are pressed: ahead if both are.
fn contact(bits: u8) -> Option<Contact> {
    let bearing = match (bits & bumps::LEFT != 0, bits & bumps::RIGHT != 0) {
        (false, false) => return None,
        (true, true) => 0.0,
        (true, false) => std::f64::consts::FRAC_PI_4,
        (false, true) => -std::f64::consts::FRAC_PI_4,
    };
    Some(Contact { bearing })
}
