//! Writes `robots`.

use super::table::{Table, flag, list, number, quantity, spatial, text, time};
use crate::fields::FieldTable;
use crate::scenario::{Clock, Fleet, Group, Parameter};
use starl_core::{Duration, Pose, RobotId};
use starl_motion::Model;
use std::collections::BTreeMap;

/// The groups.
pub(super) fn write(fleet: &Fleet) -> String {
    fleet.groups.iter().map(group).collect()
}

/// Names of robots, in a list.
pub(super) fn names(fleet: &Fleet, robots: &[RobotId]) -> String {
    list(robots.iter().map(|&robot| text(&fleet.name(robot))))
}

fn group(group: &Group) -> String {
    let Group {
        name,
        numbered,
        first_number,
        model,
        program,
        parameters,
        starts,
        control_period,
        sensors,
        clock,
    } = group;
    let mut table = Table::element("robots");
    table.set("model", text(model.name()));
    table.differing("name", name.as_str(), model.name(), text);
    table.differing("numbered", *numbered, true, flag);
    table.differing("first_number", *first_number, 0, |first| first.to_string());
    table.set("program", text(program));
    let tables = [
        ("parameters", program_parameters(parameters)),
        ("model_parameters", model_parameters(&**model)),
        ("sensors", sensors.write_inline()),
        ("clock", self::clock(clock)),
    ];
    for (name, content) in tables {
        if let Some(content) = content {
            table.set(name, content);
        }
    }
    table.differing(
        "control_period",
        *control_period,
        Duration::from_millis(100),
        time,
    );
    let starts: String = starts
        .iter()
        .map(|pose| format!("    {},\n", start(pose)))
        .collect();
    table.set("start", format!("[\n{starts}]"));
    table.finish_element()
}

fn start(pose: &Pose) -> String {
    let position = spatial(pose.position);
    match pose.yaw == 0.0 {
        true => format!("{{ position = {position} }}"),
        false => {
            let heading = quantity(pose.yaw, "rad");
            format!("{{ position = {position}, heading = {heading} }}")
        }
    }
}

fn program_parameters(parameters: &BTreeMap<String, Parameter>) -> Option<String> {
    let mut table = Table::root();
    for (name, value) in parameters {
        table.set(name, parameter(value));
    }
    table.inline()
}

fn parameter(value: &Parameter) -> String {
    match value {
        Parameter::Bool(value) => flag(*value),
        Parameter::Int(value) => value.to_string(),
        Parameter::Float(value) => number(*value),
        Parameter::Text(value) => text(value),
        Parameter::Duration(value) => time(*value),
        Parameter::List(values) => list(values.iter().map(parameter)),
    }
}

fn model_parameters(model: &dyn Model) -> Option<String> {
    let mut table = Table::root();
    for (field, value) in model.parameters() {
        let unit = match field.unit {
            "degrees" => "deg",
            "degrees/s" => "deg/s",
            unit @ ("m" | "m/s" | "m/s2" | "kg" | "kg/s" | "s" | "rad" | "rad/s") => unit,
            _ => "",
        };
        let value = match unit {
            "" => number(value),
            unit => quantity(value, unit),
        };
        table.set(field.name, value);
    }
    table.inline()
}

fn clock(clock: &Clock) -> Option<String> {
    let Clock { offset, drift_ppm } = clock;
    let mut table = Table::root();
    table.differing("offset", *offset, Duration::ZERO, time);
    table.differing("drift", *drift_ppm, 0.0, |ppm| number(drift(ppm)));
    table.inline()
}

/// The drift that is read as so many parts per million: of the numbers nearest to a millionth of it the
/// one that gives it back.
fn drift(ppm: f64) -> f64 {
    let near = ppm * 1e-6;
    let neighbours = [near, near.next_up(), near.next_down()];
    let exact = neighbours.into_iter().find(|drift| drift * 1e6 == ppm);
    exact.unwrap_or(near)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_drift_that_can_be_read_can_be_written() {
        for read in (1..2000)
            .map(|ppm| f64::from(ppm) / 1e6)
            .chain([0.3, 0.123_456_7])
        {
            let ppm = read * 1e6;
            assert_eq!(drift(ppm) * 1e6, ppm);
        }
    }
}
