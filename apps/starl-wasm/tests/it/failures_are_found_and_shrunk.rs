//! Trials under profiles of faults go as with `starl test`, and a failure shrinks to a scenario that still fails.

use crate::support::{Client, ask};
use serde_json::{Value, json};
use starl_catalog::service::Service;

/// Robots count aloud, and rely on hearing the numbers in order, which the network does not promise.
const PROGRAM: &str = include_str!("ordered.starl");
const SCENARIO: &str = include_str!("ordered.toml");

fn files() -> Value {
    json!({"worlds/ordered.toml": SCENARIO, "programs/ordered.starl": PROGRAM})
}

fn request(name: &str, profile: &str, seed: &str) -> Value {
    json!({ name: {"files": files(), "profile": profile, "seed": seed} })
}

fn asked(host: &mut Service, request: &Value) -> Value {
    ask(host, request).unwrap_or_else(|error| panic!("{error}"))
}

/// The first trial that goes wrong.
fn failure(host: &mut Service) -> Value {
    let mut tried = (1..30).map(|seed| asked(host, &request("try", "lossy", &seed.to_string())));
    let found = tried.find(|tried| !tried["wrong"].is_null());
    found.expect("a network that reorders messages breaks the property")
}

#[test]
fn every_profile_is_named_and_described() {
    let profiles = asked(&mut Service::default(), &json!({"profiles": {}}));
    let profiles = profiles.as_array().expect("a list");
    let usual: Vec<&Value> = (profiles.iter().filter(|profile| profile["usual"] == true))
        .map(|profile| &profile["name"])
        .collect();
    let names = [
        "calm",
        "lossy",
        "partitions",
        "crashes",
        "clocks",
        "chaos",
        "swarm",
    ];
    assert_eq!(usual, names);
    assert_eq!(profiles.len(), 8);
    assert_eq!(profiles[3]["demands_goal"], false);
    assert_eq!(
        profiles[1]["summary"],
        "messages are lost, doubled, held back and delayed"
    );
}

#[test]
fn a_calm_trial_goes_as_the_run_goes() {
    let options = json!({"scenario": "race", "seed": "11", "set": ["program=race.starl"]});
    let mut run = Client::open(json!({}), options.clone());
    run.ask("run", json!({}));
    let report = run.ask("report", json!({}));
    let tried = json!({"try": {"options": options, "profile": "calm", "seed": "11"}});
    let tried = asked(&mut run.host, &tried);
    for member in [
        "outcome",
        "digest",
        "now",
        "messages",
        "progress",
        "collisions",
    ] {
        assert_eq!(tried[member], report[member], "{member}");
    }
    assert_eq!(tried["wrong"], Value::Null);
}

#[test]
fn the_scenario_of_a_trial_goes_as_the_trial_went() {
    let mut host = Service::default();
    let tried = failure(&mut host);
    assert_eq!(tried["wrong"], "Ordered.in_order");
    assert_eq!(tried["outcome"], "violated");
    assert_eq!(tried["violations"][0]["property"], "Ordered.in_order");
    let seed = tried["seed"].as_str().expect("a text");
    let text = asked(&mut host, &request("profile_scenario", "lossy", seed));
    let files = json!({"worlds/again.toml": text, "programs/ordered.starl": PROGRAM});
    let mut run = Client::open(files, json!({}));
    let until = tried["now"].clone();
    run.ask("run", json!({"until": until}));
    let report = run.ask("report", json!({}));
    assert_eq!(report["violations"], tried["violations"]);
    assert_eq!(report["digest"], tried["digest"]);
}

#[test]
fn a_failure_shrinks_to_a_scenario_that_fails() {
    let mut host = Service::default();
    let seed = failure(&mut host)["seed"].clone();
    let shrink = |most: u64| {
        json!({"shrink": {
            "files": files(), "profile": "lossy", "seed": seed, "most": most,
        }})
    };
    let first = asked(&mut host, &shrink(1));
    assert_eq!(
        (&first["trials"], &first["minimal"]),
        (&json!(1), &json!(false))
    );
    assert_eq!(first["before"]["robots"], 4);
    assert_eq!(first["after"]["robots"], 4);
    let pieces = [20, 60, 1000].map(|most| asked(&mut host, &shrink(most)));
    let last = &pieces[2];
    assert_eq!(last["minimal"], true);
    assert_eq!(last["after"]["robots"], 2);
    // In one piece it comes to the same.
    assert_eq!(&asked(&mut Service::default(), &shrink(1000)), last);

    let files = json!({"worlds/small.toml": last["scenario"], "programs/ordered.starl": PROGRAM});
    let mut run = Client::open(files, json!({}));
    run.ask("run", json!({"until": last["tried"]["now"]}));
    let report = run.ask("report", json!({}));
    assert_eq!(report["violations"], last["tried"]["violations"]);
    assert_eq!(report["digest"], last["tried"]["digest"]);
}

#[test]
fn the_smaller_scenario_of_an_example_names_its_programs_everywhere() {
    let options = json!({"scenario": "race", "set": ["program=race.starl"]});
    let parameters = json!({"options": options, "profile": "crashes", "seed": "5"});
    let scenario = asked(
        &mut Service::default(),
        &json!({"profile_scenario": parameters}),
    );
    let text = scenario.as_str().expect("a text");
    assert!(text.contains("example:race/race.starl"), "{text}");
}

#[test]
fn invalid_trials_are_rejected() {
    let mut host = Service::default();
    let refused = [
        (
            request("try", "lossi", "1"),
            "there is no profile \"lossi\"",
        ),
        (request("try", "lossy", "-1"), "\"-1\" is not a seed"),
        (
            request("shrink", "calm", "1"),
            "nothing goes wrong in this run",
        ),
        (
            json!({"try": {"profile": "calm", "seed": "1"}}),
            "neither a scenario nor a program",
        ),
    ];
    for (request, words) in refused {
        let error = ask(&mut host, &request).expect_err("it cannot be tried");
        let message = error["message"].as_str().expect("a text");
        assert!(message.contains(words), "{message}");
    }
}
