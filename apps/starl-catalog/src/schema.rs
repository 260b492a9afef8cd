//! The fields of scenarios as a JSON Schema (draft 2020-12), for editors of TOML files and for forms.
//!
//! It is made from the tables by which scenarios are read ([`SCENARIO`]). It takes every scenario that the reader
//! takes; which fields go together, and what the files that a scenario names hold, is the reader's to say.
//!
//! Members beyond the standard, for forms: `x-kind` says what a field holds, as [`Kind`] names it; `x-quantity` what a
//! number measures, and `x-units` in which units it may be written, from small to great; `x-minimum`,
//! `x-exclusive-minimum` and `x-maximum` bound it, in the unit `x-unit` or else in SI; `x-default` says in words what
//! holds where a field is left out and `default` does not.

use serde::{Serialize, Serializer};
use serde_json::{Value, json};
use starl_motion::models;
use starl_sim::read::schema::{
    Default, Dimension, Field, Kind, LEAST_PERIOD, Range, SCENARIO, model_names,
};

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

/// A value of JSON whose members keep their order.
#[derive(Clone, Debug, PartialEq)]
pub enum Json {
    /// Where order does not matter.
    Value(Value),
    /// A list of such values.
    List(Vec<Json>),
    /// Members in order.
    Object(Object),
}

/// The members of an object, in order.
#[derive(Clone, Debug, std::default::Default, PartialEq)]
pub struct Object(Vec<(String, Json)>);

impl Object {
    fn put(&mut self, name: &str, value: impl Into<Json>) {
        self.0.push((name.to_string(), value.into()));
    }

    fn extend(&mut self, other: Object) {
        self.0.extend(other.0);
    }
}

impl From<Value> for Json {
    fn from(value: Value) -> Json {
        Json::Value(value)
    }
}

impl From<Object> for Json {
    fn from(object: Object) -> Json {
        Json::Object(object)
    }
}

impl Serialize for Json {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Json::Value(value) => value.serialize(serializer),
            Json::List(list) => serializer.collect_seq(list),
            Json::Object(Object(members)) => {
                serializer.collect_map(members.iter().map(|(name, value)| (name, value)))
            }
        }
    }
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

/// What a field holds.
fn kind(kind: &Kind) -> Object {
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
    members(value)
}

/// A number with a unit; a bare one only if it needs none.
fn quantity(dimension: Dimension, range: Range) -> Value {
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

/// What a form needs to know besides.
fn annotate(schema: &mut Object, kind: &Kind) {
    schema.put("x-kind", json!(word(kind)));
    match kind {
        Kind::Probability => measure(schema, "probability".to_string(), Dimension::Ratio),
        Kind::Quantity(dimension, range) => {
            measure(schema, name(*dimension), *dimension);
            match range {
                Range::Any => {}
                Range::NotNegative => schema.put("x-minimum", json!(0)),
                Range::Positive => schema.put("x-exclusive-minimum", json!(0)),
                Range::Period => schema.put("x-minimum", json!(LEAST_PERIOD)),
            }
        }
        _ => {}
    }
}

fn measure(schema: &mut Object, quantity: String, dimension: Dimension) {
    schema.put("x-quantity", json!(quantity));
    schema.put("x-units", json!(dimension.unit_names().collect::<Vec<_>>()));
}

/// What a quantity measures: `rate_of_turn`.
fn name(dimension: Dimension) -> String {
    let name = dimension.name();
    let name = name.split_once(' ').map_or(name, |(_, name)| name);
    name.replace(' ', "_")
}

fn word(kind: &Kind) -> &'static str {
    match kind {
        Kind::Text => "text",
        Kind::Texts => "texts",
        Kind::Flag => "flag",
        Kind::Choice(_) => "choice",
        Kind::Model => "model",
        Kind::Count(..) => "count",
        Kind::Probability => "probability",
        Kind::Quantity(..) => "quantity",
        Kind::Point => "point",
        Kind::PlanarPoint => "planar_point",
        Kind::Outline => "outline",
        Kind::Velocity => "velocity",
        Kind::Heights => "heights",
        Kind::Robots => "robots",
        Kind::RobotGroups => "robot_groups",
        Kind::Parameters => "parameters",
        Kind::ModelParameters => "model_parameters",
        Kind::Table(_) => "table",
        Kind::Tables(_) => "tables",
        Kind::Switch(_) => "switch",
    }
}

/// A default as the file would hold it; none if it is told in words.
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
        let mut parameter = members(quantity(dimension, Range::Any));
        parameter.put(
            "default",
            match unit {
                "" => json!(field.default),
                unit => json!(format!("{}{unit}", field.default)),
            },
        );
        parameter.put("x-kind", json!("quantity"));
        measure(&mut parameter, name(dimension), dimension);
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

/// The members of an object.
fn members(value: Value) -> Object {
    let Value::Object(members) = value else {
        return Object::default();
    };
    Object(
        members
            .into_iter()
            .map(|(name, value)| (name, value.into()))
            .collect(),
    )
}
