//! Sensor packets: what the robot measures, by the number of the packet.
//!
//! A packet has a fixed length and no header. Group packets are packets one after the other.

/// Bumpers and dropped wheels: bits.
pub const BUMPS: u8 = 7;
/// Cliff under the left of the front: 0 or 1; 10 to 12 are front left, front right and right.
pub const CLIFF_LEFT: u8 = 9;
/// Cliff under the right of the front.
pub const CLIFF_RIGHT: u8 = 12;
/// Millimetres driven since the packet was last sent, signed.
pub const DISTANCE: u8 = 19;
/// Degrees turned to the left since the packet was last sent, signed.
pub const ANGLE: u8 = 20;
/// Charge of the battery, mAh.
pub const CHARGE: u8 = 25;
/// Charge of the full battery, mAh.
pub const CAPACITY: u8 = 26;
/// The mode: 0 off, 1 passive, 2 safe, 3 full.
pub const MODE: u8 = 35;
/// Counts of the left wheel, which wrap around.
pub const ENCODER_LEFT: u8 = 43;
/// Counts of the right wheel, which wrap around.
pub const ENCODER_RIGHT: u8 = 44;

/// Bits of [`BUMPS`].
pub mod bumps {
    /// The right half of the bumper is pressed.
    pub const RIGHT: u8 = 1;
    /// The left half of the bumper is pressed.
    pub const LEFT: u8 = 2;
    /// Either wheel has dropped: the robot is lifted. The older robot has a third wheel in front, bit 16.
    pub const WHEEL_DROP: u8 = 4 | 8 | 16;
    /// The bits that an emulated robot sets when it is lifted.
    pub const BOTH_WHEELS: u8 = 4 | 8;
}

/// The mode of the interface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    /// The interface has not been opened.
    #[default]
    Off,
    /// Sensors can be read; the robot does not drive.
    Passive,
    /// The robot drives; a cliff or a dropped wheel ends this mode.
    Safe,
    /// The robot drives without safety stops.
    Full,
}

impl Mode {
    /// Whether commands drive the robot.
    pub fn drives(self) -> bool {
        matches!(self, Mode::Safe | Mode::Full)
    }

    /// The mode of this number.
    pub fn of(number: i32) -> Option<Mode> {
        [Mode::Off, Mode::Passive, Mode::Safe, Mode::Full]
            .into_iter()
            .find(|&mode| mode as i32 == number)
    }
}

/// The length in bytes of a packet that is not a group.
pub fn length(packet: u8) -> Option<usize> {
    match packet {
        7..=18 | 21 | 24 | 32 | 34..=38 | 45 | 52 | 53 | 58 => Some(1),
        19 | 20 | 22 | 23 | 25..=31 | 33 | 39..=44 | 46..=51 | 54..=57 => Some(2),
        _ => None,
    }
}

/// The packets of a group, or the packet itself.
pub fn members(packet: u8) -> std::ops::RangeInclusive<u8> {
    match packet {
        0 => 7..=26,
        1 => 7..=16,
        2 => 17..=20,
        3 => 21..=26,
        4 => 27..=34,
        5 => 35..=42,
        6 => 7..=42,
        100 => 7..=58,
        101 => 43..=58,
        106 => 46..=51,
        107 => 54..=58,
        packet => packet..=packet,
    }
}

/// The value of a packet from its bytes; `None` if their number is wrong, or the packet is a group.
pub fn value(packet: u8, bytes: &[u8]) -> Option<i32> {
    let signed = matches!(packet, 19 | 20 | 23 | 24 | 39..=42 | 54..=57);
    match (length(packet)?, bytes) {
        (1, &[byte]) if signed => Some(i32::from(byte as i8)),
        (1, &[byte]) => Some(i32::from(byte)),
        (2, &[high, low]) if signed => Some(i32::from(i16::from_be_bytes([high, low]))),
        (2, &[high, low]) => Some(i32::from(u16::from_be_bytes([high, low]))),
        _ => None,
    }
}

/// Appends a packet with this value, of which it takes the lowest bits.
pub fn encode(packet: u8, value: i32, out: &mut Vec<u8>) {
    match length(packet) {
        Some(1) => out.push(value as u8),
        Some(2) => out.extend((value as u16).to_be_bytes()),
        _ => {}
    }
}
