//! The kinds of fields, as schemas.

use super::{Json, Object, table};
use serde_json::{Value, json};
use starl_sim::read::schema::{Dimension, Kind, Range, model_names};

/// The schema of a kind of field.
pub(super) fn kind(kind: &Kind) -> Object {
    let value = match kind {
        Kind::Text => json!({"type": "string", "pattern": "\\S"}),
        Kind::Texts => json!({"type": "array", "items": {"type": "string", "pattern": "\\S"}}),
        Kind::Flag => json!({"type": "boolean"}),
        Kind::Choice(words) => json!({ "enum": words }),
        Kind::Model => json!({ "enum": model_names().collect::<Vec<_>>() }),
        Kind::Count(least, u64::MAX) => json!({"type": "integer", "minimum": least}),
        Kind::Count(least, most) => json!({"type": "integer", "minimum": least, "maximum": most}),
        Kind::Probability => json!({"anyOf": [
            {"type": "number", "minimum": 0, "maximum": 1},
            {"type": "string", "pattern": pattern(Dimension::Ratio, Range::NotNegative)},
        ]}),
        Kind::Quantity(dimension, range) => quantity(*dimension, *range),
        Kind::Point => coordinates(Dimension::Length, 2, 3),
        Kind::PlanarPoint | Kind::Heights => coordinates(Dimension::Length, 2, 2),
        Kind::Velocity => coordinates(Dimension::Speed, 2, 3),
        Kind::Outline => {
            json!({"type": "array", "items": coordinates(Dimension::Length, 2, 2), "minItems": 2})
        }
        Kind::Robots => robots(),
        Kind::RobotGroups => json!({"type": "array", "items": robots()}),
        Kind::Parameters => {
            json!({"type": "object", "additionalProperties": {"$ref": "#/$defs/parameter"}})
        }
        Kind::ModelParameters => json!({"type": "object"}),
        Kind::Table(fields) => return table(fields),
        Kind::Tables(fields) => {
            let mut list = Object::default();
            list.put("type", json!("array"));
            list.put("items", table(fields));
            return list;
        }
        Kind::Switch(fields) => {
            let mut either = Object::default();
            let flag = Json::Value(json!({"type": "boolean"}));
            either.put("anyOf", Json::List(vec![flag, table(fields).into()]));
            return either;
        }
    };
    Object::of(value)
}

/// A number with a unit; a bare one only if it needs none.
pub(super) fn quantity(dimension: Dimension, range: Range) -> Value {
    let text = json!({"type": "string", "pattern": pattern(dimension, range)});
    let bare = match (dimension, range) {
        (Dimension::Ratio, Range::Any) => json!({"type": "number"}),
        (Dimension::Ratio, Range::NotNegative) => json!({"type": "number", "minimum": 0}),
        (Dimension::Ratio, _) => json!({"type": "number", "exclusiveMinimum": 0}),
        (_, Range::Any | Range::NotNegative) => json!({"const": 0}),
        _ => return text,
    };
    json!({ "anyOf": [text, bare] })
}

/// Texts that are a number with a unit of this dimension.
fn pattern(dimension: Dimension, range: Range) -> String {
    let sign = match range {
        Range::Any => "[+-]?",
        _ => r"\+?",
    };
    let units: Vec<String> = dimension.spellings().map(escaped).collect();
    let units = units.join("|");
    let units = match (dimension, range) {
        (Dimension::Ratio, _) => format!("(?:{units})?"),
        _ => format!("(?:{units})"),
    };
    let number = r"(?:[0-9][0-9_]*(?:\.[0-9_]*)?|\.[0-9][0-9_]*)(?:[eE][+-]?[0-9][0-9_]*)?";
    let zero = match range {
        Range::Any | Range::NotNegative => "|0",
        _ => "",
    };
    format!(r"^\s*(?:{sign}{number}\s*{units}{zero})\s*$")
}

/// A text as a part of a regular expression.
fn escaped(text: &str) -> String {
    text.replace('^', r"\^").replace('/', "[/]")
}

/// A list of numbers in SI or with a unit.
fn coordinates(dimension: Dimension, least: usize, most: usize) -> Value {
    let text = json!({"type": "string", "pattern": pattern(dimension, Range::Any)});
    let coordinate = json!({"anyOf": [{"type": "number"}, text]});
    json!({"type": "array", "items": coordinate, "minItems": least, "maxItems": most})
}

fn robots() -> Value {
    json!({"anyOf": [{"const": "all"}, {"type": "array", "items": {"type": "string"}}]})
}
