//! The how-to page about a crate of your own shows this crate, and is true.

use std::path::Path;
use std::process::{Command, Output};

fn file(path: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn start(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_own-crate"));
    command
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"));
    command.output().expect("it starts")
}

#[test]
fn the_page_shows_this_crate() {
    let page = file("../../docs/how-to/own-crate.md");
    // The page's crate lies beside the repository, this one in it.
    let manifest = file("Cargo.toml").replace("\"../../", "\"../starl/");
    let blocks = [
        ("toml", manifest),
        ("rust", file("src/main.rs")),
        ("toml", file("patrol.toml")),
    ];
    for (language, content) in blocks {
        let block = format!("```{language}\n{content}```\n");
        assert!(page.contains(&block), "the page lacks:\n{block}");
    }
}

#[test]
fn the_program_runs_by_its_name() {
    let output = start(&["run", "patrol.toml"]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.starts_with("Patrol: goal reached"), "{text}");
    let listed = String::from_utf8(start(&["list"]).stdout).unwrap();
    for name in ["patrol", "race"] {
        let is_it = |line: &str| line.split_whitespace().next() == Some(name);
        assert!(listed.lines().any(is_it), "{name}: {listed}");
    }
}

#[test]
fn its_parameters_are_checked() {
    let page = file("../../docs/how-to/own-crate.md");
    for wrong in ["parameters.stop=3", "parameters.stops=-1"] {
        let output = start(&["run", "patrol.toml", "--set", wrong]);
        assert_eq!(output.status.code(), Some(2));
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(page.contains(&message), "the page lacks: {message}");
    }
}

#[test]
fn its_traces_are_replayed_and_its_failures_found() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let trace = folder.join("patrol.mcap");
    let trace = trace.to_str().expect("a path in UTF-8");
    assert!(
        start(&["run", "patrol.toml", "--trace", trace])
            .status
            .success()
    );
    assert!(start(&["replay", trace]).status.success());
    let out = folder.to_str().expect("a path in UTF-8");
    let test = [
        "test",
        "patrol.toml",
        "--profile",
        "calm",
        "--seeds",
        "2",
        "--out",
        out,
    ];
    assert!(start(&test).status.success());
}
