//! JSON Schema texts for all topics.
//!
//! They use only the features that Foxglove's reader of JSON Schema supports: every object lists its properties, one
//! type each, no references, alternatives only as integer constants. An optional member is not in `required`; it is
//! never null.

mod foxglove;
mod starl;

pub(crate) use foxglove::{frame_transforms, log, pose_in_frame, scene_update};
pub(crate) use starl::{name, text};

/// A property: its name, its schema, and whether every message has it.
struct Member<'a>(&'a str, String, bool);

/// A property that every message has.
fn always<'a>(name: &'a str, schema: impl Into<String>) -> Member<'a> {
    Member(name, schema.into(), true)
}

/// A property that a message may leave out.
fn maybe<'a>(name: &'a str, schema: impl Into<String>) -> Member<'a> {
    Member(name, schema.into(), false)
}

/// The schema of an object, with the rest of its opening members, e.g. `"title":"x",`, before.
fn object(opening: &str, members: &[Member<'_>]) -> String {
    let properties: Vec<String> = members
        .iter()
        .map(|Member(name, schema, _)| format!("\"{name}\":{schema}"))
        .collect();
    let required: Vec<String> = (members.iter().filter(|member| member.2))
        .map(|Member(name, ..)| format!("\"{name}\""))
        .collect();
    format!(
        "{{{opening}\"type\":\"object\",\"properties\":{{{}}},\"required\":[{}]}}",
        properties.join(","),
        required.join(",")
    )
}

/// A titled schema that stands on its own.
fn root(title: &str, description: &str, members: &[Member<'_>]) -> String {
    let opening = format!(
        "\"$schema\":\"https://json-schema.org/draft/2020-12/schema\",\"title\":\"{title}\",\"description\":\"{description}\","
    );
    object(&opening, members)
}

fn array(items: String) -> String {
    format!("{{\"type\":\"array\",\"items\":{items}}}")
}

fn described(kind: &str, description: &str) -> String {
    format!("{{\"type\":\"{kind}\",\"description\":\"{description}\"}}")
}

fn number(description: &str) -> String {
    described("number", description)
}

fn string(description: &str) -> String {
    described("string", description)
}

fn boolean(description: &str) -> String {
    described("boolean", description)
}

/// A whole number that is not negative.
fn count(description: &str) -> String {
    format!("{{\"type\":\"integer\",\"minimum\":0,\"description\":\"{description}\"}}")
}

/// One of a few words.
fn word(description: &str, words: &[&str]) -> String {
    let words: Vec<String> = words.iter().map(|word| format!("\"{word}\"")).collect();
    format!(
        "{{\"type\":\"string\",\"enum\":[{}],\"description\":\"{description}\"}}",
        words.join(",")
    )
}

fn point() -> String {
    object(
        "",
        &[
            always("x", number("metres")),
            always("y", number("metres")),
            always("z", number("metres")),
        ],
    )
}
