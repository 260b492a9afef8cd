//! Ricart and Agrawala's algorithm with the half of the order left out that breaks ties.

use starl_core::{Destination, Message, Port, Program, Robot, RobotId, Value};
use std::fmt::Write;

/// Enters a critical section once. Of two requests with the same time, each robot gives way to the
/// other's.
#[derive(Clone, Debug, Default)]
pub struct Tieless {
    clock: u32,
    /// The time of its request, while it waits.
    asked: Option<u32>,
    permits: u32,
    holds: bool,
    deferred: Vec<RobotId>,
    has_asked: bool,
}

impl Tieless {
    fn tell(robot: &mut Robot<'_>, event: &'static str) {
        let resource = Value::Text("a".into());
        robot.emit_primitive("mutex", Port::PROGRAM, event, [("resource", resource)]);
    }

    fn permit(robot: &mut Robot<'_>, peer: RobotId) {
        robot.transmit(Destination::Robot(peer), Port::PROGRAM, &None::<u32>);
    }
}

impl Program for Tieless {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        if !self.has_asked {
            self.has_asked = true;
            self.clock += 1;
            self.asked = Some(self.clock);
            robot.transmit(Destination::All, Port::PROGRAM, &Some(self.clock));
        } else if self.holds {
            self.holds = false;
            Tieless::tell(robot, "release");
            for peer in std::mem::take(&mut self.deferred) {
                Tieless::permit(robot, peer);
            }
        }
    }

    fn receive(&mut self, robot: &mut Robot<'_>, message: &Message) {
        match message.read::<Option<u32>>() {
            Some(Some(time)) => {
                self.clock = self.clock.max(time);
                // The algorithm compares (asked, robot.id()) with (time, message.from).
                if self.holds || self.asked.is_some_and(|asked| asked < time) {
                    self.deferred.push(message.from);
                } else {
                    Tieless::permit(robot, message.from);
                }
            }
            Some(None) => {
                self.permits += 1;
                if self.permits as usize == robot.peers().count() {
                    self.asked = None;
                    self.holds = true;
                    Tieless::tell(robot, "enter");
                }
            }
            None => {}
        }
    }

    fn write_state(&self, text: &mut dyn Write) -> bool {
        write!(text, "{self:?}").is_ok()
    }
}
