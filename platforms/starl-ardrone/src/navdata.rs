//! Navdata: what the drone measures and is about, little-endian: a header, bits of state, a sequence number, then
//! options with a tag and a length, the last of which is a checksum.

/// The first bytes of navdata.
const HEADER: u32 = 0x5566_7788;
const DEMO: u16 = 0;
const CHECKSUM: u16 = 0xFFFF;
/// The length of the option [`DEMO`] with its tag and length.
const DEMO_LENGTH: usize = 148;

/// Bits of the drone's state.
pub mod state {
    /// It is in the air.
    pub const FLYING: u32 = 1 << 0;
    /// It has taken a configuration and waits until the client has seen that.
    pub const ACKNOWLEDGED: u32 = 1 << 6;
    /// It sends [`super::Demo`] only.
    pub const DEMO: u32 = 1 << 10;
    /// It sends its state only, until it is configured.
    pub const BOOTSTRAP: u32 = 1 << 11;
    /// A motor has a problem.
    pub const MOTORS: u32 = 1 << 12;
    /// It has heard nothing for 2 s.
    pub const LOST: u32 = 1 << 13;
    /// Its battery is almost empty.
    pub const LOW_BATTERY: u32 = 1 << 15;
    /// It has heard nothing for 50 ms, and no `COMWDG` since.
    pub const WATCHDOG: u32 = 1 << 30;
    /// Its motors are cut.
    pub const EMERGENCY: u32 = 1 << 31;
}

/// The state of the drone's flight control, in the drone's numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ControlState {
    /// It stands on the floor.
    Landed,
    /// It follows commands in the air.
    Flying,
    /// It holds its place.
    Hovering,
    /// It rises.
    TakingOff,
    /// It sinks to the floor.
    Landing,
    /// Something else, by its number.
    Other(u16),
}

/// The states with their numbers.
const CONTROL_STATES: [(u16, ControlState); 5] = [
    (2, ControlState::Landed),
    (3, ControlState::Flying),
    (4, ControlState::Hovering),
    (6, ControlState::TakingOff),
    (8, ControlState::Landing),
];

/// The status that the drone sends about 15 times a second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Navdata {
    /// Bits of [`state`].
    pub state: u32,
    /// Counts datagrams, from 1 when the drone starts.
    pub sequence: u32,
    /// Its measurements.
    pub demo: Option<Demo>,
}

/// The measurements of the option `demo`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Demo {
    /// The state of its flight control.
    pub control: ControlState,
    /// Per cent.
    pub battery: u32,
    /// Nose up, thousandths of a degree.
    pub pitch: f32,
    /// Right side down, thousandths of a degree.
    pub roll: f32,
    /// Turned to the right since it was switched on, thousandths of a degree, -180000 to 180000.
    pub yaw: f32,
    /// Height, millimetres.
    pub altitude: i32,
    /// Millimetres per second forward, to the right and down, in the drone's frame.
    pub velocity: [f32; 3],
}

impl Navdata {
    /// The datagram.
    pub fn encode(&self) -> Vec<u8> {
        let mut out = Vec::with_capacity(16 + DEMO_LENGTH + 8);
        for word in [HEADER, self.state, self.sequence, 0] {
            out.extend(word.to_le_bytes());
        }
        if let Some(demo) = &self.demo {
            demo.encode(&mut out);
        }
        let sum: u32 = out.iter().map(|&byte| u32::from(byte)).sum();
        out.extend(CHECKSUM.to_le_bytes());
        out.extend(8u16.to_le_bytes());
        out.extend(sum.to_le_bytes());
        out
    }

    /// Decodes a datagram. `None` if it is not navdata, is cut off, or has a wrong or missing checksum.
    pub fn decode(datagram: &[u8]) -> Option<Navdata> {
        if word(datagram, 0)? != HEADER {
            return None;
        }
        let mut navdata = Navdata {
            state: word(datagram, 4)?,
            sequence: word(datagram, 8)?,
            demo: None,
        };
        let mut at = 16;
        loop {
            let option = datagram.get(at..)?;
            let tag = u16::from_le_bytes(option.get(..2)?.try_into().ok()?);
            let length = usize::from(u16::from_le_bytes(option.get(2..4)?.try_into().ok()?));
            let option = option.get(..length).filter(|_| length >= 4)?;
            match tag {
                CHECKSUM => {
                    let sum: u32 = datagram[..at].iter().map(|&byte| u32::from(byte)).sum();
                    return (word(option, 4)? == sum).then_some(navdata);
                }
                DEMO => navdata.demo = Some(Demo::decode(option)?),
                _ => {}
            }
            at += length;
        }
    }
}

impl Demo {
    fn encode(&self, out: &mut Vec<u8>) {
        let start = out.len();
        out.extend(DEMO.to_le_bytes());
        out.extend((DEMO_LENGTH as u16).to_le_bytes());
        let control = match self.control {
            ControlState::Other(number) => number,
            named => CONTROL_STATES
                .iter()
                .find(|(_, state)| *state == named)
                .map_or(0, |(number, _)| *number),
        };
        out.extend((u32::from(control) << 16).to_le_bytes());
        out.extend(self.battery.to_le_bytes());
        for number in [self.pitch, self.roll, self.yaw] {
            out.extend(number.to_le_bytes());
        }
        out.extend(self.altitude.to_le_bytes());
        for number in self.velocity {
            out.extend(number.to_le_bytes());
        }
        // Numbers of the camera, which this has not.
        out.resize(start + DEMO_LENGTH, 0);
    }

    fn decode(option: &[u8]) -> Option<Demo> {
        let number = |at| {
            let number = f32::from_bits(word(option, at)?);
            number.is_finite().then_some(number)
        };
        let control = (word(option, 4)? >> 16) as u16;
        Some(Demo {
            control: CONTROL_STATES
                .iter()
                .find(|(number, _)| *number == control)
                .map_or(ControlState::Other(control), |(_, state)| *state),
            battery: word(option, 8)?,
            pitch: number(12)?,
            roll: number(16)?,
            yaw: number(20)?,
            altitude: word(option, 24)? as i32,
            velocity: [number(28)?, number(32)?, number(36)?],
        })
    }
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    let bytes = bytes.get(at..at + 4)?;
    Some(u32::from_le_bytes(bytes.try_into().ok()?))
}
