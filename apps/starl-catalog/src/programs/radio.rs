//! A robot that drives in circles, broadcasts four bytes at every activation and reads all messages that it receives.

use starl_core::{Command, Destination, Message, Payload, Port, Primitives, Program, Robot};

/// The program of one robot.
#[derive(Clone, Copy, Debug, Default, Primitives)]
pub struct Radio {
    /// Made of every byte heard so far, in order. It is what the robot sends next, so a run's digest
    /// shows whether every message was read.
    heard: u32,
}

impl Program for Radio {
    fn activate(&mut self, robot: &mut Robot<'_>) {
        robot.drive(Command::Wheels {
            left: 0.05,
            right: 0.025,
        });
        let payload = Payload::from_slice(&self.heard.to_le_bytes());
        robot.transmit_bytes(Destination::All, Port::PROGRAM, payload);
    }

    fn receive(&mut self, _: &mut Robot<'_>, message: &Message) {
        let add = |heard: u32, &byte: &u8| heard.wrapping_mul(31).wrapping_add(u32::from(byte));
        self.heard = message.payload.iter().fold(self.heard.wrapping_add(1), add);
    }
}
