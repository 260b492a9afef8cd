//! The iRobot Create and Create 2, driven over a serial line by their Open Interface.
//!
//! [`Create`] is the driver. [`command`], [`sensor`] and [`stream`] are the wire format, both ways: the driver sends
//! commands and reads sensors, an emulated robot does the opposite. Decoders take any bytes.
//!
//! Sources: iRobot Create Open Interface (2006), iRobot Create 2 Open Interface (2018).

pub mod command;
mod driver;
mod line;
mod odometry;
pub mod sensor;
pub mod stream;

pub use driver::{Create, CreateOptions, wheel_speeds};
pub use line::{Guard, SerialLine};

/// Greatest speed of a wheel's rim that the robot takes, metres per second.
pub const WHEEL_SPEED: f64 = 0.5;

/// Which robot it is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Generation {
    /// The Create of 2007, which reports distances in millimetres and angles in degrees.
    Create1,
    /// The Create 2 of 2014 and Roombas of the series 600, which also have counters on their wheels.
    #[default]
    Create2,
}

impl Generation {
    /// Distance between the wheels, metres.
    pub fn wheel_distance(self) -> f64 {
        match self {
            Generation::Create1 => 0.258,
            Generation::Create2 => 0.235,
        }
    }
}

/// How far a wheel of a Create 2 drives per count of its encoder, metres: 508.8 counts a turn, wheels of 72 mm.
pub const METRES_PER_COUNT: f64 = 0.072 * std::f64::consts::PI / 508.8;
