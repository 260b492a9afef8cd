//! The simulator's data of one robot apart from its physical state.

use starl_core::event::Hit;
use starl_core::motion::{Obstacles, Path};
use starl_core::sensor::Contact;
use starl_core::{Digest, Order, RobotId, Time};
use starl_host::{Datagram, Node, Store};
use starl_motion::Neighbour;

/// One robot's node with its network and motion state.
#[derive(Clone)]
pub struct SimulatedRobot {
    pub node: Node,
    pub senses: Senses,
    pub account: Account,
    pub group: u32,
    pub next_estimate: Time,
    pub next_pose_record: Time,
    pub motor_stuck: bool,
    /// It has left the fleet, and its body the world.
    pub is_gone: bool,
    pub distance: f64,
}

impl SimulatedRobot {
    /// The robot's number.
    pub fn id(&self) -> RobotId {
        self.node.id()
    }

    /// Whether the robot neither moves nor senses as it should.
    pub fn is_impaired(&self) -> bool {
        self.motor_stuck || self.senses.are_frozen
    }

    /// A crashed robot keeps its body, its clock and its history, and what its storage holds, unless that is
    /// lost.
    pub fn crash(&mut self, is_storage_lost: bool) {
        self.node.crash();
        if let Some(store) = &mut self.account.store {
            store.crash(is_storage_lost);
        }
        self.account.orders.clear();
        self.motor_stuck = false;
        self.senses.knowledge = None;
        self.repair_senses();
    }

    /// Ends that the sensors repeat their last readings.
    pub fn repair_senses(&mut self) {
        self.senses.are_frozen = false;
        self.senses.frozen = None;
    }

    /// The robot as others perceive it: by its positioning, or its true position if that no longer
    /// reports.
    pub fn perceived(&self, body: &Neighbour) -> Neighbour {
        if self.node.condition().down || self.senses.are_frozen {
            return *body;
        }
        let estimate = self.node.estimate();
        Neighbour {
            position: estimate.pose.position,
            velocity: estimate.twist.linear,
            ..*body
        }
    }
}

/// The robot's sensors.
#[derive(Clone, Debug, Default)]
pub struct Senses {
    /// The robot's knowledge of obstacles, if it differs from the common knowledge.
    pub knowledge: Option<Box<Knowledge>>,
    pub contact: Option<Contact>,
    pub touching: Option<Hit>,
    /// The thing in its gripper.
    pub holding: Option<u32>,
    /// Whether sensors and positioning repeat their last readings.
    pub are_frozen: bool,
    /// These readings, once they have been taken.
    pub frozen: Option<Box<Frozen>>,
}

/// The account of the robot's past and pending actions.
#[derive(Clone, Debug, Default)]
pub struct Account {
    pub digest: Digest,
    /// The time at which the radio has sent its whole queue.
    pub radio_free: Time,
    /// Finished planning jobs, to be delivered in the next step.
    pub plans: Vec<(u32, Option<Path>)>,
    /// The robot's storage; none if it has none.
    pub store: Option<Box<Store>>,
    /// Orders of operators that it has not received yet, by time.
    pub orders: Vec<(Time, Order)>,
    /// How many waypoints ReachAvoid has reached.
    pub way_points: u32,
    /// How many commands ReachAvoid has given up.
    pub gave_up: u32,
    /// How many datagrams it has sent.
    pub sent: u32,
}

/// Hidden obstacles that a robot has met.
#[derive(Clone, Debug)]
pub struct Knowledge {
    /// Indices in the world.
    pub met: Vec<u32>,
    /// All obstacles that it knows.
    pub obstacles: Obstacles,
}

/// The readings that frozen sensors repeat.
#[derive(Clone, Debug, Default)]
pub struct Frozen {
    pub bumper: Option<Contact>,
    pub proximity: Vec<starl_core::sensor::Ray>,
    pub detections: Vec<starl_core::sensor::Detection>,
}

/// A datagram that a robot has handed to the network in this step.
#[derive(Clone, Debug)]
pub struct Outgoing {
    /// When it leaves the robot.
    pub at: Time,
    pub datagram: Datagram,
}
