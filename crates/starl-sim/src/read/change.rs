//! Changes to a scenario's tree before it is read: `--set` and `--faults`.

use super::report::{Origin, Report};
use super::schema::{Field, SCENARIO};
use super::suggest;
use super::tree::{Entry, Node, Table, Value, parse_value};

/// Sets the value of an override at its dotted path, and creates missing tables and lists on the path.
pub(super) fn set(root: &mut Node, path: &str, value: &str, origin: Origin, report: &Report) {
    let names: Vec<&str> = path.split('.').map(str::trim).collect();
    if names.iter().any(|name| name.is_empty()) {
        let message = "this is not the path of a field";
        report.problem_with_help(origin, path, message, "write it like `network.loss`");
        return;
    }
    if names.len() > DEEPEST {
        report.problem(origin, path, "there is no such field: the path is too long");
        return;
    }
    if let Some(node) = descend(root, &names, path, origin, report) {
        *node = parse_value(value, origin);
    }
}

/// No field lies deeper than this.
const DEEPEST: usize = 16;

fn descend<'a>(
    mut node: &'a mut Node,
    names: &[&str],
    path: &str,
    origin: Origin,
    report: &Report,
) -> Option<&'a mut Node> {
    for (depth, name) in names.iter().enumerate() {
        let so_far = names[..depth].join(".");
        // `true` for a table that can be switched on.
        if let Value::Flag(_) = node.value {
            *node = Node::empty(origin);
        }
        node = match &mut node.value {
            Value::Table(table) => {
                // A parameter may be a map, whose keys may be numbers.
                let is_list = names.get(depth + 1) == Some(&"0") && !names.contains(&"parameters");
                let empty = || Entry {
                    name_origin: origin,
                    node: match is_list {
                        true => Node {
                            value: Value::List(vec![Node::empty(origin)]),
                            origin,
                        },
                        false => Node::empty(origin),
                    },
                };
                &mut table.entry((*name).to_string()).or_insert_with(empty).node
            }
            Value::List(list) => {
                let count = list.len();
                let element = name
                    .parse::<usize>()
                    .ok()
                    .and_then(|index| list.get_mut(index));
                if element.is_none() {
                    let message = format!("{so_far} has no element {name}");
                    let help = format!("it has {count}, counted from 0");
                    report.problem_with_help(origin, path, message, help);
                }
                element?
            }
            other => {
                let message = format!("{so_far} is {}, it has no fields", other.describe());
                report.problem(origin, path, message);
                return None;
            }
        };
    }
    Some(node)
}

/// Puts the `fault`, `event` and `fault_rates` of another file into the scenario: faults and events are
/// added to those there are, rates replace those of the same name.
pub(super) fn add_faults(root: &mut Node, faults: Node, report: &Report) {
    let (Value::Table(table), Value::Table(more)) = (&mut root.value, faults.value) else {
        return;
    };
    for (name, entry) in more {
        match name.as_str() {
            "fault" | "event" => add_schedule(table, &name, entry),
            "fault_rates" => add_rates(table, entry),
            _ => {
                let known = |field: &&Field| field.name == name;
                let help = match SCENARIO.iter().find(known) {
                    Some(_) => {
                        "a fault file holds only [[fault]], [[event]] and [fault_rates]".to_string()
                    }
                    None => suggest::help(&name, &["fault", "event", "fault_rates"], "there are")
                        .unwrap_or_default(),
                };
                let message = "there is no such field in a fault file";
                report.problem_with_help(entry.name_origin, &name, message, help);
            }
        }
    }
}

fn add_schedule(table: &mut Table, name: &str, entry: Entry) {
    let Some(there) = table.get_mut(name).map(|entry| &mut entry.node.value) else {
        table.insert(name.to_string(), entry);
        return;
    };
    match (there, entry.node.value) {
        (Value::List(list), Value::List(more)) => list.extend(more),
        // A value that is not a list stays, and is reported when it is read.
        (there @ Value::List(_), other) => *there = other,
        _ => {}
    }
}

fn add_rates(table: &mut Table, entry: Entry) {
    let Some(there) = table
        .get_mut("fault_rates")
        .map(|entry| &mut entry.node.value)
    else {
        table.insert("fault_rates".to_string(), entry);
        return;
    };
    match (there, entry.node.value) {
        (Value::Table(rates), Value::Table(more)) => rates.extend(more),
        (there @ Value::Table(_), other) => *there = other,
        _ => {}
    }
}
