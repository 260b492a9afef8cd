//! The stream of a connection: a greeting each way, then messages, big-endian and padded to 8 bytes. Kinds of messages
//! and their senders have numbers, which messages of their own give names to.

use thiserror::Error;

/// The length of a greeting.
pub const GREETING: usize = 24;
/// Greetings of this version begin so; a newer minor version may differ.
const VERSION: &[u8] = b"vrpn: ver. 07.";
/// Bytes of a message before its body.
const HEADER: usize = 24;
/// No message that is of use here is longer.
const LONGEST: usize = 4096;

/// The kind of a message whose sender is a number and whose body is that sender's name.
pub const SENDER_NAME: i32 = -1;
/// The kind of a message whose sender is the number of a kind and whose body is its name.
pub const KIND_NAME: i32 = -2;
/// The name of the kind whose body is a [`Place`].
pub const PLACE: &str = "vrpn_Tracker Pos_Quat";
/// The name of the kind by which a client asks whether the server is there.
pub const PING: &str = "vrpn_Base ping_message";
/// The name of the kind that answers it.
pub const PONG: &str = "vrpn_Base pong_message";

/// A message.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Message {
    /// When it was sent, by the sender's clock: seconds and microseconds.
    pub time: (u32, u32),
    /// The number of the sender.
    pub sender: i32,
    /// The number of the kind.
    pub kind: i32,
    /// Its content.
    pub body: Vec<u8>,
}

/// The stream cannot be read further: it is not VRPN, or bytes are missing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("the other end does not send VRPN 7")]
pub struct Broken;

/// The greeting with which each end begins. It asks for no logging.
pub fn greeting() -> [u8; GREETING] {
    let mut bytes = [0; GREETING];
    let text = b"vrpn: ver. 07.35  0";
    bytes[..text.len()].copy_from_slice(text);
    bytes
}

impl Message {
    /// A message that gives a name to a number, as [`SENDER_NAME`] or [`KIND_NAME`].
    pub fn naming(what: i32, number: i32, name: &str) -> Message {
        let mut body = (name.len() as u32 + 1).to_be_bytes().to_vec();
        body.extend(name.as_bytes());
        body.push(0);
        Message {
            sender: number,
            kind: what,
            body,
            ..Message::default()
        }
    }

    /// The name that a naming message gives.
    pub fn name(&self) -> Option<String> {
        let text = self.body.get(4..)?;
        let text = text.split(|&byte| byte == 0).next()?;
        Some(String::from_utf8_lossy(text).into_owned())
    }

    /// Appends the message.
    pub fn encode(&self, out: &mut Vec<u8>) {
        out.extend(((HEADER + self.body.len()) as u32).to_be_bytes());
        out.extend(self.time.0.to_be_bytes());
        out.extend(self.time.1.to_be_bytes());
        out.extend(self.sender.to_be_bytes());
        out.extend(self.kind.to_be_bytes());
        // An unused number.
        out.extend([0; 4]);
        out.extend(&self.body);
        out.extend(std::iter::repeat_n(0, padding(self.body.len())));
    }
}

/// Bytes that fill up to a multiple of 8.
fn padding(length: usize) -> usize {
    length.next_multiple_of(8) - length
}

/// Where a tracked body is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Which part of the tracker; rigid bodies have part 0.
    pub sensor: i32,
    /// Metres.
    pub position: [f64; 3],
    /// Unit quaternion: x, y, z, w.
    pub rotation: [f64; 4],
}

impl Place {
    /// The body of a message.
    pub fn encode(&self) -> Vec<u8> {
        let mut body = self.sensor.to_be_bytes().to_vec();
        body.extend([0; 4]);
        for value in self.position.iter().chain(&self.rotation) {
            body.extend(value.to_be_bytes());
        }
        body
    }

    /// The content of a body; `None` if it is too short or a number is NaN.
    pub fn decode(body: &[u8]) -> Option<Place> {
        let number = |index: usize| {
            let bytes = body.get(8 + 8 * index..16 + 8 * index)?;
            let value = f64::from_be_bytes(bytes.try_into().ok()?);
            value.is_finite().then_some(value)
        };
        Some(Place {
            sensor: i32::from_be_bytes(body.get(..4)?.try_into().ok()?),
            position: [number(0)?, number(1)?, number(2)?],
            rotation: [number(3)?, number(4)?, number(5)?, number(6)?],
        })
    }
}

/// Reads the stream of one end: its greeting, then its messages.
#[derive(Clone, Debug, Default)]
pub struct Decoder {
    bytes: Vec<u8>,
    greeted: bool,
}

impl Decoder {
    /// Takes bytes that have arrived.
    pub fn push(&mut self, bytes: &[u8]) {
        self.bytes.extend(bytes);
    }

    /// The next message; `None` if more bytes must come first.
    ///
    /// # Errors
    /// If the stream cannot be read on.
    pub fn pop(&mut self) -> Result<Option<Message>, Broken> {
        if !self.greeted {
            let sure = self.bytes.len().min(VERSION.len());
            if self.bytes[..sure] != VERSION[..sure] {
                return Err(Broken);
            }
            if self.bytes.len() < GREETING {
                return Ok(None);
            }
            self.bytes.drain(..GREETING);
            self.greeted = true;
        }
        let word = |index: usize| {
            let bytes = self.bytes.get(4 * index..4 * index + 4)?;
            Some(u32::from_be_bytes(bytes.try_into().ok()?))
        };
        let Some(length) = word(0).map(|length| length as usize) else {
            return Ok(None);
        };
        if !(HEADER..=LONGEST).contains(&length) {
            return Err(Broken);
        }
        let padded = length + padding(length);
        if self.bytes.len() < padded {
            return Ok(None);
        }
        let number = |index| word(index).unwrap_or(0);
        let message = Message {
            time: (number(1), number(2)),
            sender: number(3) as i32,
            kind: number(4) as i32,
            body: self.bytes[HEADER..length].to_vec(),
        };
        self.bytes.drain(..padded);
        Ok(Some(message))
    }
}
