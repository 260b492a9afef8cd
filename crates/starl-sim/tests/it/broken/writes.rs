//! A shared variable whose last writer wins by the robots' own clocks: where these are apart, a later write
//! with an earlier time is lost.

use starl_core::{Destination, Message, Port, Program, Robot, RobotId, Time, Value};

const PORT: Port = Port::PROGRAM;
const KIND: &str = "shared_memory";

/// A robot that writes a variable now and then.
#[derive(Clone, Debug, Default)]
pub struct Writer {
    held: Option<(Time, RobotId, u32)>,
}

impl Writer {
    fn report(&self, robot: &mut Robot<'_>, event: &'static str) {
        let Some((time, writer, value)) = self.held else {
            return;
        };
        let fields = [
            ("variable", "x".into()),
            ("single_writer", false.into()),
            ("time", time.into()),
            ("count", 0u32.into()),
            ("writer", writer.into()),
            ("incarnation", 0u32.into()),
            ("value", Value::Int(value.into())),
        ];
        robot.emit_primitive(KIND, PORT, event, fields);
    }
}

impl Program for Writer {
    fn start(&mut self, robot: &mut Robot<'_>) {
        robot.emit_primitive(KIND, PORT, "start", []);
    }

    fn activate(&mut self, robot: &mut Robot<'_>) {
        if robot.random().chance(0.03) {
            let value = robot.random().below(1000);
            // The mistake: the time of what it has heard of counts for nothing.
            self.held = Some((robot.now(), robot.id(), value));
            self.report(robot, "write");
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
            self.report(robot, "update");
        }
    }
}
