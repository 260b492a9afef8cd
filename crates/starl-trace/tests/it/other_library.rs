//! A third-party library reads the file by its index and decodes its contents.

use crate::common;
use mcap::MessageStream;
use serde_json::Value;
use starl_core::{Event, Time};
use starl_trace::{Topic, ViewOptions};
use std::collections::BTreeMap;

#[test]
fn the_mcap_library_reads_every_message_with_its_schema() {
    let file = common::file(&ViewOptions::default());
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    let mut last = (0, None);
    for message in MessageStream::new(&file).unwrap() {
        let message = message.unwrap();
        let schema = message
            .channel
            .schema
            .as_ref()
            .expect("every channel has a schema");
        assert_eq!(
            (
                schema.encoding.as_str(),
                message.channel.message_encoding.as_str()
            ),
            ("jsonschema", "json")
        );
        let text: Value = serde_json::from_slice(&schema.data).unwrap();
        assert_eq!(text["title"], schema.name);
        assert!(
            serde_json::from_slice::<Value>(&message.data)
                .unwrap()
                .is_object()
        );
        // Sorted by time and number, messages are in the order of the file.
        assert!(
            (message.log_time, Some(message.sequence)) > last,
            "{}",
            message.channel.topic
        );
        last = (message.log_time, Some(message.sequence));
        *counts.entry(message.channel.topic.clone()).or_default() += 1;
    }
    for topic in Topic::ALL {
        let written = common::records()
            .iter()
            .filter(|r| Topic::of(&r.event) == topic)
            .count();
        let expected = if topic == Topic::Summary { 1 } else { written };
        assert_eq!(
            counts.get(topic.name()).copied().unwrap_or(0),
            expected,
            "{}",
            topic.name()
        );
    }
    for view in [
        "/world",
        "/bodies",
        "/frames",
        "/marks",
        "/log",
        "/robot/create0/pose",
    ] {
        assert!(
            counts.contains_key(view),
            "{view} is missing from {counts:?}"
        );
    }
}

#[test]
fn the_index_of_the_file_agrees_with_its_content() {
    let file = common::file(&ViewOptions::default());
    let summary = mcap::Summary::read(&file).unwrap().expect("an index");
    let statistics = summary.stats.expect("statistics");
    let messages = MessageStream::new(&file).unwrap().count() as u64;
    assert_eq!(statistics.message_count, messages);
    assert_eq!(statistics.message_end_time, u64::MAX);
    assert_eq!(
        (statistics.metadata_count, statistics.attachment_count),
        (1, 4)
    );
    let names: Vec<&str> = summary
        .attachment_indexes
        .iter()
        .map(|a| a.name.as_str())
        .collect();
    assert_eq!(
        names,
        [
            "starl/scenario.toml",
            "starl/files/world.wpt",
            "starl/setting.json",
            "starl/world.json"
        ]
    );
    let scenario = mcap::read::attachment(&file, &summary.attachment_indexes[0]).unwrap();
    assert_eq!(scenario.data, common::header().scenario.as_bytes());
}

#[test]
fn a_pose_has_its_numbers_in_full_and_its_view_as_a_quaternion() {
    let file = common::file(&ViewOptions::default());
    let mut poses = Vec::new();
    let mut views = 0;
    for message in MessageStream::new(&file).unwrap().map(Result::unwrap) {
        let content: Value = serde_json::from_slice(&message.data).unwrap();
        match message.channel.topic.as_str() {
            "/starl/pose" => poses.push((Time(message.log_time), content)),
            "/robot/create0/pose" => {
                views += 1;
                let part = |name: &str| content["pose"]["orientation"][name].as_f64().unwrap();
                let length: f64 = ["x", "y", "z", "w"]
                    .into_iter()
                    .map(|p| part(p) * part(p))
                    .sum();
                assert!((length - 1.0).abs() < 1e-5, "{content}");
                assert_eq!(content["frame_id"], "world");
            }
            _ => {}
        }
    }
    assert!(views > 0);
    let written: Vec<_> = common::records()
        .into_iter()
        .filter_map(|r| {
            if let Event::Moved(pose) = r.event {
                Some((r.at, pose))
            } else {
                None
            }
        })
        .collect();
    assert_eq!(poses.len(), written.len());
    for ((at, content), (expected_at, pose)) in poses.iter().zip(&written) {
        assert_eq!(at, expected_at);
        assert_eq!(
            content["x"].as_f64().unwrap().to_bits(),
            pose.position.x.to_bits()
        );
        assert_eq!(
            content["yaw"].as_f64().unwrap().to_bits(),
            pose.yaw.to_bits()
        );
    }
}
