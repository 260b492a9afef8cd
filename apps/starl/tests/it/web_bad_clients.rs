//! Bad clients of the server: from another origin, with invalid or too large requests, or with closed connections.

use crate::support::*;
use crate::web_support::*;
use serde_json::json;
use std::io::Write;
use std::net::TcpStream;
use std::path::Path;
#[cfg(target_os = "linux")]
use std::time::{Duration, Instant};

/// A run that is too long to wait for.
fn endless(folder: &Path) {
    let text = SMALL.replacen("\"30s\"", "\"1000000000s\"\ngoal = \"duration\"", 1);
    file(folder, "endless.toml", &text);
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
    assert_eq!(
        &*frame.reason,
        "more than 256 requests are waiting; wait for answers first"
    );
}

#[test]
fn a_websocket_from_another_origin_is_refused() {
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
    // The connection continues.
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
fn a_malformed_message_ends_the_connection_with_a_reason() {
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

/// Whether a thread of a process has something to do, whether or not it gets a processor for it.
#[cfg(target_os = "linux")]
fn is_busy(process: u32) -> bool {
    let threads = std::fs::read_dir(format!("/proc/{process}/task")).expect("it runs");
    let mut states = threads.filter_map(|thread| {
        let text = std::fs::read_to_string(thread.ok()?.path().join("stat")).ok()?;
        let (_, fields) = text.rsplit_once(") ")?;
        fields.chars().next()
    });
    states.any(|state| state != 'S')
}

#[test]
#[cfg(target_os = "linux")]
fn a_closed_page_cancels_its_requests() {
    let folder = folder("open_vanish");
    endless(&folder);
    let server = Server::start(&folder, &["run", "endless.toml", "--open"]);
    let run = json!({ "id": 1, "request": { "run": { "simulation": 0 } } }).to_string();
    let process = server.process.id();
    for says_so in [true, false] {
        let mut engine = server.engine();
        engine.socket.send(run.clone().into()).expect("it is read");
        // Others are answered meanwhile.
        let status = server
            .engine()
            .ok(&json!({ "status": { "simulation": 0 } }));
        assert_eq!(status["now"], 0.0);
        wait_until(|| (0..10).all(|_| is_busy(process)));
        if says_so {
            engine.socket.close(None).expect("it is read");
            engine.socket.flush().expect("it is read");
        }
        drop(engine);
        wait_until(|| !is_busy(process));
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
fn a_client_that_breaks_off_does_not_disturb_others() {
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
