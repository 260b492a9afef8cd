//! The interfaces between StarL's layers.
//!
//! A robot's program and each of its primitives is a pure state machine. Its host passes it an
//! input (a start, a message, a timer, a position estimate, an activation) together with a
//! [`Robot`] handle, and it pushes effects (send, arm a timer, move, record an event) through that
//! handle. It uses no clock, socket, thread or file, so the same machine runs in the simulator, in
//! a browser, under a state explorer and on a real robot.
//!
//! Units are SI throughout: metres, seconds (or integer nanoseconds, [`Time`]), radians, one common
//! right-handed world frame with x and y in the floor plane and z up.

#![no_std]
extern crate alloc;

pub mod agent;
pub mod digest;
pub mod effect;
pub mod event;
pub mod file;
pub mod geometry;
pub mod id;
pub mod input;
pub mod intervention;
pub mod math;
pub mod message;
pub mod motion;
pub mod primitive;
pub mod primitives;
pub mod program;
pub mod random;
pub mod robot;
pub mod sensor;
pub mod storage;
pub mod time;
pub mod timer;

pub use agent::Agent;
pub use digest::Digest;
pub use effect::Effect;
pub use event::{Event, Fields, Record, Value};
pub use file::FileError;
pub use geometry::{Area, ConvexPolygon, Obstacle, Point, Pose, Shape, Twist};
pub use id::{Port, RobotId};
pub use input::Input;
pub use intervention::{FaultKind, Intervention, Order};
pub use message::{Destination, Message, Payload};
pub use motion::{Command, Estimate, MotionRequest, WayPoint};
pub use primitive::Primitive;
pub use primitives::Primitives;
pub use program::{Program, Status};
pub use random::Random;
pub use robot::{Robot, View};
pub use sensor::Sensors;
pub use storage::{Save, Saved};
pub use time::{Duration, Time};
pub use timer::{Timer, TimerKey};
