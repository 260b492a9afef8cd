//! The trace events of registers.

use super::OperationId;
use alloc::borrow::ToOwned;
use starl_core::event::Name;
use starl_core::random::hash_key;
use starl_core::{Digest, Port, Robot, Value};

const KIND: &str = "register";

/// This robot answers others from now on.
pub(super) fn up(robot: &mut Robot<'_>, port: Port, life: u64) {
    let life = Value::Int(life.min(i64::MAX as u64) as i64);
    robot.emit_primitive(KIND, port, "up", [("life", life)]);
}

/// An operation begins or ends. What is read where nothing was written has no value.
pub(super) fn operation(
    robot: &mut Robot<'_>,
    port: Port,
    event: &'static str,
    operation: OperationId,
    register: &str,
    value: Option<&[u8]>,
) {
    let number = ("operation", operation.0.into());
    let name = ("register", Value::Text(Name::Owned(register.to_owned())));
    match value {
        Some(value) => {
            let value = ("value", value_hash(value).into());
            robot.emit_primitive(KIND, port, event, [number, name, value]);
        }
        None => robot.emit_primitive(KIND, port, event, [number, name]),
    }
}

/// Stands for a value in events.
fn value_hash(value: &[u8]) -> i64 {
    let mut digest = Digest::default();
    digest.bytes(value);
    hash_key(digest.value(), &[]) as i64
}
