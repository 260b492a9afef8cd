//! The trace events of shared memory.

use super::store::Element;
use alloc::borrow::ToOwned;
use starl_core::event::Name;
use starl_core::random::hash_key;
use starl_core::{Digest, Port, Robot, Value};

const KIND: &str = "shared_memory";

/// The memory begins, empty.
pub(super) fn start(robot: &mut Robot<'_>, port: Port) {
    robot.emit_primitive(KIND, port, "start", []);
}

/// An element was written or has changed.
pub(super) fn element(robot: &mut Robot<'_>, port: Port, name: &'static str, element: &Element) {
    let stamp = element.stamp;
    let variable = &element.address.variable;
    let fields = [
        (
            "variable",
            Value::Text(Name::Owned((**variable).to_owned())),
        ),
        ("single_writer", element.address.owner.is_some().into()),
        ("time", stamp.time.into()),
        ("count", stamp.count.into()),
        ("writer", stamp.writer.into()),
        ("incarnation", stamp.incarnation.into()),
        ("value", value_hash(&element.value).into()),
    ];
    robot.emit_primitive(KIND, port, name, fields);
}

/// A variable was given an initial value.
pub(super) fn initial(
    robot: &mut Robot<'_>,
    port: Port,
    variable: &str,
    single_writer: bool,
    value: &[u8],
) {
    let fields = [
        ("variable", Value::Text(Name::Owned(variable.to_owned()))),
        ("single_writer", single_writer.into()),
        ("value", value_hash(value).into()),
    ];
    robot.emit_primitive(KIND, port, "initialize", fields);
}

/// A variable is causal from now on.
pub(super) fn causal(robot: &mut Robot<'_>, port: Port, variable: &str) {
    let variable = Value::Text(Name::Owned(variable.to_owned()));
    robot.emit_primitive(KIND, port, "causal", [("variable", variable)]);
}

/// Stands for a value in events.
fn value_hash(value: &[u8]) -> i64 {
    let mut digest = Digest::default();
    digest.bytes(value);
    hash_key(digest.value(), &[]) as i64
}
