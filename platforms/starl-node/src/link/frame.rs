//! Frames between the members of a fleet, below the messages of programs.

use super::Refusals;
use super::beacon::Beacon;
use super::quality::Quality;
use serde::{Deserialize, Serialize};
use starl_core::{Event, Payload, Port, Pose, Time};

/// The content of a packet, in postcard's encoding.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Frame {
    /// A datagram of a robot's software.
    Datagram {
        /// The sender's number for it.
        sequence: u32,
        /// For which endpoint.
        port: Port,
        /// The content.
        payload: Payload,
    },
    /// Where a robot is and how it is, several times a second.
    Beacon(Beacon),
    /// An operator asks how a robot is.
    Ask,
    /// The answer.
    Status(Box<Status>),
    /// An operator stops a robot: its motors at once, then its process.
    Halt,
    /// The answer: the motors received the command to stop.
    Halted,
    /// An operator's order to the program, with the operator's number for it.
    Order(u32, starl_core::Order),
    /// The answer to the order of this number, from a robot whose program runs: the program received it.
    Ordered(u32),
    /// An operator requests the events of a robot for the next few seconds.
    Watch,
    /// The answer, several times a second.
    Seen(Box<Seen>),
}

/// The events on a robot since the last such frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Seen {
    /// The robot's time, by the clock of its process.
    pub now: Time,
    /// The start of its process, which distinguishes its lives.
    pub begun: Time,
    /// The number of the first event: all since the robot's start are counted, so that lost ones are noticed.
    pub first: u64,
    /// The state of its program, if the program has one.
    pub state: Option<String>,
    /// The events, with their times.
    pub events: Vec<(Time, Event)>,
}

/// How a robot is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Status {
    /// Its time, by the clock of the process.
    pub now: Time,
    /// How long the process has run.
    pub up: starl_core::Duration,
    /// Whether its program has reached its goal.
    pub finished: bool,
    /// Why its program cannot continue, if so.
    pub failed: Option<String>,
    /// Where it believes to be; none if it does not know.
    pub pose: Option<Pose>,
    /// How old its position is.
    pub position_age: starl_core::Duration,
    /// Why its motors are stopped, if the runtime has stopped them.
    pub stopped: Option<String>,
    /// Charge of its battery, 0 to 1, if it measures that.
    pub battery: Option<f64>,
    /// The state of its program, if the program has one.
    pub state: Option<String>,
    /// How well it hears each other robot.
    pub links: Vec<(u32, Quality)>,
    /// The packets that it has refused.
    pub refused: Refusals,
}
