//! The emulated robot's response to commands, and the content of its packets.

use super::Hazards;
use crate::BodyHandle;
use starl_core::Command;
use starl_create::METRES_PER_COUNT;
use starl_create::command::OpenInterface;
use starl_create::sensor::{self, Mode, bumps};
use starl_create::stream::encode_frame;

/// Charge of a full battery, mAh: the Create 2's.
const CAPACITY: i32 = 2696;
/// The current of the robot while its interface is open, mA.
const CURRENT: i32 = -200;

#[derive(Debug)]
pub(super) struct Interface {
    body: BodyHandle,
    wheel_distance: f64,
    mode: Mode,
    hazards: Hazards,
    /// The commanded speeds of the wheels, left and right, millimetres per second.
    wheels: [i16; 2],
    /// The last [`OpenInterface::Drive`].
    drive: [i16; 2],
    /// Millimetres and degrees that packets have reported.
    told: [i64; 2],
    stream: Vec<u8>,
    streaming: bool,
}

impl Interface {
    pub fn new(body: BodyHandle) -> Interface {
        // The rim of a wheel is as fast as the body drives, and turns it about the other wheel.
        let limits = body.model().limits();
        Interface {
            body,
            wheel_distance: 2.0 * limits.speed / limits.turn_rate,
            mode: Mode::Off,
            hazards: Hazards::default(),
            wheels: [0; 2],
            drive: [0; 2],
            told: [0; 2],
            stream: Vec::new(),
            streaming: false,
        }
    }

    pub fn mode(&self) -> Mode {
        self.mode
    }

    pub fn set_hazards(&mut self, hazards: Hazards) {
        self.hazards = hazards;
        self.watch();
    }

    pub fn halt(&mut self) {
        self.wheels = [0; 2];
        self.drive = [0; 2];
        self.body.command(Command::Stop);
    }

    /// Does what a command says, and appends what the robot answers.
    pub fn take(&mut self, command: &OpenInterface, answer: &mut Vec<u8>) {
        if self.mode == Mode::Off && !matches!(command, OpenInterface::Start | OpenInterface::Reset)
        {
            return;
        }
        match *command {
            OpenInterface::Reset => {
                self.enter(Mode::Off);
                answer.extend(b"bl-start\r\nStarL emulated Create\r\n");
            }
            OpenInterface::Stop => self.enter(Mode::Off),
            OpenInterface::Start | OpenInterface::Passive => self.enter(Mode::Passive),
            OpenInterface::Safe => self.enter(Mode::Safe),
            OpenInterface::Full => self.enter(Mode::Full),
            OpenInterface::DriveDirect { right, left } => {
                self.turn_wheels([left, right].map(|speed| speed.clamp(-500, 500)));
            }
            OpenInterface::DrivePower { right, left } => {
                let speed = |power: i16| (i32::from(power.clamp(-255, 255)) * 500 / 255) as i16;
                self.turn_wheels([left, right].map(speed));
            }
            OpenInterface::Drive { speed, radius } => self.drive_arc(speed, radius),
            OpenInterface::Sensors(packet) => self.packets(&[packet], false, answer),
            OpenInterface::Query(ref packets) => self.packets(packets, false, answer),
            OpenInterface::Stream(ref packets) => {
                self.stream.clone_from(packets);
                self.streaming = true;
            }
            OpenInterface::StreamOn(on) => self.streaming = on,
            OpenInterface::Other(_) => {}
        }
        self.watch();
    }

    /// The step that runs every 15 ms.
    pub fn tick(&mut self, answer: &mut Vec<u8>) {
        self.watch();
        if self.streaming && self.mode != Mode::Off && !self.stream.is_empty() {
            let packets = self.stream.clone();
            let mut content = Vec::new();
            self.packets(&packets, true, &mut content);
            // The robot ignores a stream that is too long for its frame.
            if content.len() < 256 {
                encode_frame(&content, answer);
            }
        }
    }

