//! Primitives between the host and the program: what they report is not lost.

use super::{Bound, Report};
use crate::robot::code::Instance;
use alloc::vec::Vec;
use starl_core::{Input, Payload, Port, Primitive, Robot};

/// A primitive whose reports are taken down after each input. Where the program handles them the
/// robot delivers an empty message to itself, so that they are handled at once.
pub struct Attended<'a> {
    /// The primitive.
    pub bound: &'a mut dyn Bound,
    /// Where it listens.
    pub port: Port,
    /// What the program says of it.
    pub form: &'a Instance,
    /// Its number among the program's primitives.
    pub number: u32,
    /// Where its reports go, with its number.
    pub reports: &'a mut Vec<(u32, Report)>,
}

impl Primitive for Attended<'_> {
    fn port(&self) -> Port {
        self.port
    }

    fn handle(&mut self, robot: &mut Robot<'_>, input: &Input) {
        if let Some(primitive) = self.bound.primitive() {
            primitive.handle(robot, input);
        }
        let before = self.reports.len();
        self.bound.take_reports(&mut |report| {
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
}
