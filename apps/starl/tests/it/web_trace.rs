//! `starl view` serves a trace in parts, and rejects other files.

use crate::support::*;
use crate::web_support::*;
use std::fs;

#[test]
fn a_trace_is_served_whole_and_in_parts() {
    let folder = folder("view_parts");
    file(&folder, "small.toml", SMALL);
    let recorded = starl(
        &folder,
        &["run", "small.toml", "--quiet", "--trace", "a.mcap"],
    );
    assert_eq!(status(&recorded), 0, "{}", stderr(&recorded));
    let trace = fs::read(folder.join("a.mcap")).expect("it was written");
    let size = trace.len();
    // More than the server reads at once.
    assert!(size > 200_000, "{size}");
    let server = Server::start(&folder, &["view", "a.mcap"]);
    let start = server.get("/start.json", &[]).json();
    let expected = serde_json::json!({ "mode": "trace", "name": "a.mcap", "size": size });
    assert_eq!(start, expected);

    let whole = server.get("/trace", &[]);
    assert_eq!((whole.status, whole.body == trace), (200, true));
    assert_eq!(whole.headers["accept-ranges"], "bytes");
    assert_eq!(whole.headers["content-length"], size.to_string());

    let part = |range: &str, from: usize, to: usize| {
        let response = server.get("/trace", &[("range", range)]);
        assert_eq!(response.status, 206, "{range}");
        assert!(response.body == trace[from..to], "{range}");
        let place = format!("bytes {from}-{}/{size}", to - 1);
        assert_eq!(response.headers["content-range"], place);
        assert_eq!(response.headers["content-length"], (to - from).to_string());
    };
    part("bytes=0-7", 0, 8);
    part("bytes=1000-180000", 1000, 180_001);
    part("bytes=-100", size - 100, size);
    part("bytes=5-", 5, size);

    let beyond = server.get("/trace", &[("range", &format!("bytes={size}-"))]);
    assert_eq!(beyond.status, 416);
    assert_eq!(beyond.headers["content-range"], format!("bytes */{size}"));
    assert_eq!(server.get("/engine", &[]).status, 400, "it is no WebSocket");
}

#[test]
fn a_trace_that_is_cut_short_can_be_viewed() {
    let folder = folder("view_cut");
    file(&folder, "small.toml", SMALL);
    starl(
        &folder,
        &["run", "small.toml", "--quiet", "--trace", "a.mcap"],
    );
    let trace = fs::read(folder.join("a.mcap")).expect("it was written");
    fs::write(folder.join("cut.mcap"), &trace[..trace.len() / 2]).expect("it can be written");
    let server = Server::start(&folder, &["view", "cut.mcap"]);
    let start = server.get("/start.json", &[]).json();
    assert_eq!(start["size"], trace.len() / 2);
    fs::remove_file(folder.join("cut.mcap")).expect("it is there");
    for path in ["/start.json", "/trace"] {
        let gone = server.get(path, &[]);
        assert_eq!(gone.status, 500);
        assert!(
            gone.text()
                .contains("cut.mcap: cannot be read: there is no such file")
        );
    }
}

#[test]
fn a_file_that_is_not_a_trace_is_refused() {
    let folder = folder("view_bad");
    page(&folder);
    file(&folder, "notes.mcap", "Dear diary");
    let cases: [(&str, &[&str]); 3] = [
        ("notes.mcap", &["notes.mcap"]),
        ("none.mcap", &["none.mcap", "no such file"]),
        ("page", &["page", "is a folder"]),
    ];
    for (name, expected) in cases {
        let output = starl(&folder, &["view", name, "--no-browser", "--page", "page"]);
        let text = stderr(&output);
        assert_eq!(
            (status(&output), stdout(&output)),
            (2, String::new()),
            "{text}"
        );
        assert!(text.starts_with("error: "), "{text}");
        for part in expected {
            assert!(text.contains(part), "{part}: {text}");
        }
    }
}
