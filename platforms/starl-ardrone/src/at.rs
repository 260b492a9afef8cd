//! AT commands: lines of text, `AT*NAME=SEQUENCE,ARGUMENTS` and a carriage return, several to a datagram. Floating-point
//! arguments are written as the signed integer of the same bits.

use std::fmt::Write;

/// A command without its sequence number.
#[derive(Clone, Debug, PartialEq)]
pub enum AtCommand {
    /// `REF`: whether the drone is to be in the air.
    Reference {
        /// Take off and stay in the air; otherwise land.
        fly: bool,
        /// A change from off to on cuts the motors, or makes a drone whose motors are cut ready again.
        emergency: bool,
    },
    /// `PCMD`: how to fly; hover if it is `None`.
    Fly(Option<Tilt>),
    /// `FTRIM`: the drone stands on level ground.
    FlatTrim,
    /// `COMWDG`: the client is alive.
    Watchdog,
    /// `CONFIG`: sets an entry of the configuration, which the drone acknowledges in its navdata.
    Configure {
        /// The entry, e.g. `general:navdata_demo`.
        key: String,
        /// Its value.
        value: String,
    },
    /// `CTRL` 5: takes the acknowledgement back, which must be done before the next [`AtCommand::Configure`].
    AcknowledgementSeen,
}

/// How to fly: parts of the greatest values in the drone's configuration, -1 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tilt {
    /// Right side down.
    pub roll: f32,
    /// Nose up.
    pub pitch: f32,
    /// Climb.
    pub climb: f32,
    /// Turn to the right.
    pub yaw: f32,
}

/// Bits that are always set in `REF`.
const REFERENCE: u32 = 1 << 18 | 1 << 20 | 1 << 22 | 1 << 24 | 1 << 28;
const FLY: u32 = 1 << 9;
const EMERGENCY: u32 = 1 << 8;

impl AtCommand {
    /// Appends the command's line.
    pub fn encode(&self, sequence: u32, out: &mut String) {
        let bits = |value: f32| value.to_bits() as i32;
        // Writing to a string does not fail.
        let _ = match self {
            AtCommand::Reference { fly, emergency } => {
                let fly = if *fly { FLY } else { 0 };
                let emergency = if *emergency { EMERGENCY } else { 0 };
                write!(out, "AT*REF={sequence},{}", REFERENCE | fly | emergency)
            }
            AtCommand::Fly(None) => write!(out, "AT*PCMD={sequence},0,0,0,0,0"),
            AtCommand::Fly(Some(tilt)) => {
                let Tilt {
                    roll,
                    pitch,
                    climb,
                    yaw,
                } = *tilt;
                let [roll, pitch, climb, yaw] = [roll, pitch, climb, yaw].map(bits);
                write!(out, "AT*PCMD={sequence},1,{roll},{pitch},{climb},{yaw}")
            }
            AtCommand::FlatTrim => write!(out, "AT*FTRIM={sequence}"),
            AtCommand::Watchdog => write!(out, "AT*COMWDG={sequence}"),
            AtCommand::Configure { key, value } => {
                write!(out, "AT*CONFIG={sequence},\"{key}\",\"{value}\"")
            }
            AtCommand::AcknowledgementSeen => write!(out, "AT*CTRL={sequence},5,0"),
        };
        out.push('\r');
    }

    /// The command of a name with these arguments; `None` if the drone does not know it or they do not fit.
    fn decode(name: &str, mut arguments: std::str::Split<'_, char>) -> Option<AtCommand> {
        Some(match name {
            "REF" => {
                let bits: u32 = arguments.next()?.parse().ok()?;
                AtCommand::Reference {
                    fly: bits & FLY != 0,
                    emergency: bits & EMERGENCY != 0,
                }
            }
            "PCMD" => {
                let flags: u32 = arguments.next()?.parse().ok()?;
                let mut number = || {
                    let bits: i32 = arguments.next()?.parse().ok()?;
                    let value = f32::from_bits(bits as u32);
                    value.is_finite().then_some(value.clamp(-1.0, 1.0))
                };
                let tilt = Tilt {
                    roll: number()?,
                    pitch: number()?,
                    climb: number()?,
                    yaw: number()?,
                };
                AtCommand::Fly((flags & 1 != 0).then_some(tilt))
            }
            "FTRIM" => AtCommand::FlatTrim,
            "COMWDG" => AtCommand::Watchdog,
            "CONFIG" => {
                let mut text = || arguments.next()?.strip_prefix('"')?.strip_suffix('"');
                AtCommand::Configure {
                    key: text()?.to_string(),
                    // A value may be a list with commas; only numbers and words are understood here.
                    value: text()?.to_string(),
                }
            }
            "CTRL" => match arguments.next()? {
                "5" => AtCommand::AcknowledgementSeen,
                _ => return None,
            },
            _ => return None,
        })
    }
}

/// The commands of a datagram with their sequence numbers. Other lines are skipped.
pub fn decode(datagram: &[u8]) -> Vec<(u32, AtCommand)> {
    let Ok(text) = str::from_utf8(datagram) else {
        return Vec::new();
    };
    let command = |line: &str| {
        let (name, arguments) = line.strip_prefix("AT*")?.split_once('=')?;
        let mut arguments = arguments.split(',');
        let sequence = arguments.next()?.parse().ok()?;
        Some((sequence, AtCommand::decode(name, arguments)?))
    };
    // A line without its end was cut off.
    text.split_inclusive('\r')
        .filter_map(|line| command(line.strip_suffix('\r')?))
        .collect()
}
