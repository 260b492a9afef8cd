//! The interfaces through which a robot's core acts.

use crate::link::{Member, Origin, Transport};
use crate::motors::Motors;
use crate::planner::Planner;
use crate::writer::StorageWriter;
use starl_core::{Command, Estimate, Saved};
use starl_host::{PlanJob, StoreJob};
use starl_motion::Neighbour;
use std::io;
use std::sync::Arc;

/// The motors, the planner, the storage and the network of a robot. No method blocks.
pub trait Equipment {
    /// The data that the robot saved in earlier lives; none without storage.
    fn saved(&self) -> Option<Arc<Saved>>;

    /// Whether an external system measures the robot's position.
    fn has_fixes(&self) -> bool;

    /// The motors follow this command until the next call.
    fn drive(&mut self, command: Command, estimate: &Estimate);

    /// Nothing moves until the next [`Equipment::drive`].
    fn stop(&mut self);

    /// Ends the robot and its motion. Returns when the device has got the command.
    fn end(&mut self);

    /// Finds a path, and hands it back as [`Incoming::Planned`](super::Incoming::Planned).
    fn find(&mut self, job: PlanJob, neighbours: Vec<Neighbour>);

    /// Writes to storage, and confirms it by [`Incoming::Written`](super::Incoming::Written). Not called if
    /// [`Equipment::saved`] is none.
    fn write(&mut self, job: StoreJob);

    /// Sends a packet to a member. It may get lost.
    ///
    /// # Errors
    /// If the network refuses it, or the member's place is not known.
    fn send(&mut self, to: Member, packet: &[u8]) -> io::Result<()>;

    /// A member was heard at this place, and its packet was authentic.
    fn learn(&mut self, member: Member, origin: Origin);
}

/// The equipment of a real robot: a thread for each slow operation.
pub(super) struct Attached {
    pub motors: Motors,
    pub planner: Planner,
    pub writer: Option<StorageWriter>,
    pub transport: Box<dyn Transport>,
    pub saved: Option<Arc<Saved>>,
    pub has_fixes: bool,
}

impl Equipment for Attached {
    fn saved(&self) -> Option<Arc<Saved>> {
        self.saved.clone()
    }

    fn has_fixes(&self) -> bool {
        self.has_fixes
    }

    fn drive(&mut self, command: Command, estimate: &Estimate) {
        self.motors.drive(command, estimate);
    }

    fn stop(&mut self) {
        self.motors.stop();
    }

    fn end(&mut self) {
        self.motors.end();
    }

    fn find(&mut self, job: PlanJob, neighbours: Vec<Neighbour>) {
        self.planner.find(job, neighbours);
    }

    fn write(&mut self, job: StoreJob) {
        if let Some(writer) = &self.writer {
            writer.write(job);
        }
    }

    fn send(&mut self, to: Member, packet: &[u8]) -> io::Result<()> {
        self.transport.send(to, packet)
    }

    fn learn(&mut self, member: Member, origin: Origin) {
        self.transport.learn(member, origin);
    }
}
