//! Problems of programs and scenarios that are held in memory.

use crate::support::{Client, ask};
use serde_json::{Value, json};
use starl_catalog::service::Service;

const LIBRARY: &str = "library tools\n\nfunction twice(n: Int) -> Int\n    return n + n\n";
const PROGRAM: &str = "program Counter\n\nimport tools\n\ncount: Int = 0\n\ntick()\n    pre count < 8\n    eff count = tools.twice(count) + 1\n\nstop()\n    pre count >= 8\n    eff finish()\n";
const SCENARIO: &str = "program = \"../programs/counter.starl\"\nduration = \"10s\"\n[world]\nstart_area = { low = [0, 0], high = [4, 4] }\n[[robots]]\nmodel = \"create\"\ncount = 2\n";

fn files(program: &str, scenario: &str) -> Value {
    json!({
        "lab/small.toml": scenario,
        "programs/counter.starl": program,
        "programs/tools.starl": LIBRARY,
    })
}

fn check(files: Value) -> Vec<Value> {
    let found = ask(&mut Service::default(), &json!({"check": {"files": files}}));
    let found = found.unwrap_or_else(|error| panic!("{error}"));
    found.as_array().expect("a list").clone()
}

#[test]
fn files_find_each_other_by_relative_paths() {
    assert_eq!(check(files(PROGRAM, SCENARIO)), [] as [Value; 0]);
    let mut client = Client::open(files(PROGRAM, SCENARIO), json!({}));
    let end = client.ask("run", json!({}));
    assert_eq!(end["outcome"], "reached");
}

#[test]
fn a_problem_of_a_program_has_a_place_and_a_code() {
    let broken = PROGRAM.replace("tools.twice(count) + 1", "tally + 1");
    let found = check(files(&broken, SCENARIO));
    assert_eq!(found.len(), 1, "{found:?}");
    let found = &found[0];
    assert_eq!(found["file"], "programs/counter.starl");
    assert_eq!((&found["line"], &found["column"]), (&json!(9), &json!(17)));
    assert_eq!(
        (&found["length"], &found["end_column"]),
        (&json!(5), &json!(22))
    );
    assert_eq!(found["severity"], "error");
    assert!(
        found["code"]
            .as_str()
            .is_some_and(|code| code.starts_with('E'))
    );
    let opened = ask(
        &mut Service::default(),
        &json!({"open": {"files": files(&broken, SCENARIO)}}),
    );
    let refused = opened.expect_err("the program is broken");
    assert_eq!(&refused["diagnostics"][0], found);
}

#[test]
fn a_problem_of_a_scenario_has_a_place_and_a_field() {
    let broken = format!("{SCENARIO}[network]\nloss = 1.5\n");
    let found = check(files(PROGRAM, &broken));
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0]["file"], "lab/small.toml");
    assert_eq!(found[0]["line"], 9);
    assert_eq!(found[0]["field"], "network.loss");
    assert_eq!(found[0]["code"], Value::Null);
}

#[test]
fn a_program_alone_runs_on_an_empty_floor() {
    let files = json!({"counter.starl": PROGRAM, "tools.starl": LIBRARY});
    let mut client = Client::open(files, json!({"seed": "3", "robots": "create=3"}));
    assert_eq!(
        client.ask("fleet", json!({})).as_array().map(Vec::len),
        Some(3)
    );
    assert_eq!(client.ask("run", json!({}))["outcome"], "reached");
}

#[test]
fn options_are_refused_where_they_lead_nowhere() {
    let cases = [
        (
            json!({"scenario": "rase"}),
            "there is no file or example called this",
        ),
        (json!({"set": ["network.loss"]}), "--set network.loss"),
        (json!({"seed": "many"}), "seed"),
        (json!({"faults": "none.toml"}), "there is no such file"),
        (json!({"sede": "1"}), "unknown field `sede`"),
    ];
    for (options, words) in cases {
        let request = json!({"open": {"files": files(PROGRAM, SCENARIO), "options": options}});
        let error = ask(&mut Service::default(), &request).expect_err("it leads nowhere");
        let message = error["message"].as_str().expect("a text");
        assert!(message.contains(words), "{message}");
    }
}

#[test]
fn an_examples_program_can_be_edited() {
    let mut host = Service::default();
    let examples = ask(&mut host, &json!({"examples": {}})).expect("there are examples");
    let examples = examples.as_array().expect("a list");
    let line = examples
        .iter()
        .find(|example| example["name"] == "line")
        .expect("the example");
    assert!(line["files"][line["scenario"].as_str().expect("a path")].is_string());
    let edited = json!({"line.starl": "program Line\n\nstop()\n    pre true\n    eff finish()\n"});
    let mut client = Client::open(edited, json!({"scenario": "line"}));
    client.ask("run", json!({"until": 2.0}));
    assert_eq!(client.ask("fleet", json!({}))[0]["condition"], "finished");
    assert!(
        !client
            .ask("scenario", json!({}))
            .to_string()
            .contains("example:")
    );
}
