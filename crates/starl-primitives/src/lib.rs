//! The primitives of StarL: pure state machines that programs own and call (thesis, chapter 3).
//!
//! Communication: [`Broadcast`], [`Geocast`] and [`Unicast`], all built on one acknowledged protocol,
//! [`reliable::Reliable`], and [`LocalBroadcast`], without guarantees; [`SharedMemory`] and [`Register`]. Motion:
//! [`ReachAvoid`]. Agreement: [`Mutex`], [`Registration`], [`LeaderElection`], [`Barrier`]. A program keeps primitives
//! as fields, derives [`starl_core::Primitives`], calls their methods with its [`starl_core::Robot`] and reads their
//! flags. No primitive waits for ever for a failed robot.

#![no_std]
extern crate alloc;

#[cfg(test)]
mod alone;
pub mod barrier;
pub mod broadcast;
mod channel;
mod copies;
pub mod election;
pub mod failure_detector;
mod founders;
pub mod geocast;
mod handshake;
mod incarnation;
pub mod local_broadcast;
pub mod mutex;
pub mod reach_avoid;
pub mod register;
pub mod registration;
pub mod reliable;
pub mod shared_memory;
mod sight;
pub mod unicast;

pub use barrier::Barrier;
pub use broadcast::Broadcast;
pub use channel::Failure;
pub use election::LeaderElection;
pub use failure_detector::FailureDetector;
pub use geocast::Geocast;
pub use local_broadcast::LocalBroadcast;
pub use mutex::Mutex;
pub use reach_avoid::ReachAvoid;
pub use register::Register;
pub use registration::Registration;
pub use shared_memory::SharedMemory;
pub use unicast::Unicast;
