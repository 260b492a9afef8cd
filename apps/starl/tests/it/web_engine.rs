//! `starl run --open` gives the page the run, to be driven by requests.

use crate::support::*;
use crate::web_support::*;
use serde_json::json;
use std::io::Write;
use std::net::TcpStream;
use std::path::Path;
use std::time::{Duration, Instant};

/// A run that nobody can wait for.
fn endless(folder: &Path) {
    let text = SMALL.replacen("\"30s\"", "\"1000000s\"\ngoal = \"duration\"", 1);
    file(folder, "endless.toml", &text);
}

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
fn the_page_is_told_what_is_run_and_from_which_files() {
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
    // What is written of the run names the program as it can be named anywhere.
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
fn poses_and_frames_come_as_numbers() {
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

#[test]
fn too_many_requests_at_once_end_the_connection() {
    let folder = folder("open_many");
    endless(&folder);
    let server = Server::start(&folder, &["run", "endless.toml", "--open"]);
    let mut engine = server.engine();
    let run = json!({ "id": 1, "request": { "run": { "simulation": 0 } } }).to_string();
    for _ in 0..258 {
        engine.socket.send(run.clone().into()).expect("it is read");
    }
    let told = engine.socket.read().expect("it is answered");
    let tungstenite::Message::Close(Some(frame)) = told else {
        panic!("{told}");
    };
    assert_eq!(&*frame.reason, "too many requests wait; wait for answers");
}

#[test]
fn pages_of_other_origins_get_no_engine() {
    let folder = folder("open_origin");
    file(&folder, "small.toml", SMALL);
    let server = Server::start(&folder, &["run", "small.toml", "--open"]);
    let (own, cookie) = (server.origin(), server.cookie());
    let cases: [&[(&'static str, &str)]; 4] = [
        &[("cookie", &cookie), ("origin", "http://example.org")],
        &[("cookie", &cookie), ("origin", "null")],
        &[("cookie", &cookie)],
        &[("origin", &own)],
    ];
    for headers in cases {
        assert_eq!(server.engine_with(headers).err(), Some(403), "{headers:?}");
    }
    assert!(
        server
            .engine_with(&[("cookie", &cookie), ("origin", &own)])
            .is_ok()
    );
}

#[test]
fn messages_that_are_too_long_are_refused() {
    let folder = folder("open_long");
    file(&folder, "small.toml", SMALL);
    let server = Server::start(&folder, &["run", "small.toml", "--open"]);
    let mut engine = server.engine();
    let long = "a".repeat(17 << 20);
    let refused = engine.ask(&json!({ "check": { "files": { "a.starl": long } } }));
    let message = refused["error"]["message"].as_str().expect("a message");
    assert!(message.contains("at most 16777216"), "{message}");
    // The connection goes on.
    assert_eq!(
        engine.ok(&json!({ "status": { "simulation": 0 } }))["now"],
        0.0
    );
    // Beyond any measure it does not; the server does.
    let endless = "a".repeat(65 << 20);
    let sent = engine.socket.send(endless.into());
    let told = engine.socket.read();
    assert!(
        sent.is_err() || matches!(told, Err(_) | Ok(tungstenite::Message::Close(_))),
        "{told:?}"
    );
    assert_eq!(
        server
            .engine()
            .ok(&json!({ "status": { "simulation": 0 } }))["now"],
        0.0
    );
}

#[test]
fn what_is_no_request_ends_the_connection_with_a_reason() {
    let folder = folder("open_bad");
    file(&folder, "small.toml", SMALL);
    let server = Server::start(&folder, &["run", "small.toml", "--open"]);
    let bad: [tungstenite::Message; 5] = [
        "hello".into(),
        "{}".into(),
        r#"{"id":-1,"request":{"examples":{}}}"#.into(),
        r#"{"id":1,"request":{"examples":{}},"more":1}"#.into(),
        vec![1, 2, 3].into(),
    ];
    for message in bad {
        let mut engine = server.engine();
        engine.socket.send(message.clone()).expect("it is read");
        let told = engine.socket.read().expect("it is answered");
        let tungstenite::Message::Close(Some(frame)) = told else {
            panic!("{message}: {told}");
        };
        assert!(frame.reason.starts_with("send "), "{frame}");
    }
    let mut engine = server.engine();
    let refused = engine.ask(&json!({ "fly": {} }));
    let message = refused["error"]["message"].as_str().expect("a message");
    assert!(message.contains("unknown variant `fly`"), "{message}");
}

/// The time that the processors have worked for a process, in ticks of the system.
#[cfg(target_os = "linux")]
fn processor_ticks(process: u32) -> u64 {
    let text = std::fs::read_to_string(format!("/proc/{process}/stat")).expect("it runs");
    let fields: Vec<&str> = text
        .rsplit(") ")
        .next()
        .expect("fields")
        .split(' ')
        .collect();
    let number = |index: usize| fields[index].parse::<u64>().expect("a number");
    number(11) + number(12)
}

/// The run would take days.
#[test]
#[cfg(target_os = "linux")]
fn a_page_that_goes_away_ends_what_it_has_asked_for() {
    let folder = folder("open_vanish");
    endless(&folder);
    let server = Server::start(&folder, &["run", "endless.toml", "--open"]);
    let run = json!({ "id": 1, "request": { "run": { "simulation": 0 } } }).to_string();
    let process = server.process.id();
    for says_so in [true, false] {
        let mut engine = server.engine();
        let idle = processor_ticks(process);
        engine.socket.send(run.clone().into()).expect("it is read");
        // Others are answered meanwhile.
        assert_eq!(
            server
                .engine()
                .ok(&json!({ "status": { "simulation": 0 } }))["now"],
            0.0
        );
        wait_until(|| processor_ticks(process) > idle + 10);
        if says_so {
            engine.socket.close(None).expect("it is read");
            engine.socket.flush().expect("it is read");
        }
        drop(engine);
        // It works no more when hardly a tick is added in a while.
        wait_until(|| {
            let before = processor_ticks(process);
            std::thread::sleep(Duration::from_millis(200));
            processor_ticks(process) <= before + 1
        });
    }
}

#[cfg(target_os = "linux")]
fn wait_until(mut is_so: impl FnMut() -> bool) {
    let start = Instant::now();
    while !is_so() {
        assert!(
            start.elapsed() < Duration::from_secs(60),
            "it never came to that"
        );
        std::thread::sleep(Duration::from_millis(10));
    }
}

#[test]
fn a_client_that_breaks_off_does_not_hurt() {
    let folder = folder("open_broken");
    file(&folder, "small.toml", SMALL);
    let server = Server::start(&folder, &["run", "small.toml", "--open"]);
    for half in [
        "",
        "GET",
        "GET /engine HTTP/1.1\r\nhost: ",
        "\r\n\r\n",
        "\0\u{1}\u{2}",
    ] {
        let mut stream = TcpStream::connect(server.host()).expect("the server listens");
        stream.write_all(half.as_bytes()).expect("it is read");
    }
    let mut engine = server.engine();
    let stream = engine.socket.get_mut();
    // The head of a message that never comes.
    stream.write_all(&[0x81, 0xfe, 0xff]).expect("it is read");
    drop(engine);
    assert_eq!(
        server
            .engine()
            .ok(&json!({ "status": { "simulation": 0 } }))["now"],
        0.0
    );
}
