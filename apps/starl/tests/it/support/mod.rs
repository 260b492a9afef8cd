//! Runs the built command as a user would.

use std::collections::BTreeMap;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::{Mutex, PoisonError};
use std::thread;

/// Two robots without obstacles; the run ends within a few simulated seconds.
pub const SMALL: &str = r#"
program = "race"
duration = "30s"

[world]
way_point = [
    { name = "A", position = [2, 0] },
    { name = "B", position = [2, 2] },
]

[[robots]]
model = "holonomic"
count = 2
start = [{ position = [0, 0] }, { position = [0, 1] }]

[positioning]
position_noise = "5mm"

[network]
loss = "20%"
"#;

/// A folder of the test's own, empty at first. Tests run at the same time, so that two may not have one folder.
pub fn folder(test: &str) -> PathBuf {
    static OWNERS: Mutex<BTreeMap<String, Option<String>>> = Mutex::new(BTreeMap::new());
    let me = thread::current().name().map(str::to_string);
    let mut owners = OWNERS.lock().unwrap_or_else(PoisonError::into_inner);
    let owner = owners.entry(test.to_string()).or_insert_with(|| me.clone());
    assert_eq!(*owner, me, "both have the folder {test}");
    drop(owners);
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("the test's folder can be made");
    folder
}

/// A file in a folder.
pub fn file(folder: &Path, name: &str, content: &str) -> PathBuf {
    let path = folder.join(name);
    fs::write(&path, content).expect("the test's folder can be written to");
    path
}

/// The command with these arguments, to be run in `folder`.
pub fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_starl"));
    command.current_dir(folder).args(arguments);
    command
}

/// Runs the command in a folder.
pub fn starl(folder: &Path, arguments: &[&str]) -> Output {
    command(folder, arguments)
        .output()
        .expect("the command was built")
}

/// Runs the command in a folder with a text on its standard input.
pub fn starl_reading(folder: &Path, arguments: &[&str], input: &str) -> Output {
    let mut child = command(folder, arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command was built");
    let mut stdin = child.stdin.take().expect("it is piped");
    stdin.write_all(input.as_bytes()).expect("it is read");
    drop(stdin);
    child.wait_with_output().expect("it ends")
}

/// Its exit status.
pub fn status(output: &Output) -> i32 {
    output.status.code().expect("the command was not killed")
}

/// Its standard output.
pub fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).expect("the output is text")
}

/// Its error stream.
pub fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).expect("the messages are text")
}

/// The one JSON object that it wrote to standard output.
pub fn json(output: &Output) -> serde_json::Value {
    serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|error| panic!("{error} in {}\n{}", stdout(output), stderr(output)))
}

/// The digest of a run with these arguments.
pub fn digest(folder: &Path, arguments: &[&str]) -> String {
    let mut all = vec!["run"];
    all.extend_from_slice(arguments);
    all.push("--json");
    json(&starl(folder, &all))["digest"]
        .as_str()
        .expect("a digest is a text")
        .to_string()
}

/// The names of the files in a folder.
pub fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .expect("the folder is there")
        .map(|entry| {
            entry
                .expect("it can be read")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    names.sort();
    names
}
