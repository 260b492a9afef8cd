//! Turns a node of the tree into what its field holds, or says why it is not that.

use super::schema::{Dimension, LEAST_PERIOD, Range, model_names};
use super::suggest;
use super::tree::{Node, Value};
use super::unit::Quantity;
use starl_core::{Duration, Point};

/// A complaint about a value: the problem, and a suggested fix.
pub(crate) type Complaint = (String, Option<String>);

fn complain<T>(message: String, help: impl Into<String>) -> Result<T, Complaint> {
    Err((message, Some(help.into())))
}

fn not_a<T>(node: &Node, what: &str, help: impl Into<String>) -> Result<T, Complaint> {
    complain(format!("{} is not {what}", node.value.describe()), help)
}

/// A text with something in it.
pub(crate) fn text(node: &Node) -> Result<String, Complaint> {
    match &node.value {
        Value::Text(text) if text.trim().is_empty() => complain(
            "the text is empty".to_string(),
            "write something between the quotes",
        ),
        Value::Text(text) => Ok(text.clone()),
        Value::List(_) | Value::Table(_) => not_a(node, "a text", "write it in quotes"),
        Value::Other(..) => not_a(node, "a text", "write it in quotes"),
        other => {
            let plain = other.describe();
            complain(
                format!("{plain} is not a text"),
                format!("write it in quotes: \"{plain}\""),
            )
        }
    }
}

/// `true` or `false`.
pub(crate) fn flag(node: &Node) -> Result<bool, Complaint> {
    match &node.value {
        Value::Flag(flag) => Ok(*flag),
        _ => not_a(node, "true or false", "write true or false, without quotes"),
    }
}

/// One of a few words.
pub(crate) fn choice(node: &Node, words: &[&str]) -> Result<String, Complaint> {
    match &node.value {
        Value::Text(text) if words.contains(&text.as_str()) => Ok(text.clone()),
        Value::Text(text) => {
            // Kinds of events are too many for other lists, but nothing else says which there are.
            let all = || format!("choose one of: {}", words.join(", "));
            let help = suggest::help(text, words, "choose one of").or_else(|| Some(all()));
            Err((format!("{text:?} is not one of the choices"), help))
        }
        _ => not_a(
            node,
            "one of the choices",
            format!("choose one of: {}", words.join(", ")),
        ),
    }
}

/// The name of a robot model.
pub(crate) fn model(node: &Node) -> Result<String, Complaint> {
    let names: Vec<&str> = model_names().collect();
    match &node.value {
        Value::Text(text) if names.contains(&text.as_str()) => Ok(text.clone()),
        Value::Text(text) => {
            let help = suggest::help(text, &names, "there are");
            Err((format!("there is no robot model {text:?}"), help))
        }
        _ => not_a(
            node,
            "a robot model",
            format!("there are: {}", names.join(", ")),
        ),
    }
}

/// A whole number within bounds.
pub(crate) fn count(node: &Node, least: u64, most: u64) -> Result<u64, Complaint> {
    let number = match &node.value {
        Value::Integer(number) => *number,
        Value::Other("number", text) => {
            return complain(
                format!("{text} is too large"),
                format!("give at most {most}"),
            );
        }
        _ => {
            return not_a(
                node,
                "a whole number",
                "write one without quotes, unit or point",
            );
        }
    };
    match u64::try_from(number) {
        Ok(number) if number >= least && number <= most => Ok(number),
        Ok(number) if number > most => complain(
            format!("{number} is too large"),
            format!("give at most {most}"),
        ),
        _ => complain(
            format!("{number} is too small"),
            format!("give at least {least}"),
        ),
    }
}

/// A number from 0 to 1, also as a percentage.
pub(crate) fn probability(node: &Node) -> Result<f64, Complaint> {
    let help = "give a number from 0 to 1, or a percentage such as \"20%\"";
    match quantity(node, Dimension::Ratio, Range::Any) {
        Ok(number) if (0.0..=1.0).contains(&number) => Ok(number),
        _ => not_a(node, "a probability", help),
    }
}

