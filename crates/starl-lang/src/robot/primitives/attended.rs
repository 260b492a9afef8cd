//! Primitives between the host and the program: what they report is not lost, and those that have nothing to
//! do are left alone.
//!
//! Invariant: a primitive that has something to report has taken an input, has been called by the program, or
//! was corrupted since its reports were taken down.

use super::{Bound, KINDS, Report};
use crate::robot::code::Instance;
use crate::robot::rest::Disturbing;
use alloc::boxed::Box;
use alloc::vec::Vec;
use core::fmt;
use starl_core::{Input, Payload, Port, Primitive, Robot};

/// A bound primitive, with what spares looking into it.
#[derive(Clone)]
pub struct Seat {
    /// The primitive.
    pub bound: Box<dyn Bound>,
    /// Where it listens; nowhere, if it has no state machine of its own.
    pub port: Option<Port>,
    /// Whether the program may have called it, or a fault changed it, since its reports were taken down.
    pub is_stirred: bool,
}

impl Seat {
    /// A place for a primitive.
    pub fn new(mut bound: Box<dyn Bound>) -> Seat {
        let port = bound.primitive().map(|primitive| primitive.port());
        Seat {
            bound,
            port,
            is_stirred: true,
        }
    }
}

/// Shows the primitive alone: the rest follows from it, or makes no difference.
impl fmt::Debug for Seat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.bound.fmt(f)
    }
}

/// A primitive whose reports are taken down after each input. Where the program handles them the
/// robot delivers an empty message to itself, so that they are handled at once.
pub struct Attended<'a> {
    /// The primitive.
    pub seat: &'a mut Seat,
    /// Where it listens.
    pub port: Port,
    /// What the program says of it.
    pub form: &'a Instance,
    /// Its number among the program's primitives.
    pub number: u32,
    /// Where its reports go, with its number.
    pub reports: &'a mut Vec<(u32, Report)>,
    /// Whether the program rests.
    pub rests: &'a mut bool,
}

impl Primitive for Attended<'_> {
    fn port(&self) -> Port {
        self.port
    }

    fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) {
        let kind = KINDS.get(usize::from(self.form.kind));
        let is_needed = kind.is_none_or(|kind| kind.attention.is_paid_to(input));
        let looks = matches!(input, Input::Activate) && self.seat.bound.looks();
        if !is_needed && !looks && !self.seat.is_stirred {
            return;
        }
        // The guards may depend on what it sees.
        *self.rests &= !looks;
        self.seat.is_stirred = false;
        if let Some(primitive) = self.seat.bound.primitive() {
            let rests = &mut *self.rests;
            Disturbing { primitive, rests }.handle(robot, input);
        }
        let before = self.reports.len();
        self.seat.bound.take_reports(&mut |report| {
            if self
                .form
                .handlers
                .iter()
                .any(|(event, _)| *event == report.event)
            {
                self.reports.push((self.number, report));
            }
        });
        if self.reports.len() > before {
            robot.deliver(robot.id(), self.port, Payload::new());
        }
    }

    fn save(&mut self, robot: &mut Robot<'_>) {
        if let Some(primitive) = self.seat.bound.primitive() {
            primitive.save(robot);
        }
    }
}
