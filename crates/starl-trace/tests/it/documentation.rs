//! The reference page names every topic, schema and member that a trace has.

use crate::common;
use mcap::MessageStream;
use serde_json::Value;
use starl_trace::{Topic, ViewOptions};
use std::collections::BTreeSet;

const PAGE: &str = include_str!("../../../../docs/reference/trace.md");

fn assert_named(word: &str) {
    assert!(
        PAGE.contains(&format!("`{word}`")),
        "docs/reference/trace.md does not name `{word}`"
    );
}

#[test]
fn the_reference_names_every_topic_and_every_member_of_its_schema() {
    let file = common::file(&ViewOptions::default());
    let summary = mcap::Summary::read(&file).unwrap().unwrap();
    let mut checked = 0;
    for channel in summary.channels.values() {
        let schema = channel.schema.as_ref().unwrap();
        assert_named(&schema.name);
        if channel.topic.starts_with("/starl/") {
            assert_named(&channel.topic);
            let text: Value = serde_json::from_slice(&schema.data).unwrap();
            checked += assert_members_named(&text);
        } else if !channel.topic.starts_with("/robot/") {
            assert_named(&channel.topic);
        }
    }
    assert!(checked > 60, "only {checked} members");
    for view in ["pose", "estimate", "path"] {
        assert_named(&format!("/robot/NAME/{view}"));
    }
}

/// Goes through the members of a schema and of everything that is in it; gives their number.
fn assert_members_named(schema: &Value) -> usize {
    let mut count = 0;
    if let Some(members) = schema["properties"].as_object() {
        for (name, member) in members {
            assert_named(name);
            count += 1 + assert_members_named(member) + assert_members_named(&member["items"]);
        }
    }
    for word in schema["enum"].as_array().into_iter().flatten() {
        assert_named(word.as_str().unwrap());
    }
    count
}

#[test]
fn every_topic_is_of_some_event() {
    let file = common::file(&ViewOptions::none());
    let seen: BTreeSet<String> = MessageStream::new(&file)
        .unwrap()
        .map(|message| message.unwrap().channel.topic.clone())
        .collect();
    let all: BTreeSet<String> = Topic::ALL
        .iter()
        .map(|topic| topic.name().to_string())
        .collect();
    assert_eq!(seen, all);
}
