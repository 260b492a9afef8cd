//! Encoding into one buffer of bytes.

use alloc::vec::Vec;
use postcard::ser_flavors::Flavor;
use serde::{Serialize, Serializer};

/// Encodes a value.
pub fn encode(value: &impl Serialize) -> Vec<u8> {
    // Most entries take less.
    encode_to(value, Vec::with_capacity(128))
}

/// Encodes a value behind what there is.
pub fn encode_to(value: &impl Serialize, bytes: Vec<u8>) -> Vec<u8> {
    // postcard's only error here is a sequence of unknown length, which nothing of ours is.
    postcard::serialize_with_flavor(value, Buffer(bytes)).expect("all lengths are known")
}

/// Encodes bytes at one go; the encoding is that of a list of bytes.
pub fn as_bytes<S: Serializer>(bytes: impl AsRef<[u8]>, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_bytes(bytes.as_ref())
}

struct Buffer(Vec<u8>);

impl Flavor for Buffer {
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
