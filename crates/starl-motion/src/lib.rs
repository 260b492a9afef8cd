//! How robots move: models of their dynamics, waypoint tracking, path planning and avoidance.
//!
//! Everything here is pure and deterministic. A host owns a [`State`] per robot, asks a [`Pilot`] for
//! the command that follows the program's wish, and advances the state through the robot's [`Model`].

#![no_std]
extern crate alloc;

pub mod avoidance;
pub mod contact;
pub mod discovery;
pub mod model;
pub mod models;
pub mod neighbour;
pub mod parameters;
pub mod pilot;
pub mod planning;
pub mod proximity;
pub mod scene;
pub mod sensing;
pub mod tracking;

pub use model::{Disturbance, Impact, Limits, Model, State};
pub use neighbour::Neighbour;
pub use parameters::ParameterError;
pub use pilot::Pilot;
pub use tracking::{Goal, Tracking};
