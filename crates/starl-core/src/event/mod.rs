//! The events of a trace: every host writes the same events.

mod fault;
mod fields;
#[macro_use]
mod define;
pub mod agreement;
pub mod messaging;
pub mod moving;
mod primitive;
pub mod storing;
mod value;

pub use agreement::{
    BarrierEvent, ElectionEvent, FailureDetectorEvent, MutexEvent, RegistrationEvent,
};
pub use fault::Fault;
pub use messaging::{BroadcastEvent, GeocastEvent, TransferEvent, UnicastEvent};
pub use moving::ReachAvoidEvent;
pub use primitive::{OtherEvent, PrimitiveEvent};
pub use storing::{RegisterEvent, SharedMemoryEvent};
pub use value::{Fields, Name, Value, ValueRef, ValueRefs, borrowed};

use crate::geometry::{Obstacle, Point, Pose};
use crate::{Destination, Payload, Port, RobotId, time::Time};
use alloc::boxed::Box;
use alloc::vec::Vec;
use serde::{Deserialize, Serialize};

/// An event with its time and robot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// When, by the host's clock.
    pub at: Time,
    /// On which robot; none where the event is the world's.
    pub robot: Option<RobotId>,
    /// The event.
    pub event: Event,
}

/// Something that happened.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Event {
    /// The robot's true pose.
    Moved(Pose),
    /// The pose that the positioning system reported.
    Estimated(Pose),
    /// The robot handed a datagram to the network.
    Sent {
        /// Counts this robot's datagrams.
        sequence: u32,
        /// The receivers.
        destination: Destination,
        /// For which endpoint.
        port: Port,
        /// The content.
        payload: Payload,
    },
    /// A datagram reached the robot.
    Delivered {
        /// Its sender.
        from: RobotId,
        /// The sender's number for it.
        sequence: u32,
    },
    /// A datagram went nowhere; the record's robot is the one on which that was decided.
    Dropped {
        /// Its sender.
        from: RobotId,
        /// The robot that does not receive it; none if there is no receiver.
        to: Option<RobotId>,
        /// The sender's number for it.
        sequence: u32,
        /// Why.
        reason: DropReason,
    },
    /// The body met something and was stopped.
    Collided {
        /// The body or obstacle.
        with: Hit,
    },
    /// A guarded action of the program fired.
    Action(Name),
    /// The program reports an event of its own.
    Program {
        /// Its name.
        name: Name,
        /// Its details.
        fields: Fields,
    },
    /// A primitive was given a command, or reports an outcome.
    #[serde(with = "primitive::wire")]
    Primitive {
        /// Which instance.
        port: Port,
        /// The event.
        event: PrimitiveEvent,
    },
    /// The program's log.
    Log {
        /// How much it matters.
        level: Level,
        /// One line.
        text: Name,
    },
    /// The program draws for the viewer.
    Draw(Mark),
    /// A fault set in or was healed.
    Fault(Fault),
    /// An obstacle the robot did not know was met.
    Discovered(Obstacle),
    /// The program has reached its goal.
    Finished,
    /// The program cannot continue.
    Failed(Name),
    /// A property does not hold.
    Violated {
        /// Which property.
        property: Name,
        /// How.
        text: Name,
    },
    /// The run is steered from outside. Scheduled faults are recorded only as [`Event::Fault`].
    Intervention(Box<crate::Intervention>),
    /// The robot took hold of a thing, by its index among the world's things.
    Took(u32),
    /// The robot put a thing down.
    PutDown {
        /// Which thing.
        thing: u32,
        /// Where it lies now, metres.
        position: Point,
    },
}

/// Why a datagram was not delivered.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DropReason {
    /// Lost at random.
    Loss,
    /// The receiver is out of radio range or of sight, or does not exist. Receivers out of range of a
    /// message to all are not recorded.
    Range,
    /// Sender and receiver are in different parts of a partition.
    Partition,
    /// The receiver is down.
    Down,
    /// The sender's queue was full.
    Bandwidth,
    /// It is larger than the network carries.
    Size,
}

/// The body or obstacle that a body touched.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Hit {
    /// Another robot.
    Robot(RobotId),
    /// An obstacle, by its index in the world.
    Obstacle(u32),
}

/// How much a log line matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Level {
    /// For debugging the program.
    Debug,
    /// Worth knowing.
    Info,
    /// Probably wrong.
    Warning,
    /// Certainly wrong.
    Error,
}

/// Something a program draws for the viewer; each kind replaces what the robot drew under the same
/// label before.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mark {
    /// Identifies the mark on its robot.
    pub label: Name,
    /// The shape.
    pub shape: MarkShape,
}

/// Shapes that programs can draw.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MarkShape {
    /// Nothing: the mark is taken away.
    Nothing,
    /// A dot.
    Dot(Point),
    /// A circle in the floor plane.
    Circle {
        /// Metres.
        center: Point,
        /// Metres.
        radius: f64,
    },
    /// A line through points.
    Line(Vec<Point>),
    /// The mark's label, written here.
    Text(Point),
}
