//! Effects: the requests of a state machine to its host.

use crate::event::{Event, Name};
use crate::{Destination, MotionRequest, Payload, Port, Save, TimerKey, time::Duration};
use alloc::boxed::Box;
use alloc::vec::Vec;
use core::any::Any;
use core::fmt;
use serde::{Deserialize, Serialize};

/// One effect.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Effect {
    /// Hand a datagram to the network, which may lose, delay, duplicate or reorder it.
    Transmit {
        /// The receivers.
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
    /// Take hold of a thing within reach, by its index among the world's things. Whether it worked shows in
    /// [`crate::Sensors::holding`].
    Take(u32),
    /// Put down what the robot holds.
    PutDown,
    /// Write a value to storage. All effects of this input and of later ones take place only after that.
    Save(Save),
    /// The program has reached its goal. It still answers messages.
    Finish,
    /// The program cannot continue; the text says why. It is not called again.
    Fail(Name),
}

/// Collects what a state machine asks for, in order.
#[derive(Clone, Debug, Default)]
pub struct Effects {
    /// For the host.
    pub list: Vec<Effect>,
    /// Messages that primitives hand up to their own robot's program.
    pub(crate) upcalls: Vec<crate::Message>,
    /// The verdicts of a failure detector for the other primitives of its robot.
    pub(crate) verdicts: Vec<crate::Input>,
    /// Room for work.
    pub(crate) scratch: Scratch,
}

/// Working memory that outlives an input, so that a state machine need not allocate it for each
/// input. A host that uses the same [`Effects`] for many robots shares it among them, so its content
/// must not influence a state machine. Copies are empty.
#[derive(Default)]
pub(crate) struct Scratch(Option<Box<dyn Any + Send + Sync>>);

impl Scratch {
    /// Takes the kept value; none if there is none, or one of another type.
    pub fn take<T: Any + Send + Sync>(&mut self) -> Option<Box<T>> {
        self.0.take()?.downcast().ok()
    }

    /// Keeps something.
    pub fn keep<T: Any + Send + Sync>(&mut self, content: Box<T>) {
        self.0 = Some(content);
    }
}

impl Clone for Scratch {
    fn clone(&self) -> Scratch {
        Scratch::default()
    }
}

impl fmt::Debug for Scratch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Scratch")
    }
}
