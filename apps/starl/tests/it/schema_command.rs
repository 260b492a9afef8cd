//! `starl schema` prints every field that the reader knows. `tools/check_schema.py` checks scenarios by it.

use crate::support::{folder, starl};
use serde_json::{Value, json};
use starl_sim::read::schema::{Default, Field, Kind, SCENARIO};

fn schema(test: &str) -> (String, Value) {
    let output = starl(&folder(test), &["schema"]);
    assert!(output.status.success() && output.stderr.is_empty());
    let text = String::from_utf8(output.stdout).expect("it is text");
    let schema = serde_json::from_str(&text).expect("it is JSON");
    (text, schema)
}

/// The table of a kind, which may stand beside a word or a flag, or be the element of a list.
fn table(schema: &Value) -> &Value {
    let alternatives = schema["anyOf"].as_array().map_or(&[][..], Vec::as_slice);
    let found = [schema].into_iter().chain(alternatives);
    let mut found = found.flat_map(|schema| [schema, &schema["items"]]);
    let found = found.find(|schema| schema["properties"].is_object());
    found.unwrap_or_else(|| panic!("{schema} is no table"))
}

/// Compares a table with the reader's; gives how many fields there are.
fn compare(schema: &Value, fields: &[Field], path: &str) -> usize {
    let table = table(schema);
    let properties = table["properties"].as_object().expect("properties");
    assert_eq!(properties.len(), fields.len(), "{path}");
    assert_eq!(table["additionalProperties"], false, "{path}");
    let mut count = fields.len();
    for field in fields {
        let path = format!("{path}.{}", field.name);
        let found = &properties[field.name];
        assert_eq!(found["description"], field.about, "{path}");
        match field.default {
            Default::Required => {
                let required = table["required"].as_array().expect("a list");
                assert!(required.contains(&json!(field.name)), "{path}");
            }
            Default::Value(text) | Default::Word(text) => {
                let default = match (&found["default"], &found["x-default"]) {
                    (Value::Null, words) => words.as_str().map(str::to_string),
                    (Value::String(text), _) => Some(text.clone()),
                    (value, _) => Some(value.to_string()),
                };
                let same =
                    |default: String| default == text || default.parse() == text.parse::<f64>();
                assert!(default.is_some_and(same), "{path}: {found}");
            }
            Default::Depends(_) | Default::Kept(_) => {
                assert_eq!(found["x-default"], field.default.describe(), "{path}");
            }
        }
        if let Kind::Quantity(dimension, _) = field.kind {
            let units: Vec<&str> = dimension.unit_names().collect();
            assert_eq!(found["x-units"], json!(units), "{path}");
        }
        if !field.kind.fields().is_empty() {
            count += compare(found, field.kind.fields(), &path);
        }
    }
    count
}

#[test]
fn the_schema_has_every_field() {
    let (_, schema) = schema("schema_fields");
    assert_eq!(
        schema["$schema"],
        "https://json-schema.org/draft/2020-12/schema"
    );
    let count = compare(&schema, SCENARIO, "");
    assert!(count > 150, "{count}");
}

#[test]
fn fields_are_in_the_order_of_the_reference() {
    let (text, _) = schema("schema_order");
    let mut from = 0;
    for field in SCENARIO {
        let name = format!("\n    {:?}: {{", field.name);
        let place = text[from..].find(&name);
        from += place.unwrap_or_else(|| panic!("{} is not in its place", field.name));
    }
}