/// A number of some dimension, in SI.
pub(crate) fn quantity(node: &Node, dimension: Dimension, range: Range) -> Result<f64, Complaint> {
    let (number, unit) = match &node.value {
        Value::Integer(number) => (*number as f64, ""),
        Value::Float(number) => (*number, ""),
        Value::Text(text) => match Quantity::split(text) {
            Some(quantity) => (quantity.number, quantity.unit),
            None => return not_a(node, dimension.name(), write_such(dimension)),
        },
        _ => return not_a(node, dimension.name(), write_such(dimension)),
    };
    if !number.is_finite() {
        return complain(
            format!("{} is not a finite number", node.value.describe()),
            write_such(dimension),
        );
    }
    let si = match unit {
        "" if dimension == Dimension::Ratio || number == 0.0 => number,
        "" => {
            let message = format!("{} has no unit", node.value.describe());
            return complain(message, write_such(dimension));
        }
        unit => match (Quantity { number, unit }).in_si() {
            Some((found, si)) if found == dimension => si,
            Some((found, _)) => {
                let described = node.value.describe();
                let message = format!("{described} is {}, not {}", found.name(), dimension.name());
                return complain(message, write_such(dimension));
            }
            None => {
                let message = format!("there is no unit {unit:?}, in {}", node.value.describe());
                return complain(message, format!("use {}", dimension.units()));
            }
        },
    };
    let described = node.value.describe();
    match range {
        Range::Positive if si <= 0.0 => complain(
            format!("{described} is not above zero"),
            "give a positive one",
        ),
        Range::Period if si < LEAST_PERIOD => {
            complain(format!("{described} is too short"), "give 100us or more")
        }
        Range::NotNegative if si < 0.0 => {
            complain(format!("{described} is negative"), "give zero or more")
        }
        _ if si.abs() > LARGEST => complain(
            format!("{described} is too large to compute with"),
            write_such(dimension),
        ),
        _ => Ok(si),
    }
}

/// Beyond this, squares and nanoseconds lose their meaning; no robot comes near.
const LARGEST: f64 = 1e10;

fn write_such(dimension: Dimension) -> String {
    format!("write {} such as {}", dimension.name(), dimension.example())
}

/// A list of coordinates, each a bare number in SI or a quantity.
fn coordinates(
    node: &Node,
    dimension: Dimension,
    what: &str,
    help: &str,
) -> Result<Vec<f64>, Complaint> {
    let Value::List(list) = &node.value else {
        return not_a(node, what, help);
    };
    let number = |node: &Node| match &node.value {
        // In lists, numbers without a unit are SI.
        Value::Integer(number) => ranged(*number as f64, node),
        Value::Float(number) => ranged(*number, node),
        _ => quantity(node, dimension, Range::Any),
    };
    list.iter().map(number).collect()
}

fn ranged(number: f64, node: &Node) -> Result<f64, Complaint> {
    if number.is_finite() && number.abs() <= LARGEST {
        return Ok(number);
    }
    let described = node.value.describe();
    let fault = if number.is_finite() {
        "too large to compute with"
    } else {
        "not a finite number"
    };
    Err((format!("{described} is {fault}"), None))
}

/// `[x, y]`, and `[x, y, z]` where allowed; the number of coordinates distinguishes them.
pub(crate) fn point(
    node: &Node,
    dimension: Dimension,
    spatial: bool,
) -> Result<(Point, usize), Complaint> {
    let (what, help) = match (dimension, spatial) {
        (Dimension::Speed, _) => (
            "a velocity",
            "write [x, y] or [x, y, z] in metres per second",
        ),
        (_, true) => ("a point", "write [x, y] or [x, y, z] in metres"),
        (_, false) => ("a point", "write [x, y] in metres"),
    };
    match coordinates(node, dimension, what, help)?.as_slice() {
        &[x, y] => Ok((Point::planar(x, y), 2)),
        &[x, y, z] if spatial => Ok((Point::new(x, y, z), 3)),
        others => complain(format!("a list of {} is not {what}", others.len()), help),
    }
}

/// `[low, high]`.
pub(crate) fn heights(node: &Node) -> Result<(f64, f64), Complaint> {
    let (what, help) = ("a pair of heights", "write [low, high] in metres");
    match coordinates(node, Dimension::Length, what, help)?.as_slice() {
        &[low, high] if low < high => Ok((low, high)),
        &[_, _] => complain(
            "the lower height is not below the upper".to_string(),
            "swap them",
        ),
        others => complain(format!("a list of {} is not {what}", others.len()), help),
    }
}

/// A duration of so many seconds.
pub(crate) fn duration(seconds: f64) -> Result<Duration, Complaint> {
    let duration = Duration::from_seconds_f64(seconds);
    match duration.is_zero() && seconds > 0.0 {
        true => complain(
            "this is less than half a nanosecond".to_string(),
            "give at least \"1ns\"",
        ),
        false => Ok(duration),
    }
}
