//! `--json` prints one object with the keys that `docs/reference/command.md` describes.

use crate::support::*;
use serde_json::Value;
use std::collections::BTreeSet;

const REFERENCE: &str = include_str!("../../../../docs/reference/command.md");

fn report(name: &str, arguments: &[&str]) -> Value {
    let folder = folder(name);
    file(&folder, "small.toml", SMALL);
    let mut all = vec!["run", "small.toml", "--json"];
    all.extend_from_slice(arguments);
    json(&starl(&folder, &all))
}

/// The dotted names of all members; elements of lists count as their list's.
fn paths(value: &Value, at: &str, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(members) => {
            for (name, member) in members {
                let path = if at.is_empty() {
                    name.clone()
                } else {
                    format!("{at}.{name}")
                };
                paths(member, &path, found);
                found.insert(path);
            }
        }
        Value::Array(elements) => elements
            .iter()
            .for_each(|element| paths(element, at, found)),
        _ => {}
    }
}

#[test]
fn it_has_the_result_of_the_run() {
    let report = report("json_report", &["--seed", "5"]);
    assert_eq!(report["outcome"], "reached");
    assert_eq!(report["seed"], 5);
    assert_eq!(report["target"], "small.toml");
    assert_eq!(report["digest"].as_str().map(str::len), Some(16));
    assert!(
        report["sim_seconds"]
            .as_f64()
            .is_some_and(|seconds| seconds > 1.0)
    );
    assert!(
        report["wall_seconds"]
            .as_f64()
            .is_some_and(|seconds| seconds > 0.0)
    );
    assert_eq!(report["robots"].as_array().map(Vec::len), Some(2));
    assert!(
        report["robots"][0]["distance_m"]
            .as_f64()
            .is_some_and(|metres| metres > 1.0)
    );
    assert!(
        report["messages"]["sent"]
            .as_u64()
            .is_some_and(|sent| sent > 0)
    );
    assert_eq!(report["collisions"], 0);
    let verdict = |name: &str| {
        let all = report["properties"].as_array().expect("it is a list");
        let found = all.iter().find(|property| property["property"] == name);
        found.expect("it is checked")["verdict"].clone()
    };
    for used in ["no_collision", "reach_avoid.goal", "broadcast.delivery"] {
        assert_eq!(verdict(used), "holds", "{used}");
    }
    // Race tells its waypoints in no order, and has no mutex.
    for unused in ["broadcast.total_order", "mutex.safety"] {
        assert_eq!(verdict(unused), "unused", "{unused}");
    }
}

#[test]
fn every_key_is_documented() {
    let mut found = BTreeSet::new();
    paths(
        &report("json_keys", &["--set", "properties.broadcast_bound=1ns"]),
        "",
        &mut found,
    );
    assert!(found.contains("properties.first.at_seconds"), "{found:?}");
    for path in found {
        assert!(
            REFERENCE.contains(&format!("`{path}`")),
            "{path} is not in the reference"
        );
    }
}

#[test]
fn so_is_every_key_of_the_other_commands() {
    let folder = folder("json_other_keys");
    for (heading, arguments) in [
        ("## `starl list`", &["list", "--json"][..]),
        (
            "## `starl bench`",
            &[
                "bench",
                "radio",
                "--robots",
                "9",
                "--seconds",
                "1",
                "--json",
            ],
        ),
    ] {
        let (_, section) = REFERENCE.split_once(heading).expect("it has a section");
        let section = section.split("\n## ").next().unwrap_or_default();
        let mut found = BTreeSet::new();
        paths(&json(&starl(&folder, arguments)), "", &mut found);
        assert!(!found.is_empty());
        for path in found {
            let name = path.rsplit('.').next().unwrap_or_default();
            assert!(
                section.contains(&format!("`{name}`")),
                "{path} is not in the section {heading}"
            );
        }
    }
}
