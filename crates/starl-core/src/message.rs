//! Messages between robots.

use crate::{Port, RobotId};
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use smallvec::SmallVec;

/// A message's bytes. Short messages, the most common ones, are stored inline.
pub type Payload = SmallVec<[u8; 24]>;

/// A message between robots: bytes for one endpoint.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Message {
    /// The sender.
    pub from: RobotId,
    /// The endpoint, the same on the sending and on the receiving robot.
    pub port: Port,
    /// The content, in the sender's encoding.
    pub payload: Payload,
}

/// The receivers of a transmission.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Destination {
    /// Every robot that the network reaches, the sender left out.
    All,
    /// One robot.
    Robot(RobotId),
}

impl Message {
    /// The content as a `T`, or none where the bytes are not one.
    pub fn read<T: DeserializeOwned>(&self) -> Option<T> {
        decode(&self.payload)
    }
}

/// Encodes a value in postcard's format: compact, and the same on every target.
pub fn encode<T: Serialize>(value: &T) -> Payload {
    with_encoded(value, Payload::from_slice)
}

/// Hands the encoding of a value to `use_it`. Most are made on the stack and not moved.
pub fn with_encoded<T: Serialize, R>(value: &T, use_it: impl FnOnce(&[u8]) -> R) -> R {
    let mut room = Room::new();
    // The only error that postcard reports here is a type without a known length, which none of ours is.
    postcard::serialize_with_flavor(value, Append(&mut room)).expect("all lengths are known");
    use_it(&room)
}

/// Decodes what [`encode`] made; none where the bytes are not a `T`, or are more than one.
pub fn decode<T: DeserializeOwned>(bytes: &[u8]) -> Option<T> {
    match postcard::take_from_bytes(bytes) {
        Ok((value, [])) => Some(value),
        _ => None,
    }
}

/// Room for an encoding. Most values take less than it has on the stack.
type Room = SmallVec<[u8; 256]>;

/// Everything is encoded through this one type, so that there is only one encoder of each type of value.
struct Append<'a>(&'a mut Room);

impl postcard::ser_flavors::Flavor for Append<'_> {
    type Output = ();

    fn try_extend(&mut self, data: &[u8]) -> postcard::Result<()> {
        self.0.extend_from_slice(data);
        Ok(())
    }

    fn try_push(&mut self, data: u8) -> postcard::Result<()> {
        self.0.push(data);
        Ok(())
    }

    fn finalize(self) -> postcard::Result<()> {
        Ok(())
    }
}
