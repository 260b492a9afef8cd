//! Messages between robots.

use crate::{Port, RobotId};
use alloc::vec::Vec;
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

/// Bytes that most values take less than.
const USUAL: usize = 256;

/// Hands the encoding of a value to `use_it`. Most are made on the stack and not moved.
pub(crate) fn with_encoded<T: Serialize, R>(value: &T, use_it: impl FnOnce(&[u8]) -> R) -> R {
    let mut room = [0; USUAL];
    if let Ok(bytes) = postcard::to_slice(value, &mut room) {
        return use_it(bytes);
    }
    // The only error postcard reports for an unbounded buffer is a type without a known length,
    // which no message of ours has.
    let buffer = Buffer::default();
    let long =
        postcard::serialize_with_flavor(value, buffer).expect("a message has a known length");
    use_it(&long)
}

/// Decodes what [`encode`] made; none where the bytes are not a `T`, or are more than one.
pub fn decode<T: DeserializeOwned>(bytes: &[u8]) -> Option<T> {
    match postcard::take_from_bytes(bytes) {
        Ok((value, [])) => Some(value),
        _ => None,
    }
}

#[derive(Default)]
struct Buffer(Vec<u8>);

impl postcard::ser_flavors::Flavor for Buffer {
    type Output = Vec<u8>;

    fn try_extend(&mut self, data: &[u8]) -> postcard::Result<()> {
        self.0.extend_from_slice(data);
        Ok(())
    }

    fn try_push(&mut self, data: u8) -> postcard::Result<()> {
        self.0.push(data);
        Ok(())
    }

    fn finalize(self) -> postcard::Result<Vec<u8>> {
        Ok(self.0)
    }
}
