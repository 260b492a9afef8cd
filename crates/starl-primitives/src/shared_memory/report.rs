//! The fields of the trace events of shared memory.

use super::store::Element;
use starl_core::Digest;
use starl_core::event::storing::Written;
use starl_core::random::hash_key;

/// A write to an element.
pub(super) fn written(element: &Element) -> Written {
    let stamp = element.stamp;
    Written {
        variable: element.address.variable.clone(),
        single_writer: element.address.owner.is_some(),
        time: stamp.time,
        count: stamp.count,
        writer: stamp.writer,
        incarnation: stamp.incarnation,
        value: value_hash(&element.value),
    }
}

/// The hash of a value in events.
pub(super) fn value_hash(value: &[u8]) -> i64 {
    let mut digest = Digest::default();
    digest.bytes(value);
    hash_key(digest.value(), &[]) as i64
}
