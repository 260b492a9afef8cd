//! Records are returned in batches, in the form of traces.

use crate::support::Client;
use serde_json::{Value, json};

fn broadcast() -> Client {
    Client::open(json!({}), json!({"scenario": "broadcast"}))
}

fn records(client: &mut Client, max: u64) -> Vec<Value> {
    let batch = client.ask("records", json!({"max": max}));
    assert_eq!(batch["dropped"], 0);
    batch["records"].as_array().expect("a list").clone()
}

#[test]
fn batches_add_up_to_one_batch() {
    let (mut one, mut other) = (broadcast(), broadcast());
    one.ask("run", json!({"until": 2.0}));
    let whole = records(&mut one, 1_000_000);
    assert!(whole.len() > 100, "{}", whole.len());
    let mut parts = Vec::new();
    while other.ask("run", json!({"until": 2.0, "steps": 9}))["steps"] != 0 {
        loop {
            let part = records(&mut other, 10);
            if part.is_empty() {
                break;
            }
            assert!(part.len() <= 10);
            parts.extend(part);
        }
    }
    assert_eq!(parts, whole);
    assert!(records(&mut one, 10).is_empty());
    let first = &whole[0];
    assert!(
        first["topic"]
            .as_str()
            .is_some_and(|topic| topic.starts_with("/starl/"))
    );
    assert!(first["time_ns"].is_u64() && first["message"].is_object());
}

#[test]
fn a_snapshot_keeps_records_that_were_not_taken() {
    let mut client = broadcast();
    client.ask("run", json!({"until": 1.0}));
    let snapshot = client.ask("snapshot", json!({}));
    let taken = records(&mut client, 1_000_000);
    client.ask("restore", json!({"snapshot": snapshot}));
    assert_eq!(records(&mut client, 1_000_000), taken);
}

#[test]
fn topics_can_be_chosen() {
    let request = json!({"open": {
        "options": {"scenario": "broadcast"}, "topics": ["/starl/action"],
    }});
    let mut host = starl_catalog::service::Service::default();
    let opened = crate::support::ask(&mut host, &request).expect("an example");
    let simulation = opened["simulation"].clone();
    let mut client = Client { host, simulation };
    client.ask("run", json!({"until": 1.0}));
    let kept = records(&mut client, 1_000_000);
    assert!(!kept.is_empty());
    assert!(kept.iter().all(|record| record["topic"] == "/starl/action"));
}
