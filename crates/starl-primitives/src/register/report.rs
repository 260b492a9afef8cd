//! The trace events of registers.

use super::OperationId;
use alloc::borrow::ToOwned;
use starl_core::event::Name;
use starl_core::random::hash_key;
use starl_core::{Digest, Payload, Port, Robot, Value};

const KIND: &str = "register";

/// This robot answers others from now on.
pub(super) fn up(robot: &mut Robot<'_>, port: Port, life: u64) {
    let life = Value::Int(life.min(i64::MAX as u64) as i64);
    robot.emit_primitive(KIND, port, "up", [("life", life)]);
}

/// An operation begins or ends, with a value. What is read where nothing was written has none.
pub(super) fn operation(
    robot: &mut Robot<'_>,
    port: Port,
    event: &'static str,
    operation: OperationId,
    register: &str,
    value: Option<&Payload>,
) {
    let [number, name] = names(operation, register);
    match value {
        Some(value) => {
            let value = ("value", value_hash(value).into());
            robot.emit_primitive(KIND, port, event, [number, name, value]);
        }
        None => robot.emit_primitive(KIND, port, event, [number, name]),
    }
}

/// What was claimed is written: what was found, none where nothing was written, and what is to take its place.
pub(super) fn update(
    robot: &mut Robot<'_>,
    port: Port,
    operation: OperationId,
    register: &str,
    found: Option<&Payload>,
    value: &Payload,
) {
    let [number, name] = names(operation, register);
    let value = ("value", value_hash(value).into());
    match found {
        Some(found) => {
            let found = ("found", value_hash(found).into());
            robot.emit_primitive(KIND, port, "update", [number, name, found, value]);
        }
        None => robot.emit_primitive(KIND, port, "update", [number, name, value]),
    }
}

/// Which operation it is, and of which register.
fn names(operation: OperationId, register: &str) -> [(&'static str, Value); 2] {
    let name = Value::Text(Name::Owned(register.to_owned()));
    [("operation", operation.0.into()), ("register", name)]
}

/// Stands for a value in events.
fn value_hash(value: &[u8]) -> i64 {
    let mut digest = Digest::default();
    digest.bytes(value);
    hash_key(digest.value(), &[]) as i64
}
