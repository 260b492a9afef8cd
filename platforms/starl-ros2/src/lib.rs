//! ROS 2 ground robots, such as the Create 3, TurtleBot 4 and their simulators, over Zenoh.
//!
//! [`Ros2Robot`] is the driver: it publishes velocities on `cmd_vel` and reads odometry from `odom`. [`Localisation`]
//! reads where the robot is on a map from `tf`. [`cdr`] and [`message`] are the bytes of messages, [`graph`] the names
//! by which ROS 2 nodes find each other, and [`node`] is a node in that graph; an emulated robot uses them in the other
//! direction.
//!
//! The computers of the robot use the middleware `rmw_zenoh` (`RMW_IMPLEMENTATION=rmw_zenoh_cpp`), ROS 2 Humble or
//! later. Robots that speak DDS are reached through a bridge between DDS and Zenoh on their side.
//!
//! Sources: "rmw_zenoh design" (<https://github.com/ros2/rmw_zenoh/blob/rolling/docs/design.md>); OMG, "DDS
//! Extensible and Dynamic Topic Types" 1.3, section 7.4.3, for CDR; REP 103 and REP 105 for units and frames; REP 2016
//! for type hashes.

pub mod cdr;
mod driver;
pub mod frames;
pub mod graph;
mod localisation;
pub mod message;
pub mod node;

pub use driver::{Ros2Options, Ros2Robot};
pub use localisation::Localisation;

/// Where a robot's Zenoh router listens unless it is configured otherwise.
pub const ROUTER: &str = "tcp/127.0.0.1:7447";
