//! The host's side of a node: where datagrams, records and requests go.

use crate::{Hardware, Observed};
use alloc::vec::Vec;
use starl_core::effect::Effects;
use starl_core::motion::{Path, PlanRequest};
use starl_core::{Destination, Estimate, Event, Message, MotionRequest, Save, Time};
use starl_motion::{Neighbour, planning};

/// A datagram that a robot hands to the network.
#[derive(Clone, Debug, PartialEq)]
pub struct Datagram {
    /// Counts this robot's datagrams, over restarts too.
    pub sequence: u32,
    /// The receivers.
    pub destination: Destination,
    /// Sender, endpoint and content.
    pub message: Message,
}

/// A path that a node wants. The host finds it, at once or later, and hands it back as
/// [`crate::NodeInput::Planned`].
#[derive(Clone, Debug, PartialEq)]
pub struct PlanJob {
    /// Names the job among all jobs of this node.
    pub job: u32,
    /// The request of the program.
    pub request: PlanRequest,
    /// Where the robot is.
    pub estimate: Estimate,
}

/// A write requested by a node. Writes are atomic. The host reports a completed write by [`crate::NodeInput::Stored`];
/// a node requests one write at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct StoreJob {
    /// Names the job among all jobs of this node.
    pub job: u32,
    /// The values to write, in this order: see [`starl_core::Saved::apply`].
    pub saves: Vec<Save>,
}

/// Planners that are to go round robots see those this near, metres.
const SIGHT: f64 = 5.0;

impl PlanJob {
    /// The distance in metres within which [`PlanJob::run`] needs the positions of neighbours; 0 if it needs none.
    pub fn sight(&self) -> f64 {
        if self.request.around_robots {
            SIGHT
        } else {
            0.0
        }
    }

    /// Finds the path; none if there is no path, or if the robot has no model.
    pub fn run(&self, hardware: &Hardware, neighbours: &[Neighbour]) -> Option<Path> {
        let drive = hardware.drive.as_ref()?;
        planning::plan_with(
            &planning::Options::with_accuracy(drive.position_error),
            &*drive.model,
            &self.estimate,
            &self.request,
            neighbours,
        )
    }
}

/// Memory that a node works in. A host may use one for many nodes; nothing in it makes a difference to
/// what a node does.
#[derive(Clone, Debug, Default)]
pub struct Workspace {
    /// The effects of the robot's software.
    pub effects: Effects,
    /// Robots near the one that acts.
    pub neighbours: Vec<Neighbour>,
}

/// The requests of a node to its host while it handles an input.
pub trait Outlet {
    /// The memory to work in. A node takes it and puts it back.
    fn workspace(&mut self) -> &mut Workspace;

    /// Records an event of this robot.
    fn record(&mut self, at: Time, event: Event);

    /// Sends a datagram. The node has recorded it as sent; the host records it as dropped if it cannot
    /// be sent.
    fn transmit(&mut self, at: Time, datagram: Datagram);

    /// Finds a path for the robot.
    fn plan(&mut self, at: Time, job: PlanJob);

    /// Collects the robots perceived within `reach` metres of this one.
    fn neighbours(&mut self, reach: f64, near: &mut Vec<Neighbour>);

    /// Moves a robot that has no [`crate::hardware::Drive`] for the node's pilot. Planning is asked for by
    /// [`Outlet::plan`].
    fn request_motion(&mut self, at: Time, request: &MotionRequest) {
        let _ = (at, request);
    }

    /// Writes to the robot's storage. It is never called if the host's agents have no storage.
    fn store(&mut self, at: Time, job: StoreJob) {
        let _ = (at, job);
    }

    /// Takes hold of a thing within the robot's reach, if there is one of this index and no robot holds
    /// it.
    fn take(&mut self, at: Time, thing: u32) {
        let _ = (at, thing);
    }

    /// Puts down what the robot holds.
    fn put_down(&mut self, at: Time) {
        let _ = at;
    }

    /// Receives all calls of the robot's software, in order. A host that keeps a [`crate::journal::Journal`] passes
    /// them to it.
    fn observe(&mut self, at: Time, observed: Observed<'_>) {
        let _ = (at, observed);
    }
}
