//! Commands to a Crazyflie. A set-point holds for half a second; a manoeuvre is flown by the Crazyflie itself.
//!
//! Angles are in degrees here, as on the wire. Pitch is positive nose up, roll positive to the right, yaw positive to the
//! left.

use crate::packet::{Numbers, Packet, port};

/// A set-point: the motion until the next one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SetPoint {
    /// The motors stop at once, and a Crazyflie in the air falls.
    Stop,
    /// A velocity.
    Velocity {
        /// World frame, metres per second.
        velocity: [f32; 3],
        /// Degrees per second.
        yaw_rate: f32,
    },
    /// A tilt at a height.
    Height {
        /// Degrees.
        roll: f32,
        /// Degrees.
        pitch: f32,
        /// Degrees per second.
        yaw_rate: f32,
        /// Metres.
        height: f32,
    },
    /// A tilt and a climb.
    Climb {
        /// Degrees.
        roll: f32,
        /// Degrees.
        pitch: f32,
        /// Degrees per second.
        yaw_rate: f32,
        /// Metres per second.
        climb: f32,
    },
    /// A velocity at a height.
    Hover {
        /// Forward and left, metres per second.
        velocity: [f32; 2],
        /// Degrees per second.
        yaw_rate: f32,
        /// Metres.
        height: f32,
    },
    /// A place.
    Position {
        /// World frame, metres.
        position: [f32; 3],
        /// Degrees.
        yaw: f32,
    },
}

/// A manoeuvre of the high-level commander, or a command about set-points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Order {
    /// Manoeuvres may take the place of set-points from now on.
    ReleaseSetPoints,
    /// Take off.
    TakeOff {
        /// Metres.
        height: f32,
        /// Seconds.
        duration: f32,
    },
    /// Land, and stop the motors.
    Land {
        /// Seconds.
        duration: f32,
    },
    /// Fly to a place.
    GoTo {
        /// Whether the place and the yaw are measured from the present ones.
        relative: bool,
        /// Metres.
        position: [f32; 3],
        /// Radians.
        yaw: f32,
        /// Seconds.
        duration: f32,
    },
    /// The motors stop at once.
    Stop,
    /// Lets the motors start, or forbids it.
    Arm(bool),
}

/// All Crazyflies of a group are meant.
const EVERY_GROUP: u8 = 0;

fn floats(content: &mut Vec<u8>, numbers: &[f32]) {
    content.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
}

impl SetPoint {
    /// The packet.
    pub fn encode(&self) -> Packet {
        let (kind, numbers) = match *self {
            SetPoint::Stop => (0, vec![]),
            SetPoint::Velocity {
                velocity: [x, y, z],
                yaw_rate,
            } => (8, vec![x, y, z, yaw_rate]),
            SetPoint::Height {
                roll,
                pitch,
                yaw_rate,
                height,
            } => (9, vec![roll, pitch, yaw_rate, height]),
            SetPoint::Climb {
                roll,
                pitch,
                yaw_rate,
                climb,
            } => (4, vec![roll, pitch, yaw_rate, climb]),
            SetPoint::Hover {
                velocity: [x, y],
                yaw_rate,
                height,
            } => (10, vec![x, y, yaw_rate, height]),
            SetPoint::Position {
                position: [x, y, z],
                yaw,
            } => (7, vec![x, y, z, yaw]),
        };
        let mut content = vec![kind];
        floats(&mut content, &numbers);
        Packet::new(port::COMMANDER, 0, &content)
    }

