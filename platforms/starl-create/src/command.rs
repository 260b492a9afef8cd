//! Commands of the Open Interface: an opcode, then a number of data bytes that depends on it, big-endian.
//!
//! Commands have no framing: after a lost or added byte the following bytes are misread until an opcode is read as one
//! again. A driver therefore repeats its commands.

use std::collections::VecDeque;

/// A command to the robot. Commands without influence on its motion and sensors are [`OpenInterface::Other`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum OpenInterface {
    /// 7: restarts the robot, as if its battery had been taken out.
    Reset,
    /// 128: opens the interface, in passive mode.
    Start,
    /// 131, and 130 of older robots: takes control, but a cliff or a dropped wheel gives it back.
    Safe,
    /// 132: takes control, and keeps it.
    Full,
    /// 133, and the buttons and demos that leave control to the robot: to passive mode.
    Passive,
    /// 137: one speed and a radius, millimetres.
    Drive {
        /// Millimetres per second.
        speed: i16,
        /// Millimetres to the left; 0x8000 and 0x7FFF mean straight, 1 and -1 a turn on the spot to the left or right.
        radius: i16,
    },
    /// 145: the speed of each wheel, millimetres per second.
    DriveDirect {
        /// Right wheel.
        right: i16,
        /// Left wheel.
        left: i16,
    },
    /// 146: the power of each wheel, -255 to 255.
    DrivePower {
        /// Right wheel.
        right: i16,
        /// Left wheel.
        left: i16,
    },
    /// 142: send this packet or group of packets once.
    Sensors(u8),
    /// 149: send these packets once.
    Query(Vec<u8>),
    /// 148: send these packets every 15 ms.
    Stream(Vec<u8>),
    /// 150: pause the stream or continue with it.
    StreamOn(bool),
    /// 173: closes the interface; motors stop.
    Stop,
    /// Lights, songs and the like, by opcode.
    Other(u8),
}

impl OpenInterface {
    /// Appends the command's bytes. Lists of packets are cut at 255; [`OpenInterface::Other`] has no encoding and
    /// appends nothing.
    pub fn encode(&self, out: &mut Vec<u8>) {
        let mut pair = |opcode, a: i16, b: i16| {
            out.push(opcode);
            out.extend(a.to_be_bytes());
            out.extend(b.to_be_bytes());
        };
        match self {
            OpenInterface::Drive { speed, radius } => pair(137, *speed, *radius),
            OpenInterface::DriveDirect { right, left } => pair(145, *right, *left),
            OpenInterface::DrivePower { right, left } => pair(146, *right, *left),
            OpenInterface::Reset => out.push(7),
            OpenInterface::Start => out.push(128),
            OpenInterface::Safe => out.push(131),
            OpenInterface::Full => out.push(132),
            OpenInterface::Passive => out.push(133),
            OpenInterface::Stop => out.push(173),
            OpenInterface::Sensors(packet) => out.extend([142, *packet]),
            OpenInterface::StreamOn(on) => out.extend([150, u8::from(*on)]),
            OpenInterface::Query(packets) => list(149, packets, out),
            OpenInterface::Stream(packets) => list(148, packets, out),
            OpenInterface::Other(_) => {}
        }
    }

    fn decode(opcode: u8, data: &[u8]) -> OpenInterface {
        let word = |at: usize| i16::from_be_bytes([data[at], data[at + 1]]);
        match opcode {
            7 => OpenInterface::Reset,
            128 => OpenInterface::Start,
            130 | 131 => OpenInterface::Safe,
            132 => OpenInterface::Full,
            133..=136 | 143 => OpenInterface::Passive,
            137 => OpenInterface::Drive {
                speed: word(0),
                radius: word(2),
            },
            145 => OpenInterface::DriveDirect {
                right: word(0),
                left: word(2),
            },
            146 => OpenInterface::DrivePower {
                right: word(0),
                left: word(2),
            },
            142 => OpenInterface::Sensors(data[0]),
            148 => OpenInterface::Stream(data[1..].to_vec()),
            149 => OpenInterface::Query(data[1..].to_vec()),
            150 => OpenInterface::StreamOn(data[0] != 0),
            173 => OpenInterface::Stop,
            _ => OpenInterface::Other(opcode),
        }
    }
}

fn list(opcode: u8, packets: &[u8], out: &mut Vec<u8>) {
    let packets = &packets[..packets.len().min(255)];
    out.extend([opcode, packets.len() as u8]);
    out.extend(packets);
}

/// Finds commands in the bytes that arrive. Unknown bytes are skipped.
#[derive(Clone, Debug, Default)]
pub struct CommandDecoder {
    bytes: VecDeque<u8>,
}

impl CommandDecoder {
    /// Takes bytes that have arrived.
    pub fn push(&mut self, bytes: &[u8]) {
        self.bytes.extend(bytes);
    }

    /// The next command that is complete.
    pub fn pop(&mut self) -> Option<OpenInterface> {
        loop {
            let opcode = *self.bytes.front()?;
            let Some(length) = data_length(opcode) else {
                self.bytes.pop_front();
                continue;
            };
            let data = match length {
                Length::Fixed(length) => length,
                Length::Listed { at, each } => {
                    at + 1 + each * usize::from(*self.bytes.get(at + 1)?)
                }
            };
            if self.bytes.len() < 1 + data {
                return None;
            }
            let command: Vec<u8> = self.bytes.drain(..1 + data).collect();
            return Some(OpenInterface::decode(opcode, &command[1..]));
        }
    }
}

enum Length {
    /// A fixed number of data bytes.
    Fixed(usize),
    /// The data byte `at` says how many items of `each` bytes follow it.
    Listed { at: usize, each: usize },
}

/// The data of an opcode of either robot; `None` if it is not an opcode. Opcode 136 has a data byte on the older robot
/// and none on the newer, whose rule is taken.
fn data_length(opcode: u8) -> Option<Length> {
    Some(match opcode {
        7 | 128 | 130..=136 | 143 | 153 | 154 | 173 => Length::Fixed(0),
        129 | 138 | 141 | 142 | 147 | 150 | 151 | 155 | 158 | 165 => Length::Fixed(1),
        156 | 157 | 162 => Length::Fixed(2),
        139 | 144 | 168 => Length::Fixed(3),
        137 | 145 | 146 | 163 | 164 => Length::Fixed(4),
        167 => Length::Fixed(15),
        140 => Length::Listed { at: 1, each: 2 },
        148 | 149 | 152 => Length::Listed { at: 0, each: 1 },
        _ => return None,
    })
}
