//! The interface to a robot's hardware: its commands and its measurements.
//!
//! An adapter for a kind of robot implements [`Device`]. The runtime calls it from one thread, several times a second,
//! and stops the robot by itself when it loses the program, the localisation or (where so configured) the link.

use starl_core::sensor::Contact;
use starl_core::{Command, Estimate, Point};
use thiserror::Error;

/// A robot's motors and its own sensors.
pub trait Device: Send {
    /// Follows `command` until the next call. Called about every 50 ms with the latest command, so that a device with a
    /// watchdog keeps moving while the program runs, and stops when it does not. `estimate` is the robot's position,
    /// for devices that take goals in another frame than the command's.
    ///
    /// # Errors
    /// The device cannot be reached. The runtime informs the user and calls again.
    fn drive(&mut self, command: &Command, estimate: &Estimate) -> Result<(), DeviceError>;

    /// Ends all motion as fast as is safe: wheels stop, a quadcopter in the air lands. May be called at any time, and
    /// more than once.
    ///
    /// # Errors
    /// If the device cannot be reached.
    fn stop(&mut self) -> Result<(), DeviceError>;

    /// The measurements since the last call; none if there are no new ones. Does not block.
    ///
    /// # Errors
    /// The device cannot be reached, or sends malformed data.
    fn read(&mut self) -> Result<Option<Reading>, DeviceError>;
}

/// The measurements of a device. A quantity that it does not measure is `None`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reading {
    /// Motion since the last reading, in the robot's frame at the last reading: metres forward, left and up.
    pub moved: Option<Point>,
    /// Turn since the last reading, radians, left positive.
    pub turned: Option<f64>,
    /// Velocity in the robot's frame: metres per second forward, left and up.
    pub velocity: Option<Point>,
    /// Height of the base above the floor, metres.
    pub height: Option<f64>,
    /// Heading, radians from the device's own zero, left positive. The zero may be anywhere but does not move.
    pub heading: Option<f64>,
    /// Where something touches the robot; the outer `None` if it has no bumper.
    pub bumper: Option<Option<Contact>>,
    /// Charge of the battery, 0 to 1.
    pub battery: Option<f64>,
}

/// Why a device cannot be used at the moment.
#[derive(Debug, Error)]
pub enum DeviceError {
    /// The connection failed.
    #[error("the connection failed: {0}")]
    Io(#[from] std::io::Error),
    /// The device reports a fault of its own, or sends what makes no sense.
    #[error("{0}")]
    Fault(String),
}
