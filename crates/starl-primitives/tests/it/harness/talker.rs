//! A program that sends what a test tells it to, and reports what it receives.

use super::command;
use starl_core::{Area, Message, Point, Primitive, Program, Robot, RobotId, TimerKey, message};
use starl_primitives::reliable::Options;
use starl_primitives::{Broadcast, Geocast, Unicast};

/// The area that geocasts are addressed to.
pub const AREA: Area = Area::Circle {
    center: Point::ZERO,
    radius: 1.0,
};

#[derive(Clone)]
pub struct Talker {
    broadcast: Broadcast,
    geocast: Geocast,
    unicast: Unicast,
}

impl Talker {
    pub fn new(options: Options) -> Talker {
        Talker {
            broadcast: Broadcast::new("broadcast", options),
            geocast: Geocast::new("geocast", options),
            unicast: Unicast::new("unicast", options),
        }
    }

    pub fn boxed(options: Options) -> impl Fn() -> Box<dyn Program> {
        move || Box::new(Talker::new(options))
    }
}

const BROADCAST: u16 = 0;
const GEOCAST: u16 = 1;
const UNICAST: u16 = 2;

/// Tells a talker to broadcast a value; a value above 1,000,000 is sent in a long message.
pub fn broadcast(value: u32) -> TimerKey {
    command(BROADCAST, value)
}

/// Tells a talker to geocast a value to [`AREA`].
pub fn geocast(value: u32) -> TimerKey {
    command(GEOCAST, value)
}

/// Tells a talker to send a value to one robot.
pub fn unicast(to: u16, value: u32) -> TimerKey {
    command(UNICAST + to, value)
}

impl Program for Talker {
    fn activate(&mut self, _: &mut Robot<'_>) {}

    fn timer(&mut self, robot: &mut Robot<'_>, key: TimerKey) {
        let padding = if key.number > 1_000_000 { 200 } else { 0 };
        let content = (key.number, vec![0u8; padding]);
        match key.kind {
            BROADCAST => self.broadcast.broadcast(robot, &content),
            GEOCAST => self.geocast.geocast(robot, &content, &AREA),
            kind => self
                .unicast
                .send(robot, RobotId(u32::from(kind - UNICAST)), &content),
        };
    }

    fn receive(&mut self, robot: &mut Robot<'_>, message: &Message) {
        let (value, _): (u32, Vec<u8>) = message::decode(&message.payload).expect("our encoding");
        robot.emit(
            "got",
            [("from", message.from.into()), ("value", value.into())],
        );
    }

    fn primitives(&mut self, visit: &mut dyn FnMut(&mut dyn Primitive)) {
        visit(&mut self.broadcast);
        visit(&mut self.geocast);
        visit(&mut self.unicast);
    }
}
