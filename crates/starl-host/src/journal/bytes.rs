//! Encoding into buffers of bytes.

use alloc::vec::Vec;
use serde::{Serialize, Serializer};
use starl_core::message::with_encoded;

/// Encodes a value.
pub fn encode(value: &impl Serialize) -> Vec<u8> {
    with_encoded(value, <[u8]>::to_vec)
}

/// Encodes a value behind what there is.
pub fn append(value: &impl Serialize, bytes: &mut Vec<u8>) {
    with_encoded(value, |encoded| bytes.extend_from_slice(encoded));
}

/// Encodes bytes at one go; the encoding is that of a list of bytes.
pub fn as_bytes<S: Serializer>(bytes: impl AsRef<[u8]>, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_bytes(bytes.as_ref())
}
