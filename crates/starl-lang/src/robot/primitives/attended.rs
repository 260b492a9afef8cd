//! The link between the host and a program's primitives: their reports are collected, and primitives without work are
//! skipped.
//!
//! Invariant: a primitive with new reports has handled an input, has been called by the program, or was corrupted since
//! its reports were last collected.

use super::bound::BoundPrimitive;
use super::kind::Report;
use super::kinds::KINDS;
use crate::robot::instance::Instance;
use crate::robot::rest::Disturbing;
use alloc::vec::Vec;
use starl_core::{Input, Payload, Port, Primitive, Robot};

/// A primitive whose reports are collected after each input. If the program handles them the robot delivers an empty
/// message to itself, so that they are handled immediately.
pub struct Attended<'a> {
    pub slot: &'a mut BoundPrimitive,
    /// Where it listens.
    pub port: Port,
    /// The instance in the program.
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
        let looks = matches!(input, Input::Activate) && self.slot.bound.looks();
        if !is_needed && !looks && !self.slot.is_stirred {
            return;
        }
        // The guards may depend on the robots that it sees.
        *self.rests &= !looks;
        self.slot.is_stirred = false;
        if let Some(primitive) = self.slot.bound.primitive() {
            let rests = &mut *self.rests;
            Disturbing { primitive, rests }.handle(robot, input);
        }
        let before = self.reports.len();
        self.slot.bound.take_reports(&mut |report| {
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
        if let Some(primitive) = self.slot.bound.primitive() {
            primitive.save(robot);
        }
    }
}
