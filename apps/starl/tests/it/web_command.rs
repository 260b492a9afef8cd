//! The commands that serve the page: their messages, how they open a browser, and how they end.

use crate::support::*;
use crate::web_support::*;
use std::io::Read;
use std::net::TcpListener;
use std::path::Path;

fn refused(folder: &Path, arguments: &[&str], expected: &[&str]) {
    let output = starl(folder, arguments);
    let text = stderr(&output);
    assert_eq!(
        (status(&output), stdout(&output)),
        (2, String::new()),
        "{arguments:?}: {text}"
    );
    for part in expected {
        assert!(
            text.contains(part),
            "no {part:?} in the message on {arguments:?}: {text}"
        );
    }
}

#[test]
fn the_page_alone_is_served() {
    let folder = folder("web_alone");
    let server = Server::start(&folder, &["web"]);
    let start = server.get("/start.json", &[]).json();
    assert_eq!(start, serde_json::json!({ "mode": "web" }));
    let trace = server.get("/trace", &[]);
    assert_eq!(
        (trace.status, &*trace.text()),
        (404, "this server has no trace\n")
    );
    let headers = [("cookie", &*server.cookie()), ("origin", &*server.origin())];
    assert_eq!(server.engine_with(&headers).err(), Some(404));
}

#[test]
fn the_port_can_be_chosen() {
    let folder = folder("web_port");
    page(&folder);
    // Free a moment ago.
    let taken = TcpListener::bind("127.0.0.1:0").expect("there is a port");
    let port = taken.local_addr().expect("it has an address").port();
    let arguments = [
        "web",
        "--no-browser",
        "--page",
        "page",
        "--port",
        &port.to_string(),
    ];
    refused(
        &folder,
        &arguments,
        &[&format!("--port {port}: another program listens there")],
    );
    drop(taken);
    let server = Server::of(&mut command(&folder, &arguments));
    assert_eq!(server.port, port);
    assert_eq!(server.get("/", &[]).status, 200);
}

#[test]
fn options_that_do_not_fit_are_refused() {
    let folder = folder("web_options");
    page(&folder);
    file(&folder, "small.toml", SMALL);
    file(&folder, "bad.toml", &SMALL.replacen("\"20%\"", "1.5", 1));
    let open = [
        "run",
        "small.toml",
        "--open",
        "--no-browser",
        "--page",
        "page",
    ];
    for (option, value) in [("--trace", "a.mcap"), ("--plot", "a.svg")] {
        let arguments = [&open[..], &[option, value]].concat();
        refused(
            &folder,
            &arguments,
            &["'--open' cannot be used with", option],
        );
    }
    refused(
        &folder,
        &[&open[..], &["--json"]].concat(),
        &["cannot be used with", "--json"],
    );
    refused(
        &folder,
        &["run", "small.toml", "--no-browser"],
        &["add --open"],
    );
    refused(
        &folder,
        &["run", "small.toml", "--port", "8000"],
        &["add --open"],
    );
    for port in ["0", "70000", "http"] {
        refused(&folder, &["web", "--port", port], &["--port", port]);
    }
    refused(
        &folder,
        &["web", "--page", "none"],
        &["--page none", "index.html"],
    );
    let bad = [
        "run",
        "bad.toml",
        "--open",
        "--no-browser",
        "--page",
        "page",
    ];
    refused(&folder, &bad, &["bad.toml:20", "network.loss"]);
    assert!(!names(&folder).contains(&"a.mcap".to_string()));
}

#[cfg(target_os = "linux")]
#[test]
fn the_systems_opener_is_given_the_address() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder("web_opener");
    page(&folder);
    let opener = file(
        &folder,
        "xdg-open",
        "#!/bin/sh\nprintf %s \"$1\" > opened.partial && /bin/mv opened.partial opened\n",
    );
    let executable = std::fs::Permissions::from_mode(0o755);
    std::fs::set_permissions(opener, executable).expect("it can be made executable");
    let mut quiet = command(&folder, &["web", "--page", "page", "--no-browser"]);
    let quiet = Server::of(quiet.env("PATH", &folder));
    assert_eq!(quiet.get("/", &[]).status, 200);
    assert!(!folder.join("opened").exists());
    let mut opening = command(&folder, &["web", "--page", "page"]);
    let server = Server::of(opening.env("PATH", &folder));
    while !folder.join("opened").exists() {
        std::thread::yield_now();
    }
    let opened = std::fs::read_to_string(folder.join("opened")).expect("it is text");
    assert_eq!(
        opened,
        format!("{}/?token={}", server.origin(), server.token)
    );
}

#[cfg(unix)]
#[test]
fn a_request_to_end_ends_the_server_at_once() {
    let folder = folder("web_end");
    let text = SMALL.replacen("\"30s\"", "\"1000000s\"\ngoal = \"duration\"", 1);
    file(&folder, "endless.toml", &text);
    for signal in ["-INT", "-TERM"] {
        let mut server = Server::start(&folder, &["run", "endless.toml", "--open"]);
        let mut engine = server.engine();
        let run = r#"{"id":1,"request":{"run":{"simulation":0}}}"#;
        engine.socket.send(run.into()).expect("it is read");
        let process = server.process.id().to_string();
        let sent = std::process::Command::new("kill")
            .args([signal, &process])
            .status();
        assert!(sent.is_ok_and(|status| status.success()));
        let status = server.process.wait().expect("it ends");
        assert_eq!(status.code(), Some(0));
        let mut rest = String::new();
        server.output.read_to_string(&mut rest).expect("it is text");
        assert_eq!(rest, "", "the address is all that is printed");
    }
}
