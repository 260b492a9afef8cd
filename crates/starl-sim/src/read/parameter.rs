//! Reads the tables with fields that programs and models define: their parameters.

use super::schema::{Dimension, Range};
use super::section::Section;
use super::tree::{Node, Value};
use super::value::{self, Complaint};
use super::{Report, suggest};
use crate::fields::Quantity;
use crate::scenario::Parameter;
use starl_core::{Duration, math};
use starl_motion::Model;
use starl_motion::models;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The parameters of a program, added to those there are and before them.
pub(super) fn add_parameters(table: Section<'_>, parameters: &mut BTreeMap<String, Parameter>) {
    let Some(node) = table.node("parameters") else {
        return;
    };
    let Value::Table(entries) = &node.value else {
        let message = format!("{} is not a table", node.value.describe());
        table.problem("parameters", message, "write [parameters] or { ... }");
        return;
    };
    for (name, entry) in entries {
        let path = format!("{}.{name}", table.path_of("parameters"));
        if let Some(parameter) = parameter(&entry.node, &path, table.report) {
            parameters.insert(name.clone(), parameter);
        }
    }
}

/// A value as a program takes it.
pub(super) fn parameter(node: &Node, path: &str, report: &Report) -> Option<Parameter> {
    let parameter = match &node.value {
        Value::Flag(flag) => Parameter::Bool(*flag),
        Value::Integer(number) => Parameter::Int(*number),
        Value::Float(number) if number.is_finite() => Parameter::Float(*number),
        Value::Text(text) => quantity(text).unwrap_or_else(|| Parameter::Text(text.clone())),
        Value::List(list) => {
            let element = |(index, node)| parameter(node, &format!("{path}.{index}"), report);
            Parameter::List(list.iter().enumerate().filter_map(element).collect())
        }
        other => {
            let message = format!("{} is not a parameter of a program", other.describe());
            let help = "give a finite number, a quantity, a text, true, false, or a list of these";
            report.problem_with_help(node.origin, path, message, help);
            return None;
        }
    };
    Some(parameter)
}

/// A text that is a number with a unit we know.
pub(crate) fn quantity(text: &str) -> Option<Parameter> {
    let (dimension, number) = Quantity::split(text)?.in_si()?;
    if !number.is_finite() {
        return None;
    }
    match dimension {
        Dimension::Time if number >= 0.0 => {
            Some(Parameter::Duration(Duration::from_seconds_f64(number)))
        }
        _ => Some(Parameter::Float(number)),
    }
}

/// The model of this name with the changes of `model_parameters`; the plain model if they do not do.
pub(super) fn model(table: Section<'_>, name: &str) -> Option<Arc<dyn Model>> {
    let kind = models::KINDS.iter().find(|kind| kind.name == name)?;
    let mut settings = Vec::new();
    if let Some(node) = table.node("model_parameters") {
        let Value::Table(entries) = &node.value else {
            let message = format!("{} is not a table", node.value.describe());
            table.problem(
                "model_parameters",
                message,
                "write { radius = \"0.2m\" } or the like",
            );
            return models::by_name(name);
        };
        for (parameter, entry) in entries {
            let path = format!("{}.{parameter}", table.path_of("model_parameters"));
            let Some(field) = kind.fields.iter().find(|field| field.name == parameter) else {
                let names: Vec<&str> = kind.fields.iter().map(|field| field.name).collect();
                let message = format!("model `{name}` has no parameter `{parameter}`");
                let help = suggest::help(parameter, &names, "it has").unwrap_or_default();
                table
                    .report
                    .problem_with_help(entry.name_origin, &path, message, help);
                continue;
            };
            let setting = in_unit(&entry.node, field.unit).and_then(|number| {
                match models::with_parameters(name, &[(parameter.clone(), number)]) {
                    Err(starl_motion::ParameterError::OutOfRange { field, value }) => {
                        let (low, high, unit) = (field.low, field.high, field.unit);
                        let message = format!("{value} {unit} is out of range");
                        Err((message, Some(format!("give {low} to {high} {unit}"))))
                    }
                    // How parameters go together is judged when all are known.
                    _ => Ok(number),
                }
            });
            match setting {
                Ok(number) => settings.push((parameter.clone(), number)),
                Err(complaint) => table.report.complain(entry.node.origin, &path, complaint),
            }
        }
    }
    match models::with_parameters(name, &settings) {
        Ok(model) => Some(model),
        Err(error) => {
            table.problem("model_parameters", error, "change one of them");
            models::by_name(name)
        }
    }
}

/// A quantity in the unit that a model wants it in; one that is written in that unit is taken as it
/// is, so that no bit is lost between degrees and radians.
fn in_unit(node: &Node, unit: &'static str) -> Result<f64, Complaint> {
    let (dimension, unit) = Dimension::of_model_unit(unit);
    let in_si = value::quantity(node, dimension, Range::Any)?;
    let as_written = match &node.value {
        Value::Text(text) => Quantity::split(text).filter(|quantity| quantity.unit == unit),
        _ => None,
    };
    Ok(match (as_written, unit) {
        (Some(quantity), _) => quantity.number,
        (None, "deg" | "deg/s") => math::degrees(in_si),
        (None, _) => in_si,
    })
}
