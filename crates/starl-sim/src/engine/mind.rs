//! What the simulator keeps of one robot apart from its physical state.

use super::timers::Timers;
use starl_core::event::Hit;
use starl_core::motion::{Obstacles, Path};
use starl_core::sensor::Contact;
use starl_core::{Agent, Command, Digest, Duration, Estimate, Message, RobotId, Time};
use starl_motion::{Neighbour, Pilot};

/// One robot's software, clock and knowledge.
#[derive(Clone)]
pub struct Mind {
    pub id: RobotId,
    pub group: u32,
    pub agent: Agent,
    pub estimate: Estimate,
    pub pilot: Option<Box<Pilot>>,
    pub command: Command,
    pub timers: Timers,
    pub next_estimate: Time,
    pub next_activation: Time,
    pub next_pose_record: Time,
    pub clock: Clock,
    /// Counts datagrams.
    pub sequence: u32,
    /// When the radio has sent all that waits.
    pub radio_free: Time,
    /// Paths found, to be handed over at the next step.
    pub plans: Vec<(u32, Option<Path>)>,
    /// What this robot knows of obstacles, where that differs from what all know.
    pub knowledge: Option<Box<Knowledge>>,
    pub contact: Option<Contact>,
    pub touching: Option<Hit>,
    pub frozen: Option<Box<Frozen>>,
    pub condition: Condition,
    pub digest: Digest,
    pub distance: f64,
    pub way_points: u32,
}

impl Mind {
    /// What other robots take this one to be: what its positioning says, or where it is if that says
    /// nothing any more.
    pub fn perceived(&self, body: &Neighbour) -> Neighbour {
        if self.condition.down || self.condition.sensors_frozen {
            return *body;
        }
        let (position, velocity) = (self.estimate.pose.position, self.estimate.twist.linear);
        Neighbour {
            position,
            velocity,
            ..*body
        }
    }
}

/// What state a robot is in, as opposed to where.
#[derive(Clone, Copy, Debug, Default)]
pub struct Condition {
    pub started: bool,
    pub down: bool,
    pub motor_stuck: bool,
    pub sensors_frozen: bool,
    pub finished: bool,
    pub failed: bool,
}

impl Condition {
    /// Whether the robot neither moves nor senses as it should.
    pub fn is_impaired(&self) -> bool {
        self.motor_stuck || self.sensors_frozen
    }

    /// Whether the robot is up and its program has reached its goal.
    pub fn has_finished(&self) -> bool {
        !self.down && self.finished && !self.failed
    }
}

/// A robot's own clock.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    pub offset: Duration,
    /// Seconds it counts in a second.
    pub rate: f64,
}

impl Clock {
    /// What the clock shows.
    pub fn read(&self, now: Time) -> Time {
        if self.rate == 1.0 {
            return now + self.offset;
        }
        Time((now.0 as f64 * self.rate) as u64) + self.offset
    }

    /// How long a span of this clock takes.
    pub fn real(&self, span: Duration) -> Duration {
        if self.rate == 1.0 {
            return span;
        }
        Duration((span.0 as f64 / self.rate) as u64)
    }
}

/// Hidden obstacles that a robot has met.
#[derive(Clone, Debug)]
pub struct Knowledge {
    /// Indices in the world.
    pub met: Vec<u32>,
    /// All that it knows.
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
    pub sequence: u32,
    pub destination: starl_core::Destination,
    pub message: Message,
}