    /// Goes over to a mode; motors stop whenever the user does not keep control.
    fn enter(&mut self, mode: Mode) {
        self.mode = mode;
        if !mode.drives() {
            self.halt();
        }
        if mode == Mode::Off {
            self.streaming = false;
        }
    }

    fn watch(&mut self) {
        if self.mode == Mode::Safe && (self.hazards.cliff || self.hazards.wheel_drop) {
            self.enter(Mode::Passive);
        }
        if self.hazards.wheel_drop {
            // Wheels in the air move nothing.
            self.body.command(Command::Stop);
        }
    }

    fn drive_arc(&mut self, speed: i16, radius: i16) {
        let speed = speed.clamp(-500, 500);
        let millimetres = 1000.0 * self.wheel_distance;
        let wheels = match radius {
            i16::MIN | i16::MAX => [speed, speed],
            1 => [-speed, speed],
            -1 => [speed, -speed],
            // Radius 0 is in no specification; the robot drives straight.
            0 => [speed, speed],
            radius => {
                let ratio = 0.5 * millimetres / f64::from(radius.clamp(-2000, 2000));
                [1.0 - ratio, 1.0 + ratio].map(|wheel| (f64::from(speed) * wheel).round() as i16)
            }
        };
        self.turn_wheels(wheels.map(|wheel| wheel.clamp(-500, 500)));
        if self.mode.drives() {
            self.drive = [speed, radius];
        }
    }

    fn turn_wheels(&mut self, wheels: [i16; 2]) {
        if self.mode.drives() {
            self.wheels = wheels;
            let [left, right] = wheels.map(|speed| 0.001 * f64::from(speed));
            self.body.command(Command::Wheels { left, right });
        }
    }

    /// Appends packets, each after its number if `numbered`. Groups give all their members.
    fn packets(&mut self, packets: &[u8], numbered: bool, out: &mut Vec<u8>) {
        for &packet in packets {
            if numbered {
                out.push(packet);
            }
            for member in sensor::members(packet) {
                let value = self.value(member);
                sensor::encode(member, value, out);
            }
        }
    }

    fn value(&mut self, packet: u8) -> i32 {
        let odometer = self.body.odometer();
        match packet {
            7 => self.bumps(),
            9..=12 => i32::from(self.hazards.cliff),
            19 => self.untold(0, 1000.0 * odometer.distance),
            20 => self.untold(1, odometer.turn.to_degrees()),
            22 => 16_000,
            23 => CURRENT,
            24 => 25,
            25 => self.charge(),
            26 => CAPACITY,
            35 => self.mode as i32,
            38 => self.stream.len() as i32,
            39 => i32::from(self.drive[0]),
            40 => i32::from(self.drive[1]),
            41 => i32::from(self.wheels[1]),
            42 => i32::from(self.wheels[0]),
            43 | 44 => {
                let side = if packet == 43 { -0.5 } else { 0.5 };
                let driven = odometer.distance + side * self.wheel_distance * odometer.turn;
                (driven / METRES_PER_COUNT).floor() as i64 as i32
            }
            _ => 0,
        }
    }

    fn bumps(&self) -> i32 {
        let mut bits = 0;
        if let Some(contact) = self.body.bumper() {
            if contact.left() {
                bits |= bumps::LEFT;
            }
            if contact.right() {
                bits |= bumps::RIGHT;
            }
        }
        if self.hazards.wheel_drop {
            bits |= bumps::BOTH_WHEELS;
        }
        i32::from(bits)
    }

    /// The whole units that packets have not reported yet.
    fn untold(&mut self, which: usize, total: f64) -> i32 {
        let new = (total.trunc() as i64 - self.told[which]).clamp(-32_768, 32_767);
        self.told[which] += new;
        new as i32
    }

    /// The battery empties with the world's time.
    fn charge(&self) -> i32 {
        let hours = self.body.elapsed().seconds() / 3600.0;
        (CAPACITY + (f64::from(CURRENT) * hours) as i32).max(0)
    }
}
