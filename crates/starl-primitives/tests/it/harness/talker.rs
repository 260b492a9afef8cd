//! A program that sends messages on command, and reports received ones.

use starl_core::timer::{Timer, Token};
use starl_core::{Area, Message, Point, Primitives, Program, Robot, RobotId, TimerKey, message};
use starl_primitives::reliable::Options;
use starl_primitives::{Broadcast, Geocast, Unicast};

/// The area that geocasts are addressed to.
pub const AREA: Area = Area::Circle {
    center: Point::ZERO,
    radius: 1.0,
};

#[derive(Clone, Primitives)]
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

#[derive(Clone, Copy, Debug)]
pub enum Command {
    Broadcast(u32),
    Geocast(u32),
    Unicast(u8, u32),
}

impl Timer for Command {
    fn token(self) -> Token {
        let (what, to, value) = match self {
            Command::Broadcast(value) => (0, 0, value),
            Command::Geocast(value) => (1, 0, value),
            Command::Unicast(to, value) => (2, to, value),
        };
        Token::new(u16::from_be_bytes([what, to]), value)
    }

    fn from_token(token: Token) -> Option<Command> {
        let (kind, value) = token.parts();
        match kind.to_be_bytes() {
            [0, 0] => Some(Command::Broadcast(value)),
            [1, 0] => Some(Command::Geocast(value)),
            [2, to] => Some(Command::Unicast(to, value)),
            _ => None,
        }
    }
}

/// Tells a talker to broadcast a value; a value above 1,000,000 is sent in a long message.
pub fn broadcast(value: u32) -> Command {
    Command::Broadcast(value)
}

/// Tells a talker to geocast a value to [`AREA`].
pub fn geocast(value: u32) -> Command {
    Command::Geocast(value)
}

/// Tells a talker to send a value to one robot.
pub fn unicast(to: u8, value: u32) -> Command {
    Command::Unicast(to, value)
}

impl Program for Talker {
    fn activate(&mut self, _: &mut Robot<'_>) {}

    fn timer(&mut self, robot: &mut Robot<'_>, key: TimerKey) {
        let content = |value: u32| {
            let padding = if value > 1_000_000 { 2000 } else { 0 };
            (value, vec![0u8; padding])
        };
        match key.read().expect("a command") {
            Command::Broadcast(value) => self.broadcast.broadcast(robot, &content(value)),
            Command::Geocast(value) => self.geocast.geocast(robot, &content(value), &AREA),
            Command::Unicast(to, value) => {
                self.unicast
                    .send(robot, RobotId(to.into()), &content(value))
            }
        };
    }

    fn receive(&mut self, robot: &mut Robot<'_>, message: &Message) {
        let (value, _): (u32, Vec<u8>) = message::decode(&message.payload).expect("our encoding");
        robot.emit(
            "got",
            [("from", message.from.into()), ("value", value.into())],
        );
    }
}
