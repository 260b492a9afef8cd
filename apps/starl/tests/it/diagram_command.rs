//! `starl diagram` draws a run, and the trace of it in the same way.

use crate::support::{self, file, folder, starl, status, stderr, stdout};
use std::fs;

#[test]
fn a_run_and_its_trace_are_drawn_alike() {
    let folder = folder("diagram_alike");
    file(&folder, "small.toml", support::SMALL);
    let output = starl(
        &folder,
        &["diagram", "small.toml", "--out", "run.svg", "--seed", "3"],
    );
    assert_eq!(status(&output), 0, "{}", stderr(&output));
    assert_eq!(stdout(&output), "run.svg\n");
    let run = [
        "run",
        "small.toml",
        "--seed",
        "3",
        "--trace",
        "run.mcap",
        "--quiet",
    ];
    assert_eq!(status(&starl(&folder, &run)), 0);
    let output = starl(&folder, &["diagram", "run.mcap", "--out", "trace.svg"]);
    assert_eq!(status(&output), 0, "{}", stderr(&output));
    let read = |name| fs::read_to_string(folder.join(name)).expect("it was drawn");
    assert_eq!(read("run.svg"), read("trace.svg"));
    assert!(read("run.svg").contains(">holonomic0<"));
    assert!(read("run.svg").contains(">finished<"));
}

#[test]
fn a_part_of_a_run_can_be_drawn_as_png() {
    let folder = folder("diagram_part");
    file(&folder, "small.toml", support::SMALL);
    let arguments = [
        "diagram",
        "small.toml",
        "--out",
        "part.png",
        "--until",
        "2s",
        "--last",
        "500ms",
    ];
    let output = starl(&folder, &arguments);
    assert_eq!(status(&output), 0, "{}", stderr(&output));
    let bytes = fs::read(folder.join("part.png")).expect("it was drawn");
    assert!(bytes.starts_with(b"\x89PNG"));
}

#[test]
fn bad_input_is_reported() {
    let folder = folder("diagram_bad_input");
    file(&folder, "small.toml", support::SMALL);
    let recorded = ["run", "small.toml", "--quiet", "--trace", "run.mcap"];
    assert_eq!(status(&starl(&folder, &recorded)), 0);
    let cases: [(&[&str], &str); 5] = [
        (
            &[
                "diagram",
                "run.mcap",
                "--out",
                "a.svg",
                "--set",
                "network.los=7",
            ],
            "is drawn as it was recorded",
        ),
        (&["run", "run.mcap"], "is a trace"),
        (
            &["diagram", "small.toml", "--out", "run.jpg"],
            "the name must end in .svg or .png",
        ),
        (
            &["diagram", "small.toml", "--out", "a.svg", "--last", "5"],
            "is not a time",
        ),
        (
            &["diagram", "none.mcap", "--out", "a.svg"],
            "there is no such file",
        ),
    ];
    for (arguments, told) in cases {
        let output = starl(&folder, arguments);
        assert_eq!(status(&output), 2, "{arguments:?}");
        assert!(stderr(&output).contains(told), "{}", stderr(&output));
    }
    assert!(!folder.join("a.svg").exists());
}
