//! Emulated robots: the simulator's models, stepped in real time, behind the wire protocols of real devices.
//!
//! A [`World`] holds bodies among obstacles. Each emulated device owns one body and speaks the device's protocol on a
//! pseudo-terminal or on sockets, so a driver cannot tell it from hardware.
//!
//! ```no_run
//! use starl_core::{Point, Pose};
//! use starl_emulate::create::{EmulatedCreate, model};
//! use starl_emulate::{Noise, World};
//! use starl_create::Generation;
//!
//! let world = World::new(Vec::new(), Noise::NONE);
//! let body = world.add("r1", model(Generation::Create2), Pose::level(Point::ZERO, 0.0))?;
//! let device = EmulatedCreate::start(body, Some("/tmp/r1".as_ref()))?;
//! println!("r1 listens on {}", device.path().display());
//! for (name, pose) in world.poses() {
//!     println!("{name} is at {} {}", pose.position.x, pose.position.y);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Dropping a device stops its thread and closes its line. A world runs until the last handle to it and to its bodies
//! is dropped.

pub mod ardrone;
pub mod bodies;
pub mod conformance;
mod control;
pub mod crazyflie;
pub mod create;
pub mod mavlink;
pub mod natnet;
#[cfg(feature = "ros2")]
pub mod ros2;
mod service;
pub mod vrpn;
pub mod world;

pub use world::{AddError, BodyHandle, Noise, Odometer, Touch, World};
