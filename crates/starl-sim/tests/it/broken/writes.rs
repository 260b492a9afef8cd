//! A shared variable whose last writer wins by the robots' own clocks: if these differ, a later write with an earlier
//! time is lost.

use starl_core::event::SharedMemoryEvent;
use starl_core::event::storing::Written;
use starl_core::{Destination, Message, Port, Primitives, Program, Robot, RobotId, Time};

const PORT: Port = Port::PROGRAM;

/// A robot that writes a variable now and then.
#[derive(Clone, Debug, Default, Primitives)]
pub struct Writer {
    held: Option<(Time, RobotId, u32)>,
}

impl Writer {
    fn report(&self, robot: &mut Robot<'_>, event: fn(Written) -> SharedMemoryEvent) {
        let Some((time, writer, value)) = self.held else {
            return;
        };
        let written = Written {
            variable: "x".into(),
            single_writer: false,
            time,
            count: 0,
            writer,
            incarnation: 0,
            value: value.into(),
        };
        robot.report(PORT, event(written));
    }
}

impl Program for Writer {
    fn start(&mut self, robot: &mut Robot<'_>) {
        robot.report(PORT, SharedMemoryEvent::Start);
    }

    fn activate(&mut self, robot: &mut Robot<'_>) {
        if robot.random().chance(0.03) {
            let value = robot.random().below(1000);
            // The mistake: the time of what it has heard of counts for nothing.
            self.held = Some((robot.now(), robot.id(), value));
            self.report(robot, |written| SharedMemoryEvent::Write { written });
        }
        // Again and again, so that it gets through.
        if let Some(held) = self.held {
            robot.transmit(Destination::All, PORT, &held);
        }
    }

    fn receive(&mut self, robot: &mut Robot<'_>, message: &Message) {
        let Some(heard) = message.read::<(Time, RobotId, u32)>() else {
            return;
        };
        let is_later = |held: (Time, RobotId, u32)| (held.0, held.1) < (heard.0, heard.1);
        if self.held.is_none_or(is_later) {
            self.held = Some(heard);
            self.report(robot, |written| SharedMemoryEvent::Update { written });
        }
    }
}
