//! Messages between robots.

use crate::{Port, RobotId};
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use smallvec::SmallVec;

/// A message's bytes. Short ones, which are most, are held in place.
pub type Payload = SmallVec<[u8; 24]>;

/// What travels between robots: bytes for one endpoint.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Message {
    /// The sender.
    pub from: RobotId,
    /// The endpoint, the same on the sending and on the receiving robot.
    pub port: Port,
    /// The content, in the sender's encoding.
    pub payload: Payload,
}

impl Message {
    /// The content as a `T`, or none where the bytes are not one.
    pub fn read<T: DeserializeOwned>(&self) -> Option<T> {
        decode(&self.payload)
    }
}

/// Encodes a value in postcard's format: compact, and the same on every target.
pub fn encode<T: Serialize>(value: &T) -> Payload {
    encode_within(value)
}

/// The same with room for so many bytes in place.
pub(crate) fn encode_within<const N: usize, T: Serialize>(value: &T) -> SmallVec<[u8; N]> {
    // The only error postcard reports for an unbounded buffer is a type without a known length,
    // which no message of ours has.
    postcard::serialize_with_flavor(value, Buffer::<N>::default())
        .expect("a message has a known length")
}

/// Decodes what [`encode`] made; none where the bytes are not a `T`, or are more than one.
pub fn decode<T: DeserializeOwned>(bytes: &[u8]) -> Option<T> {
    match postcard::take_from_bytes(bytes) {
        Ok((value, [])) => Some(value),
        _ => None,
    }
}

#[derive(Default)]
struct Buffer<const N: usize>(SmallVec<[u8; N]>);

impl<const N: usize> postcard::ser_flavors::Flavor for Buffer<N> {
    type Output = SmallVec<[u8; N]>;

    fn try_extend(&mut self, data: &[u8]) -> postcard::Result<()> {
        self.0.extend_from_slice(data);
        Ok(())
    }

    fn try_push(&mut self, data: u8) -> postcard::Result<()> {
        self.0.push(data);
        Ok(())
    }

    fn finalize(self) -> postcard::Result<SmallVec<[u8; N]>> {
        Ok(self.0)
    }
}
