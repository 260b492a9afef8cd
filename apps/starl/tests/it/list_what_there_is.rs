//! `starl list` shows examples, programs, models and planners.

use crate::support::*;

#[test]
fn it_names_examples_models_and_planners() {
    let output = starl(&folder("list_text"), &["list"]);
    assert_eq!(status(&output), 0);
    let text = stdout(&output);
    for expected in [
        "race",
        "create",
        "drone",
        "car",
        "holonomic",
        "differential",
        "rrt-connect",
    ] {
        assert!(text.contains(expected), "no {expected} in {text}");
    }
    for line in text.lines() {
        assert!(line.chars().count() <= 80, "{line}");
    }
}

#[test]
fn as_json_it_has_each_models_body_speed_and_commands() {
    let listing = json(&starl(&folder("list_json"), &["list", "--json"]));
    let models = listing["models"].as_array().expect("models are a list");
    let create = models
        .iter()
        .find(|model| model["name"] == "create")
        .expect("there is one");
    assert_eq!(create["radius_m"], 0.165);
    assert!(
        create["speed_mps"]
            .as_f64()
            .is_some_and(|speed| speed > 0.0)
    );
    let commands = create["commands"].as_array().expect("commands are a list");
    for name in ["stop", "straight", "turn", "curve"] {
        assert!(
            commands.iter().any(|command| command == name),
            "no {name} in {commands:?}"
        );
    }
    assert!(
        listing["examples"]
            .as_array()
            .is_some_and(|all| all.iter().any(|e| e["name"] == "race"))
    );
}

#[test]
fn every_example_runs() {
    let folder = folder("list_examples");
    let listing = json(&starl(&folder, &["list", "--json"]));
    for example in listing["examples"].as_array().expect("examples are a list") {
        let name = example["name"].as_str().expect("a name is a text");
        let output = starl(&folder, &["run", name, "--json", "--duration", "1s"]);
        assert_eq!(json(&output)["sim_seconds"], 1.0, "{}", stderr(&output));
    }
}
