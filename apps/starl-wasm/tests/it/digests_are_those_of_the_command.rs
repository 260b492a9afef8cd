//! A run in pieces, with steps forth and back, has the digest that the command has for the whole.

use crate::support::Client;
use serde_json::{Value, json};

#[test]
fn stepping_and_going_back_does_not_change_the_digest() {
    let golden: Vec<Value> =
        serde_json::from_str(include_str!("../../golden.json")).expect("the file is JSON");
    assert!(!golden.is_empty());
    for entry in golden {
        let options = json!({
            "scenario": entry["example"], "set": entry["set"], "robots": entry["robots"],
        });
        let mut client = Client::open(json!({}), options);
        client.ask("run", json!({"until": 3.5}));
        let snapshot = client.ask("snapshot", json!({}));
        let ahead = client.ask("run", json!({"steps": 77}));
        assert_eq!(ahead["steps"], 77);
        let digest = client.digest();
        let back = client.ask("restore", json!({"snapshot": snapshot}));
        assert_eq!(back["now"], 3.5);
        client.ask("drop", json!({"snapshot": snapshot}));
        client.ask("run", json!({"steps": 77}));
        assert_eq!(client.digest(), digest, "{entry}");
        while client.ask("run", json!({"steps": 1000}))["over"] == false {}
        assert_eq!(client.digest(), entry["digest"], "{entry}");
    }
}
