//! The fields of scenarios as a JSON Schema (draft 2020-12), for editors of TOML files and for forms.
//!
//! It is made from the tables by which scenarios are read ([`SCENARIO`]). It takes every scenario that the reader
//! takes; which fields go together, and what the files that a scenario names hold, is the reader's to say.
//!
//! Members beyond the standard, for forms: `x-kind` says what a field holds, as [`Kind`] names it; `x-quantity` what a
//! number measures, and `x-units` in which units it may be written, from small to great; `x-minimum`,
//! `x-exclusive-minimum` and `x-maximum` bound it, in the unit `x-unit` or else in SI; `x-default` says in words what
//! holds where a field is left out and `default` does not.

mod json;
mod kind;
mod measure;

pub use json::{Json, Object};

use kind::{kind, quantity};
use measure::{annotate, measure, quantity_name};
use serde_json::{Value, json};
use starl_motion::models;
use starl_sim::read::schema::{Default, Dimension, Field, Kind, Range, SCENARIO};

/// The schema of scenario files. Properties are in the order in which the reference lists the fields.
pub fn schema() -> Json {
    let mut schema = Object::default();
    schema.put(
        "$schema",
        json!("https://json-schema.org/draft/2020-12/schema"),
    );
    schema.put("title", json!("StarL scenario"));
    schema.extend(table(SCENARIO));
    let parameter = json!({
        "anyOf": [
            {"type": ["boolean", "number", "string"]},
            {"type": "array", "items": {"$ref": "#/$defs/parameter"}},
        ],
    });
    schema.put("$defs", json!({ "parameter": parameter }));
    Json::Object(schema)
}

/// A table with these fields and no others.
fn table(fields: &[Field]) -> Object {
    let mut properties = Object::default();
    for field in fields {
        properties.put(field.name, self::field(field));
    }
    let is_required = |field: &&Field| field.default == Default::Required;
    let required: Vec<&str> = fields
        .iter()
        .filter(is_required)
        .map(|field| field.name)
        .collect();
    let mut table = Object::default();
    table.put("type", json!("object"));
    table.put("properties", properties);
    if !required.is_empty() {
        table.put("required", json!(required));
    }
    table.put("additionalProperties", json!(false));
    let holds = |wanted: fn(&Kind) -> bool| fields.iter().find(|field| wanted(&field.kind));
    let model = holds(|kind| matches!(kind, Kind::Model));
    let parameters = holds(|kind| matches!(kind, Kind::ModelParameters));
    if let (Some(model), Some(parameters)) = (model, parameters) {
        let of_models = models::KINDS.iter();
        let of_models = of_models.map(|kind| of_model(model.name, parameters.name, kind));
        table.put("allOf", Json::List(of_models.collect()));
    }
    table
}

/// A field with what is said of it.
fn field(field: &Field) -> Object {
    let mut schema = Object::default();
    schema.put("description", json!(field.about));
    let kind = kind(&field.kind);
    // Some fields have a word that says that there is nothing.
    match field.default {
        Default::Word(word) | Default::Kept(Some(word)) => {
            let word = Json::Value(json!({ "const": word }));
            schema.put("anyOf", Json::List(vec![word, kind.into()]));
        }
        _ => schema.extend(kind),
    }
    match field.default {
        Default::Value(text) => match default(&field.kind, text) {
            Some(value) => schema.put("default", value),
            None => schema.put("x-default", json!(text)),
        },
        Default::Word(word) => schema.put("default", json!(word)),
        Default::Depends(_) | Default::Kept(_) => {
            schema.put("x-default", json!(field.default.describe()));
        }
        Default::Required => {}
    }
    annotate(&mut schema, &field.kind);
    schema
}

/// A default as the file would hold it; none if it is described in words.
fn default(kind: &Kind, text: &str) -> Option<Value> {
    match kind {
        Kind::Text | Kind::Choice(_) | Kind::Model => Some(json!(text)),
        Kind::Table(_) | Kind::Tables(_) => None,
        // A number is one, and what has a unit is a text.
        Kind::Quantity(..) | Kind::Probability => {
            Some(serde_json::from_str(text).unwrap_or_else(|_| json!(text)))
        }
        _ => serde_json::from_str(text).ok(),
    }
}

/// The parameters that robots of one model have.
fn of_model(model: &str, parameters: &str, kind: &models::Kind) -> Json {
    let mut properties = Object::default();
    for field in kind.fields {
        let (dimension, unit) = Dimension::of_model_unit(field.unit);
        let mut parameter = Object::of(quantity(dimension, Range::Any));
        parameter.put(
            "default",
            match unit {
                "" => json!(field.default),
                unit => json!(format!("{}{unit}", field.default)),
            },
        );
        parameter.put("x-kind", json!("quantity"));
        measure(&mut parameter, quantity_name(dimension), dimension);
        parameter.put("x-unit", json!(unit));
        parameter.put("x-minimum", json!(field.low));
        parameter.put("x-maximum", json!(field.high));
        properties.put(field.name, parameter);
    }
    let mut table = Object::default();
    table.put("properties", properties);
    table.put("additionalProperties", json!(false));
    let mut found = Object::default();
    found.put(
        "if",
        json!({"properties": {model: {"const": kind.name}}, "required": [model]}),
    );
    let mut then = Object::default();
    let mut named = Object::default();
    named.put(parameters, table);
    then.put("properties", named);
    found.put("then", then);
    found.into()
}
