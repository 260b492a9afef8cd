//! What a state machine asks of its host.

use crate::event::{Event, Name};
use crate::{MotionRequest, Payload, Port, RobotId, time::Duration};
use alloc::vec::Vec;
use serde::{Deserialize, Serialize};

/// To whom a transmission goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Destination {
    /// Every robot that the network reaches, the sender left out.
    All,
    /// One robot.
    Robot(RobotId),
}

/// Names a timer of one robot. Arming a key that is armed already moves it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct TimerKey {
    /// Whose timer it is.
    pub port: Port,
    /// What for: each owner numbers its kinds.
    pub kind: u16,
    /// Which of that kind, e.g. a message's sequence number.
    pub number: u32,
}

/// One effect.
#[derive(Clone, Debug, PartialEq)]
pub enum Effect {
    /// Hand a datagram to the network, which may lose, delay, duplicate or reorder it.
    Transmit {
        /// To whom.
        destination: Destination,
        /// For which endpoint there.
        port: Port,
        /// The content.
        payload: Payload,
    },
    /// Call back with [`crate::Input::Timer`] after this span of the robot's own clock.
    SetTimer {
        /// Which timer.
        key: TimerKey,
        /// From now.
        after: Duration,
    },
    /// Forget a timer; nothing happens if it is not armed.
    CancelTimer(TimerKey),
    /// Ask the motion layer for something.
    Move(MotionRequest),
    /// Write an event into the trace.
    Record(Event),
    /// The program has reached its goal. It still answers messages.
    Finish,
    /// The program cannot go on; the text says why. It is not called again.
    Fail(Name),
}

/// Collects what a state machine asks for, in order.
#[derive(Clone, Debug, Default)]
pub struct Effects {
    /// For the host.
    pub list: Vec<Effect>,
    /// Messages that primitives hand up to their own robot's program.
    pub(crate) upcalls: Vec<crate::Message>,
}
