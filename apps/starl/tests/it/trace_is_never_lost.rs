//! However a run ends, its trace exists under its final name, and its written part is readable.

#![cfg(unix)]

use crate::support::{SMALL, command, file, folder, names, starl, status, stderr, stdout};
use starl_trace::Reader;
use std::fs::File;
use std::path::Path;
use std::process::{Command, Stdio};

/// A run that would take days and in which hardly anything happens.
const QUIET: &str = r#"
program = "race"
duration = "100000000s"
goal = "duration"

[world]
way_point = [{ name = "A", position = [2, 0] }]

[[robots]]
model = "holonomic"
count = 2
start = [{ position = [0, 0] }, { position = [0, 1] }]
control_period = "100s"

[positioning]
period = "100s"

[trace]
pose_period = "100s"
"#;

/// Both ways to replay `a.mcap` go as far as it goes; gives what the first says.
fn replayed(folder: &Path) -> String {
    let whole = starl(folder, &["replay", "a.mcap"]);
    let robot = starl(folder, &["replay", "a.mcap", "--robot", "holonomic0"]);
    for output in [&whole, &robot] {
        let text = stdout(output);
        assert_eq!(
            (status(output), stderr(output)),
            (0, String::new()),
            "{text}"
        );
        assert!(
            text.contains("identical as far as the trace goes: "),
            "{text}"
        );
        assert!(text.contains("the trace is truncated"), "{text}");
        assert!(!text.contains("before the first record"), "{text}");
    }
    stdout(&whole)
}

/// Kills a run once its trace has records.
fn kill(test: &str, scenario: &str) {
    let folder = folder(test);
    file(&folder, "endless.toml", scenario);
    let arguments = [
        "run",
        "endless.toml",
        "--quiet",
        "--inputs",
        "--trace",
        "a.mcap",
    ];
    let mut run = command(&folder, &arguments)
        .stdout(Stdio::null())
        .spawn()
        .expect("the command was built");
    let has_records = || {
        let reader = File::open(folder.join("a.mcap")).ok().map(Reader::new);
        reader.is_some_and(|reader| {
            reader.is_ok_and(|mut reader| matches!(reader.next(), Some(Ok(_))))
        })
    };
    while !has_records() {
        assert!(
            run.try_wait().expect("it can be asked").is_none(),
            "the run ended by itself"
        );
        std::thread::yield_now();
    }
    run.kill().expect("it runs");
    run.wait().expect("it ends");
    assert_eq!(names(&folder), ["a.mcap", "endless.toml"]);
    replayed(&folder);
}

#[test]
fn a_run_that_is_killed() {
    kill(
        "killed",
        &SMALL.replacen("\"30s\"", "\"1000000s\"\ngoal = \"duration\"", 1),
    );
}

/// A chunk would be full after hours.
#[test]
fn a_run_that_is_killed_before_a_chunk_is_full() {
    kill("killed_early", QUIET);
}

/// A limit on the size of files stands for a disk that is full: the shell has the signal ignored that would
/// end the process, so that writing fails.
#[test]
fn a_disk_that_is_full() {
    let folder = folder("disk_full");
    file(
        &folder,
        "endless.toml",
        &SMALL.replacen("\"30s\"", "\"1000000s\"\ngoal = \"duration\"", 1),
    );
    let script = format!(
        "trap '' XFSZ; ulimit -f 4000; exec {} run endless.toml --quiet --inputs --trace a.mcap",
        env!("CARGO_BIN_EXE_starl")
    );
    let output = Command::new("sh")
        .args(["-c", &script])
        .current_dir(&folder)
        .output()
        .expect("there is a shell");
    let text = stderr(&output);
    assert_eq!(status(&output), 2, "{text}");
    assert!(
        text.starts_with("error: a.mcap: the trace cannot be written: "),
        "{text}"
    );
    assert!(text.contains("kept in it"), "{text}");
    assert_eq!(names(&folder), ["a.mcap", "endless.toml"]);
    let told = replayed(&folder);
    // As much as there was room for, but for less than what a message takes.
    let size = folder.join("a.mcap").metadata().expect("it is there").len();
    let limit = [4_000 * 512, 4_000 * 1024]
        .into_iter()
        .find(|limit| size <= *limit);
    let limit = limit.expect("it is within the limit");
    assert!(limit - size < 10_000, "{size} of {limit}: {told}");
}

#[cfg(target_os = "linux")]
#[test]
fn an_unwritable_place_is_reported() {
    let folder = folder("disk_full_device");
    let output = starl(&folder, &["run", "race", "--quiet", "--trace", "/dev/full"]);
    assert_eq!(status(&output), 2);
    assert!(
        stderr(&output).contains("/dev/full: the trace cannot be written: "),
        "{}",
        stderr(&output)
    );
}

/// The trace does not depend on how long the run takes: what is saved on the way is overwritten.
#[test]
fn a_trace_that_was_saved_on_the_way_is_the_same() {
    let folder = folder("saved_on_the_way");
    let scenario = SMALL.replacen("\"30s\"", "\"600s\"\ngoal = \"duration\"", 1);
    file(&folder, "long.toml", &scenario);
    let arguments = ["run", "long.toml", "--quiet", "--inputs", "--trace"];
    let start = |trace: &str| {
        let mut command = command(&folder, &[&arguments[..], &[trace]].concat());
        command.spawn().expect("the command was built")
    };
    let mut run = start("a.mcap");
    while !folder
        .join("a.mcap")
        .metadata()
        .is_ok_and(|file| file.len() > 2_000_000)
    {
        std::thread::yield_now();
    }
    let signal = |signal: &str| {
        let sent = Command::new("kill")
            .args([signal, &run.id().to_string()])
            .status();
        assert!(sent.is_ok_and(|status| status.success()));
    };
    // It saves when it finds that a second has passed.
    signal("-STOP");
    std::thread::sleep(std::time::Duration::from_millis(1_100));
    signal("-CONT");
    assert!(
        run.try_wait().expect("it can be asked").is_none(),
        "it had ended before"
    );
    for mut run in [run, start("b.mcap")] {
        assert!(run.wait().expect("it ends").code().is_some());
    }
    let [a, b] =
        ["a.mcap", "b.mcap"].map(|name| std::fs::read(folder.join(name)).expect("it is there"));
    assert!(a == b, "the traces differ");
    assert_eq!(status(&starl(&folder, &["replay", "a.mcap"])), 0);
}

/// The limit's signal ended the process, with half a chunk in the file that nothing could read.
#[test]
fn beyond_the_limit_of_file_sizes_the_beginning_is_kept() {
    let folder = folder("size_limit");
    for kibibytes in [100, 1000] {
        // The shell counts in blocks of 512 bytes.
        let run = format!(
            "ulimit -f {}; exec {} run race --robots create=12 --seed 3 --quiet --trace a.mcap",
            2 * kibibytes,
            env!("CARGO_BIN_EXE_starl")
        );
        let output = Command::new("sh")
            .current_dir(&folder)
            .args(["-c", &run])
            .output();
        let output = output.expect("there is a shell");
        assert_eq!(status(&output), 2, "{}", stderr(&output));
        assert!(stderr(&output).contains("a.mcap: the trace cannot be written"));
        let replayed = stdout(&starl(&folder, &["replay", "a.mcap"]));
        assert!(
            replayed.contains("identical as far as the trace goes: "),
            "{replayed}"
        );
        assert!(!replayed.contains("before the first record"), "{replayed}");
    }
}
