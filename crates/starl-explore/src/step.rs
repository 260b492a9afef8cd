//! The possible next steps of an exploration, as plain data that can be saved in a file.

use serde::{Deserialize, Serialize};
use starl_core::{Message, Payload, Port, RobotId, TimerKey};
use std::fmt;

/// A datagram on its way.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Datagram {
    /// The sender.
    pub from: RobotId,
    /// The receiver.
    pub to: RobotId,
    /// The endpoint there.
    pub port: Port,
    /// The content; in files two hexadecimal digits a byte.
    #[serde(with = "hexadecimal")]
    pub payload: Vec<u8>,
}

mod hexadecimal {
    use serde::de::Error;
    use serde::{Deserialize, Deserializer, Serializer};

    pub fn serialize<S: Serializer>(bytes: &[u8], serializer: S) -> Result<S::Ok, S::Error> {
        let digits: String = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
        serializer.serialize_str(&digits)
    }

    pub fn deserialize<'a, D: Deserializer<'a>>(deserializer: D) -> Result<Vec<u8>, D::Error> {
        let digits = String::deserialize(deserializer)?;
        let pairs = digits.as_bytes().chunks(2);
        let byte = |pair: &[u8]| {
            let text = std::str::from_utf8(pair)
                .ok()
                .filter(|text| text.len() == 2);
            let byte = text.and_then(|text| u8::from_str_radix(text, 16).ok());
            byte.ok_or_else(|| D::Error::custom("a payload is two hexadecimal digits a byte"))
        };
        pairs.map(byte).collect()
    }
}

/// One step.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Step {
    /// A control period has passed on a robot.
    Activate(RobotId),
    /// A timer fires.
    Timer(RobotId, TimerKey),
    /// A datagram arrives.
    Deliver(Datagram),
    /// A datagram arrives, and will arrive again.
    Duplicate(Datagram),
    /// A datagram gets lost.
    Lose(Datagram),
    /// A robot crashes, and its program loses all state.
    Crash(RobotId),
    /// A robot that was down restarts.
    Restart(RobotId),
    /// The same, and all datagrams that were on their way to it have got lost while it was down.
    RestartDeaf(RobotId),
    /// A robot's failure detector suspects another robot.
    Suspect(RobotId, RobotId),
    /// A robot's failure detector trusts another robot again.
    Trust(RobotId, RobotId),
    /// The clock of one robot advances by a tick.
    Tick(RobotId),
    /// All clocks advance by a tick.
    TickAll,
}

impl Datagram {
    /// As the receiver gets it.
    pub fn message(&self) -> Message {
        Message {
            from: self.from,
            port: self.port,
            payload: Payload::from_slice(&self.payload),
        }
    }
}

impl Step {
    /// The robot to which it happens; none where it happens to all.
    pub fn robot(&self) -> Option<RobotId> {
        match self {
            Step::Activate(robot)
            | Step::Timer(robot, _)
            | Step::Crash(robot)
            | Step::Restart(robot)
            | Step::RestartDeaf(robot)
            | Step::Suspect(robot, _)
            | Step::Trust(robot, _)
            | Step::Tick(robot) => Some(*robot),
            Step::Deliver(datagram) | Step::Duplicate(datagram) | Step::Lose(datagram) => {
                Some(datagram.to)
            }
            Step::TickAll => None,
        }
    }
}

impl fmt::Display for Step {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Step::Activate(robot) => write!(f, "robot {robot} is activated"),
            Step::Timer(robot, key) => {
                write!(f, "timer {} of robot {robot} fires", key.token)
            }
            Step::Deliver(Datagram { from, to, .. }) => {
                write!(f, "a datagram from robot {from} reaches robot {to}")
            }
            Step::Duplicate(Datagram { from, to, .. }) => write!(
                f,
                "a datagram from robot {from} reaches robot {to}, and a copy stays in transit"
            ),
            Step::Lose(Datagram { from, to, .. }) => {
                write!(f, "a datagram from robot {from} to robot {to} gets lost")
            }
            Step::Crash(robot) => write!(f, "robot {robot} crashes"),
            Step::Restart(robot) => write!(f, "robot {robot} restarts"),
            Step::RestartDeaf(robot) => write!(
                f,
                "robot {robot} restarts; the datagrams in transit to it are lost"
            ),
            Step::Suspect(robot, peer) => write!(f, "robot {robot} suspects robot {peer}"),
            Step::Trust(robot, peer) => write!(f, "robot {robot} trusts robot {peer} again"),
            Step::Tick(robot) => write!(f, "the clock of robot {robot} ticks"),
            Step::TickAll => write!(f, "all clocks tick"),
        }
    }
}
