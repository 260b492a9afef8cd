//! A program in Rust that panics; no program that ships with the command does.

use super::*;
use starl_catalog::session::{Files, Options};
use starl_core::{Primitives, Program, Robot};
use std::net::TcpStream;
use tungstenite::client::{IntoClientRequest, client};
use tungstenite::{Message, WebSocket};

/// A program with a fault.
#[derive(Clone, Primitives)]
struct Faulty;

impl Program for Faulty {
    fn activate(&mut self, _: &mut Robot<'_>) {
        panic!("the program has a fault");
    }
}

const SCENARIO: &str = r#"
program = "faulty"
duration = "10s"

[[robots]]
model = "holonomic"
count = 1
start = [{ position = [0, 0] }]
"#;

/// Serves a run of the scenario in a thread of its own; returns the port and the cookie.
fn served() -> (u16, String) {
    let registry = Registry::default().with("faulty", "panic", |_| Faulty);
    let files: Files = [("s.toml".to_string(), SCENARIO.into())]
        .into_iter()
        .collect();
    let session = Session::open(&files, &Options::default(), &registry).expect("it is sound");
    let content = Content::Run {
        start: serde_json::Value::Null,
        origin: Box::new(Origin::new(session, registry, None)),
    };
    let (port, told) = std::sync::mpsc::channel();
    std::thread::spawn(move || {
        let runtime = runtime::Builder::new_current_thread().enable_all().build();
        runtime.expect("a runtime").block_on(async {
            let listener = listen(None).await.expect("there is a port");
            let own = listener.local_addr().expect("an address").port();
            let guard = Guard::new(own).expect("a token");
            let token = guard
                .address()
                .split('=')
                .nth(1)
                .expect("a token")
                .to_string();
            port.send((own, format!("starl-{own}={token}")))
                .expect("it is heard");
            let router = router(Page::BuiltIn(&[]), content, guard);
            axum::serve(listener, router)
                .await
                .expect("the server runs");
        });
    });
    told.recv().expect("the answer is sent")
}

fn connect(port: u16, cookie: &str) -> WebSocket<TcpStream> {
    let address = format!("ws://127.0.0.1:{port}/engine");
    let mut request = address.into_client_request().expect("an address");
    let origin = format!("http://127.0.0.1:{port}");
    for (name, value) in [("origin", &*origin), ("cookie", cookie)] {
        request
            .headers_mut()
            .insert(name, value.parse().expect("a value"));
    }
    let stream = TcpStream::connect(("127.0.0.1", port)).expect("it listens");
    client(request, stream).expect("it lets us in").0
}

#[test]
fn a_request_that_panics_is_answered_and_the_server_continues() {
    let (port, cookie) = served();
    for _ in 0..2 {
        let mut socket = connect(port, &cookie);
        let run = r#"{"id":7,"request":{"run":{"simulation":0}}}"#;
        socket.send(run.into()).expect("it is read");
        let answer = socket.read().expect("it is answered");
        let answer = answer.to_text().expect("it is text");
        assert!(answer.contains(r#""id":7"#), "{answer}");
        assert!(answer.contains("the program has a fault"), "{answer}");
        assert!(matches!(socket.read(), Ok(Message::Close(Some(_)))));
    }
    let mut socket = connect(port, &cookie);
    let status = r#"{"id":8,"request":{"status":{"simulation":0}}}"#;
    socket.send(status.into()).expect("it is read");
    let answer = socket.read().expect("it is answered");
    let answer = answer.to_text().expect("it is text");
    assert!(answer.starts_with(r#"{"id":8,"ok":"#), "{answer}");
}
