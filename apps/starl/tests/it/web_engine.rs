//! `starl run --open` gives the page the run, to be driven by requests.

use crate::support::*;
use crate::web_support::*;
use serde_json::json;

#[test]
fn a_run_in_the_browser_has_the_digest_of_the_command() {
    let folder = folder("open_digest");
    file(&folder, "small.toml", SMALL);
    file(
        &folder,
        "faults.toml",
        "[[fault]]\nat = \"2s\"\nkind = \"crash\"\nrobots = [\"create0\"]\n",
    );
    let runs: [&[&str]; 4] = [
        &["small.toml"],
        &["race", "--seed", "7", "--duration", "20s"],
        &[
            "small.toml",
            "--robots",
            "create=2",
            "--set",
            "network.loss=0.5",
            "--faults",
            "faults.toml",
        ],
        &["small.toml", "--threads", "2"],
    ];
    for arguments in runs {
        let expected = digest(&folder, arguments);
        let server = Server::start(&folder, &[&["run"], arguments, &["--open"]].concat());
        let mut engine = server.engine();
        let status = engine.ok(&json!({ "run": { "simulation": 0 } }));
        assert_eq!(status["over"], true);
        let report = engine.ok(&json!({ "report": { "simulation": 0 } }));
        assert_eq!(report["digest"], expected, "{arguments:?}");
    }
}

#[test]
fn the_page_gets_the_target_and_its_files() {
    let folder = folder("open_start");
    file(&folder, "small.toml", SMALL);
    let server = Server::start(&folder, &["run", "small.toml", "--seed", "9", "--open"]);
    let start = server.get("/start.json", &[]).json();
    assert_eq!(start["mode"], "run");
    assert_eq!(start["opened"]["simulation"], 0);
    assert_eq!(start["opened"]["seed"], "9");
    assert_eq!(start["opened"]["duration"], 30.0);
    assert_eq!(start["scenario"], "small.toml");
    assert_eq!(start["files"], json!({ "small.toml": SMALL }));

    let server = Server::start(&folder, &["run", "race", "--open"]);
    let start = server.get("/start.json", &[]).json();
    let files = start["files"].as_object().expect("files by name");
    let scenario = start["scenario"].as_str().expect("a name");
    assert!(
        files[scenario]
            .as_str()
            .is_some_and(|text| text.contains("[world]"))
    );
    let program = files.iter().find(|(name, _)| name.ends_with(".starl"));
    let (_, text) = program.expect("the program is there");
    assert!(text.as_str().is_some_and(|text| text.contains("program")));
    // The written run names the program so that it can be found from anywhere.
    let written = server
        .engine()
        .ok(&json!({ "scenario": { "simulation": 0 } }));
    assert!(
        written
            .as_str()
            .is_some_and(|text| text.contains("\"example:race/")),
        "{written}"
    );
}

#[test]
fn poses_and_frames_are_numbers() {
    let folder = folder("open_numbers");
    file(&folder, "small.toml", SMALL);
    let server = Server::start(&folder, &["run", "small.toml", "--open"]);
    let mut engine = server.engine();
    let poses = engine.numbers("poses", 0);
    assert_eq!(poses.len(), 2 * 11);
    assert_eq!(poses[11..13], [0.0, 1.0]);
    engine.ok(&json!({ "run": { "simulation": 0, "until": 5 } }));
    assert_ne!(engine.numbers("poses", 0), poses);
    engine.ok(&json!({ "run": { "simulation": 0, "until": 7, "sample": 1 } }));
    let frames = engine.numbers("frames", 0);
    let frames: Vec<&[f64]> = frames.chunks(2 + 2 * 11).collect();
    let heads: Vec<&[f64]> = frames.iter().map(|frame| &frame[..2]).collect();
    assert_eq!(heads, [[6.0, 2.0], [7.0, 2.0]]);
    assert_eq!(frames[1][2..], engine.numbers("poses", 0));
    for kind in ["poses", "frames"] {
        let request = json!({ "id": 9, kind: 4 }).to_string();
        engine.socket.send(request.into()).expect("it is read");
        let refused = engine.socket.read().expect("it is answered");
        let refused: serde_json::Value =
            serde_json::from_str(refused.to_text().expect("text")).expect("JSON");
        assert_eq!(refused["id"], 9);
        assert_eq!(refused["error"]["message"], "there is no simulation 4");
    }
}

#[test]
fn each_page_has_simulations_of_its_own() {
    let folder = folder("open_twice");
    file(&folder, "small.toml", SMALL);
    let server = Server::start(&folder, &["run", "small.toml", "--open"]);
    let (mut one, mut other) = (server.engine(), server.engine());
    let push = json!({ "push": { "robot": 0, "by": { "x": 0.2, "y": 0, "z": 0 } } });
    one.ok(&json!({ "apply": { "simulation": 0, "intervention": push } }));
    let opened = one.ok(&json!({ "open": { "options": { "scenario": "race" } } }));
    assert_eq!(opened["simulation"], 1);
    one.ok(&json!({ "run": { "simulation": 0 } }));
    let status = other.ok(&json!({ "status": { "simulation": 0 } }));
    assert_eq!(status["now"], 0.0);
    let refused = other.ask(&json!({ "status": { "simulation": 1 } }));
    assert!(refused["error"]["message"].is_string(), "{refused}");
    other.ok(&json!({ "run": { "simulation": 0 } }));
    let report = other.ok(&json!({ "report": { "simulation": 0 } }));
    assert_eq!(report["digest"], digest(&folder, &["small.toml"]));
    let steered = one.ok(&json!({ "report": { "simulation": 0 } }));
    assert_ne!(steered["digest"], report["digest"]);
}

#[test]
fn requests_that_wait_are_answered_in_order() {
    let folder = folder("open_order");
    file(&folder, "small.toml", SMALL);
    let server = Server::start(&folder, &["run", "small.toml", "--open"]);
    let mut engine = server.engine();
    for id in 0..200 {
        let request = json!({ "run": { "simulation": 0, "steps": 1 } });
        let text = json!({ "id": id, "request": request }).to_string();
        engine.socket.send(text.into()).expect("it is read");
    }
    for id in 0..200 {
        let answer = engine.socket.read().expect("it is answered");
        let text = answer.to_text().expect("text");
        assert!(
            text.starts_with(&format!("{{\"id\":{id},\"ok\":")),
            "{text}"
        );
    }
}
