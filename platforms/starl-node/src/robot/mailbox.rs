//! The robot's inputs from other threads.

use crate::link::Arrival;
use crate::motors::Report;
use crate::writer::Written;
use starl_core::motion::Path;
use std::sync::mpsc::{self, Receiver, Sender};

/// An input from another thread.
#[derive(Debug)]
pub enum Incoming {
    /// A packet.
    Packet(Arrival),
    /// From the device's thread.
    Device(Report),
    /// A path was found, or none.
    Planned(u32, Option<Path>),
    /// From the storage's thread.
    Written(Written),
    /// The robot must stop and end.
    Halt,
}

/// The sender of inputs for other threads.
pub type Post = Sender<Incoming>;

/// A new mailbox: one end for [`Robot::start`](super::Robot::start), one for other threads.
pub fn mailbox() -> (Post, Receiver<Incoming>) {
    mpsc::channel()
}
