//! Reads what an operator's order carries: `fields` of an event of kind `tell`.

use super::names::Names;
use super::parameter::parameter;
use super::section::Section;
use super::tree::{Node, Value as Tree};
use crate::scenario::Parameter;
use starl_core::event::{Fields, Value};
use starl_core::{Point, Time};

/// The fields of the order, by name.
pub(super) fn fields(table: Section<'_>, names: &Names) -> Fields {
    let Some(node) = table.node("fields") else {
        return Fields::default();
    };
    let Tree::Table(entries) = &node.value else {
        let message = format!("{} is not a table", node.value.describe());
        table.problem("fields", message, "write { name = value, ... }");
        return Fields::default();
    };
    let field = |(name, entry): (&String, &super::tree::Entry)| {
        let path = format!("{}.{name}", table.path_of("fields"));
        let value = value(&entry.node, &path, table, names)?;
        Some((name.clone().into(), value))
    };
    entries.iter().filter_map(field).collect()
}

fn value(node: &Node, path: &str, table: Section<'_>, names: &Names) -> Option<Value> {
    let report = table.report;
    if let Tree::Table(entries) = &node.value {
        let mut entries = entries.iter();
        let value = match (entries.next(), entries.next()) {
            (Some((name, entry)), None) => match (name.as_str(), &entry.node.value) {
                ("text", Tree::Text(text)) => Some(Value::Text(text.clone().into())),
                ("robot", Tree::Text(_)) => {
                    return names.robot_of(&entry.node, path, report).map(Value::Robot);
                }
                ("robots", _) => {
                    let robots = names.of_node(&entry.node, path, report);
                    return Some(Value::Robots(robots));
                }
                _ => None,
            },
            _ => None,
        };
        if value.is_none() {
            let help = "write { robot = \"name\" }, { robots = [...] } or { text = \"...\" }";
            let message = "this table is not a value of an order";
            report.problem_with_help(node.origin, path, message, help);
        }
        return value;
    }
    Some(match parameter(node, path, report)? {
        Parameter::Bool(flag) => Value::Bool(flag),
        Parameter::Int(number) => Value::Int(number),
        Parameter::Float(number) => Value::Float(number),
        Parameter::Text(text) => Value::Text(text.into()),
        Parameter::Duration(span) => Value::Time(Time(span.0)),
        Parameter::List(list) => match point(&list) {
            Some(point) => Value::Point(point),
            None => {
                let help = "write a point, [x, y] or [x, y, z], in metres";
                let message = "this list is not a value of an order";
                report.problem_with_help(node.origin, path, message, help);
                return None;
            }
        },
    })
}

fn point(list: &[Parameter]) -> Option<Point> {
    let number = |value: &Parameter| match value {
        Parameter::Int(number) => Some(*number as f64),
        Parameter::Float(number) => Some(*number),
        _ => None,
    };
    match list {
        [x, y] => Some(Point::planar(number(x)?, number(y)?)),
        [x, y, z] => Some(Point::new(number(x)?, number(y)?, number(z)?)),
        _ => None,
    }
}
