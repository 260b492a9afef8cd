//! The fields of the trace events of registers.

use super::OperationId;
use starl_core::event::storing::Operation;
use starl_core::random::hash_key;
use starl_core::{Digest, Payload};

/// The name of an operation.
pub(super) fn operation(id: OperationId, register: &str) -> Operation {
    Operation {
        operation: id.0,
        register: register.into(),
    }
}

/// The hash of a value in events.
pub(super) fn value_hash(value: &Payload) -> i64 {
    let mut digest = Digest::default();
    digest.bytes(value);
    hash_key(digest.value(), &[]) as i64
}
