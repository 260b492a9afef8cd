//! Interventions belong to the run: they are the same in every copy, and in the scenario that is exported.

use crate::support::Client;
use serde_json::{Value, json};

fn race() -> Client {
    Client::open(
        json!({}),
        json!({"scenario": "race", "set": ["program=race.starl"], "seed": "11"}),
    )
}

/// Faults and others, with the times at which they are to happen.
fn interventions() -> [(Option<f64>, Value); 6] {
    let knobs = json!([{"loss": 0.4}, {"delay": 50_000_000}]);
    let pose = json!({"position": {"x": -3.0, "y": -3.0, "z": 0.0}, "yaw": 0.0, "pitch": 0.0, "roll": 0.0});
    [
        (None, json!({"fault": {"crash": [1]}})),
        (Some(4.0), json!({"fault": {"restart": [1]}})),
        (Some(2.5), json!({"network": knobs})),
        (
            Some(3.0),
            json!({"push": {"robot": 0, "by": {"x": 0.2, "y": 0.1, "z": 0.0}}}),
        ),
        (
            Some(5.0),
            json!({"join": {"like": 0, "name": "late", "pose": pose}}),
        ),
        (Some(6.0), json!({"leave": [2]})),
    ]
}

fn steer(client: &mut Client) {
    for (at, intervention) in interventions() {
        client.ask("apply", json!({"at": at, "intervention": intervention}));
    }
}

#[test]
fn the_same_interventions_give_the_same_run() {
    let (mut one, mut other) = (race(), race());
    one.ask("run", json!({"until": 2.0}));
    let undisturbed = one.ask("snapshot", json!({}));
    steer(&mut one);
    one.ask("run", json!({"until": 8.0}));
    while other.ask("run", json!({"until": 2.0, "steps": 7}))["steps"] == 7 {}
    steer(&mut other);
    other.ask("run", json!({"until": 5.5}));
    let snapshot = other.ask("snapshot", json!({}));
    other.ask("run", json!({"until": 9.0}));
    other.ask("restore", json!({"snapshot": snapshot}));
    other.ask("run", json!({"until": 8.0}));
    let digest = one.digest();
    assert_eq!(digest, other.digest());
    let fleet = one.ask("fleet", json!({}));
    assert_eq!(fleet[1]["condition"], "running");
    assert_eq!(fleet[2]["condition"], "left");
    assert_eq!(
        fleet
            .as_array()
            .and_then(|fleet| fleet.last())
            .expect("robots")["name"],
        "late"
    );

    one.ask("restore", json!({"snapshot": undisturbed}));
    one.ask("run", json!({"until": 8.0}));
    assert_ne!(one.digest(), digest);
}

#[test]
fn the_exported_scenario_goes_as_the_run_went() {
    let mut run = race();
    run.ask("run", json!({"until": 9.0}));
    let scenario = run.ask("scenario", json!({}));
    let text = scenario.as_str().expect("a text");
    assert!(text.contains("example:race/race.starl"), "{text}");
    let mut again = Client::open(json!({"exported.toml": text}), json!({}));
    again.ask("run", json!({"until": 9.0}));
    assert_eq!(again.digest(), run.digest());
}

#[test]
fn invalid_interventions_are_rejected() {
    let mut client = race();
    let refused = [
        (json!({"fault": {"crash": [99]}}), "there is no robot 99"),
        (json!({"network": [{"loss": 1.5}]}), "out of its range"),
        (
            json!({"remove_obstacle": {"index": 9999}}),
            "no obstacle 9999 stands",
        ),
        (
            json!({"remove_thing": {"name": "cup"}}),
            "there is no thing cup",
        ),
        (json!({"explode": 1}), "unknown variant `explode`"),
        (
            json!({"join": {"like": 0, "name": "late", "pose": 3}}),
            "Pose",
        ),
    ];
    for (intervention, words) in refused {
        let error = client.try_ask("apply", json!({"intervention": intervention}));
        let error = error.expect_err("it makes no sense");
        let message = error["message"].as_str().expect("a text");
        assert!(message.contains(words), "{message}");
    }
    let error = client.try_ask("apply", json!({"at": -1.0, "intervention": {"leave": [0]}}));
    assert!(error.is_err());
}