    /// Reads a packet; none if it is not a set-point of these kinds, or a number in it is not finite.
    pub fn decode(packet: &Packet) -> Option<SetPoint> {
        let (&kind, rest) = packet.content.split_first()?;
        if (packet.port, packet.channel) != (port::COMMANDER, 0) {
            return None;
        }
        if kind == 0 {
            return Some(SetPoint::Stop);
        }
        let mut numbers = Numbers(rest);
        let [a, b, c, d] = [
            numbers.f32()?,
            numbers.f32()?,
            numbers.f32()?,
            numbers.f32()?,
        ];
        Some(match kind {
            // Until protocol version 8 three kinds turned the other way.
            1 => SetPoint::Velocity {
                velocity: [a, b, c],
                yaw_rate: -d,
            },
            2 => SetPoint::Height {
                roll: a,
                pitch: b,
                yaw_rate: -c,
                height: d,
            },
            5 => SetPoint::Hover {
                velocity: [a, b],
                yaw_rate: -c,
                height: d,
            },
            4 => SetPoint::Climb {
                roll: a,
                pitch: b,
                yaw_rate: c,
                climb: d,
            },
            7 => SetPoint::Position {
                position: [a, b, c],
                yaw: d,
            },
            8 => SetPoint::Velocity {
                velocity: [a, b, c],
                yaw_rate: d,
            },
            9 => SetPoint::Height {
                roll: a,
                pitch: b,
                yaw_rate: c,
                height: d,
            },
            10 => SetPoint::Hover {
                velocity: [a, b],
                yaw_rate: c,
                height: d,
            },
            _ => return None,
        })
    }
}

impl Order {
    /// The packet.
    pub fn encode(&self) -> Packet {
        let high_level = |kind: u8, rest: &[&[u8]]| {
            let content = [&[kind, EVERY_GROUP], &*rest.concat()].concat();
            Packet::new(port::HIGH_LEVEL, 0, &content)
        };
        let upright = |height: f32, duration: f32| {
            // The yaw stays as it is.
            let mut content = Vec::new();
            floats(&mut content, &[height, 0.0]);
            content.push(1);
            floats(&mut content, &[duration]);
            content
        };
        match *self {
            Order::ReleaseSetPoints => Packet::new(port::COMMANDER, 1, &[0; 5]),
            Order::TakeOff { height, duration } => high_level(7, &[&upright(height, duration)]),
            Order::Land { duration } => high_level(8, &[&upright(0.0, duration)]),
            Order::GoTo {
                relative,
                position: [x, y, z],
                yaw,
                duration,
            } => {
                let mut content = vec![u8::from(relative), 0];
                floats(&mut content, &[x, y, z, yaw, duration]);
                high_level(12, &[&content])
            }
            Order::Stop => high_level(3, &[]),
            Order::Arm(arm) => Packet::new(port::PLATFORM, 0, &[1, u8::from(arm)]),
        }
    }

    /// Reads a packet; none if it is not an order of these kinds, or a number in it is not finite.
    pub fn decode(packet: &Packet) -> Option<Order> {
        let content = &*packet.content;
        match (packet.port, packet.channel, content) {
            (port::COMMANDER, 1, [0, ..]) => Some(Order::ReleaseSetPoints),
            (port::PLATFORM, 0, [1, arm, ..]) => Some(Order::Arm(*arm != 0)),
            (port::HIGH_LEVEL, 0, [kind, _, rest @ ..]) => high_level(*kind, Numbers(rest)),
            _ => None,
        }
    }
}

fn high_level(kind: u8, mut rest: Numbers<'_>) -> Option<Order> {
    Some(match kind {
        3 => Order::Stop,
        4 | 12 => {
            let relative = rest.u8()? != 0;
            if kind == 12 {
                // Whether the way is straight.
                rest.u8()?;
            }
            Order::GoTo {
                relative,
                position: [rest.f32()?, rest.f32()?, rest.f32()?],
                yaw: rest.f32()?,
                duration: rest.f32()?,
            }
        }
        7 | 8 => {
            let (height, _yaw, _keep) = (rest.f32()?, rest.f32()?, rest.u8()?);
            let duration = rest.f32()?;
            match kind {
                7 => Order::TakeOff { height, duration },
                _ => Order::Land { duration },
            }
        }
        _ => return None,
    })
}
