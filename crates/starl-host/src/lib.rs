//! One robot's node: everything that a host does around a robot's software.
//!
//! A [`Node`] owns the robot's agent, timers, clock, condition, pilot, pending plans and sequence
//! numbers. The host hands it what happens ([`Node::handle`]) and asks when it wants to be called next
//! ([`Node::next_timeout`]); the node answers through an [`Outlet`]. It touches no clock, socket, thread
//! or file, so the simulator, the state explorer, tests and real robots run the same node, and a robot
//! behaves alike on all of them. The shape follows quinn-proto's `Connection`.

#![no_std]
extern crate alloc;

pub mod clock;
pub mod hardware;
pub mod journal;
pub mod node;
pub mod outlet;
pub mod replayer;
pub mod store;
#[cfg(feature = "testing")]
pub mod testing;
pub mod timers;

pub use clock::Clock;
pub use hardware::{Hardware, Snapshot};
pub use journal::Observed;
pub use node::{Condition, Node, NodeInput};
pub use outlet::{Datagram, Outlet, PlanJob, StoreJob, Workspace};
pub use replayer::{Departure, Difference, Replayer};
pub use store::Store;
pub use timers::Timers;
