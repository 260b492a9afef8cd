//! `starl sweep` gives the same rows on any number of threads and however often it is stopped.

use crate::support::{
    self, command, digest, file, folder, json, names, starl, status, stderr, stdout,
};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Two values of two axes.
const SWEEP: [&str; 6] = [
    "sweep",
    "small.toml",
    "--set",
    "network.loss=0..50%:2",
    "--set",
    "fleet=2,3",
];

/// A folder with the small scenario.
fn prepared(test: &str) -> PathBuf {
    let folder = folder(test);
    file(&folder, "small.toml", support::SMALL);
    folder
}

/// The sweep with more options; four seeds unless these say otherwise.
fn with<'a>(more: &[&'a str]) -> Vec<&'a str> {
    let seeds: &[&str] = match more.contains(&"--seeds") {
        true => &[],
        false => &["--seeds", "4"],
    };
    [&SWEEP[..], seeds, more].concat()
}

/// Runs the sweep to its end and returns its table.
fn table(folder: &Path, out: &str, more: &[&str]) -> Vec<u8> {
    let output = starl(folder, &with(&[&["--out", out, "--quiet"], more].concat()));
    assert_eq!(status(&output), 0, "{}", stderr(&output));
    assert_eq!(stdout(&output), "");
    fs::read(folder.join(out)).expect("the table was written")
}

/// The rows of a table of JSON lines.
fn rows(table: &[u8]) -> Vec<serde_json::Value> {
    let text = std::str::from_utf8(table).expect("JSON is text");
    let rows = text.lines().map(serde_json::from_str);
    rows.collect::<Result<_, _>>().expect("lines of JSON")
}

#[test]
fn tables_are_the_same_on_any_number_of_threads() {
    let folder = prepared("sweep_threads");
    for kind in ["csv", "jsonl", "parquet"] {
        let first = table(&folder, &format!("1.{kind}"), &["--threads", "1"]);
        for threads in ["2", "5"] {
            let other = table(
                &folder,
                &format!("{threads}.{kind}"),
                &["--threads", threads],
            );
            assert!(first == other, "{kind} differs on {threads} threads");
        }
    }
}

#[test]
fn a_row_equals_the_result_of_the_run_command() {
    let folder = prepared("sweep_rows");
    let rows = rows(&table(&folder, "rows.jsonl", &[]));
    assert_eq!(rows.len(), 16);
    for (number, row) in (0..).zip(&rows) {
        assert_eq!(row["number"], number);
        let loss = format!("network.loss={}%", row["network.loss_%"]);
        let fleet = format!("holonomic={}", row["fleet"]);
        let seed = row["seed"].to_string();
        let run = [
            "run",
            "small.toml",
            "--json",
            "--set",
            &loss,
            "--robots",
            &fleet,
            "--seed",
            &seed,
        ];
        let report = json(&starl(&folder, &run));
        assert_eq!(row["digest"], report["digest"]);
        assert_eq!(row["outcome"], report["outcome"]);
        assert_eq!(row["sim_seconds"], report["sim_seconds"]);
        assert_eq!(row["messages_sent"], report["messages"]["sent"]);
        assert_eq!(row["collisions"], report["collisions"]);
        let robots = report["robots"].as_array().expect("robots");
        assert_eq!(row["fleet"], robots.len());
        let distance: f64 = robots
            .iter()
            .filter_map(|robot| robot["distance_m"].as_f64())
            .sum();
        assert_eq!(row["distance_m"].as_f64(), Some(distance));
    }
    let digests: std::collections::BTreeSet<_> =
        rows.iter().map(|row| row["digest"].as_str()).collect();
    assert_eq!(digests.len(), 16, "every run is another one");
}

#[test]
fn seeds_and_combinations_are_numbered_in_a_fixed_order() {
    let folder = prepared("sweep_order");
    let rows = rows(&table(&folder, "rows.jsonl", &["--seeds", "7..8"]));
    let places = rows.iter().map(|row| {
        let field = |name: &str| row[name].as_f64().expect(name);
        (field("network.loss_%"), field("fleet"), field("seed"))
    });
    let expected = [0.0, 50.0].into_iter().flat_map(|loss| {
        let fleets = [2.0, 3.0].into_iter();
        fleets.flat_map(move |fleet| [(loss, fleet, 7.0), (loss, fleet, 8.0)])
    });
    assert!(places.eq(expected), "{rows:?}");
}

/// The rows of a journal, the torn last one left out.
fn journal(path: &Path) -> BTreeMap<u64, serde_json::Value> {
    let text = fs::read_to_string(path).unwrap_or_default();
    let (whole, _) = text.rsplit_once('\n').unwrap_or_default();
    let mut rows = BTreeMap::new();
    for line in whole.lines().skip(1) {
        let row: serde_json::Value = serde_json::from_str(line).expect("a row");
        let number = row["number"].as_u64().expect("a number");
        assert!(
            rows.insert(number, row).is_none(),
            "run {number} is there twice"
        );
    }
    rows
}

/// Starts the sweep, waits until it has added some rows, and does something to it.
#[cfg(unix)]
fn stop(folder: &Path, signal: &str) -> std::process::Output {
    use std::process::{Command, Stdio};
    let path = folder.join("stopped.parquet.journal");
    let before = journal(&path).len();
    let arguments = with(&[
        "--out",
        "stopped.parquet",
        "--seeds",
        "60",
        "--threads",
        "2",
    ]);
    let mut sweep = command(folder, &arguments)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command was built");
    while journal(&path).len() < before + 10 {
        let ended = sweep.try_wait().expect("it can be asked");
        assert!(ended.is_none(), "the sweep ended by itself");
        std::thread::sleep(std::time::Duration::from_millis(2));
    }
    let sent = Command::new("kill")
        .args([signal, &sweep.id().to_string()])
        .status();
    assert!(sent.is_ok_and(|status| status.success()));
    sweep.wait_with_output().expect("it ends")
}

#[cfg(unix)]
#[test]
fn a_killed_sweep_continues_where_it_was() {
    let folder = prepared("sweep_killed");
    let path = folder.join("stopped.parquet.journal");
    let mut known = BTreeMap::new();
    for _ in 0..3 {
        let output = stop(&folder, "-KILL");
        assert_eq!(output.status.code(), None);
        let rows = journal(&path);
        assert!(
            known
                .iter()
                .all(|(number, row)| rows.get(number) == Some(row)),
            "a row was lost"
        );
        known = rows;
        // As if the process had been killed in the middle of a line.
        let mut text = fs::read(&path).expect("the journal");
        text.extend_from_slice(b"{\"number\":3,\"seed\":4,\"outc");
        fs::write(&path, text).expect("the journal can be written");
    }
    let arguments = with(&["--seeds", "60", "--out", "stopped.parquet", "--json"]);
    let output = starl(&folder, &arguments);
    assert_eq!(status(&output), 0, "{}", stderr(&output));
    let report = json(&output);
    assert_eq!(report["runs_done_before"], known.len());
    assert_eq!(report["runs_done"], 240);
    assert_eq!(journal(&path).len(), 240);
    let resumed = fs::read(folder.join("stopped.parquet")).expect("the table");
    assert!(resumed == table(&folder, "whole.parquet", &["--seeds", "60"]));
}

#[cfg(unix)]
#[test]
fn an_interrupted_sweep_says_how_to_continue() {
    let folder = prepared("sweep_interrupted");
    let output = stop(&folder, "-INT");
    assert_eq!(status(&output), 1, "{}", stderr(&output));
    let text = stdout(&output);
    let done = journal(&folder.join("stopped.parquet.journal")).len();
    assert!(
        text.contains(&format!("interrupted after {done} of 240 runs")),
        "{text}"
    );
    let (_, again) = text.split_once("to continue: ").expect("how to continue");
    assert_eq!(names(&folder), ["small.toml", "stopped.parquet.journal"]);
    let words: Vec<&str> = again.split_whitespace().skip(1).collect();
    assert_eq!(status(&starl(&folder, &words)), 0);
    let resumed = fs::read(folder.join("stopped.parquet")).expect("the table");
    assert!(resumed == table(&folder, "whole.parquet", &["--seeds", "60"]));
}

#[test]
fn a_sweep_that_is_done_is_not_repeated() {
    let folder = prepared("sweep_done");
    let first = table(&folder, "rows.csv", &[]);
    fs::remove_file(folder.join("rows.csv")).expect("it is there");
    let arguments = with(&["--out", "rows.csv", "--json"]);
    let report = json(&starl(&folder, &arguments));
    assert_eq!(report["runs_done_before"], 16);
    assert!(first == fs::read(folder.join("rows.csv")).expect("it is there again"));
}

#[test]
fn a_journal_of_another_sweep_is_refused() {
    let folder = prepared("sweep_other");
    table(&folder, "rows.csv", &[]);
    let before = fs::read(folder.join("rows.csv.journal")).expect("the journal");
    let refused = |arguments: &[&str], what: &str| {
        let output = starl(&folder, arguments);
        let message = format!(
            "error: rows.csv.journal: this journal belongs to a sweep that differs in {what}; delete it to start over"
        );
        assert!(stderr(&output).starts_with(&message), "{}", stderr(&output));
        assert_eq!((status(&output), stdout(&output)), (2, String::new()));
    };
    let out = ["--out", "rows.csv"];
    refused(&with(&[&out[..], &["--seeds", "5"]].concat()), "the seeds");
    refused(
        &with(&[&out[..], &["--set", "network.jitter=0ms,1ms"]].concat()),
        "the values of --set",
    );
    refused(
        &with(&[&out[..], &["--profile", "lossy"]].concat()),
        "the profile",
    );
    file(
        &folder,
        "small.toml",
        &support::SMALL.replacen("5mm", "6mm", 1),
    );
    refused(
        &with(&out),
        "the scenario, a program or a fixed value of --set",
    );
    let after = fs::read(folder.join("rows.csv.journal")).expect("the journal");
    assert!(before == after, "the journal was changed");
    fs::write(folder.join("rows.csv.journal"), "my notes\n").expect("it can be written");
    let output = starl(&folder, &with(&out));
    assert_eq!(status(&output), 2);
    assert!(
        stderr(&output).contains("is not the journal of a sweep"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn a_damaged_row_is_named() {
    let folder = prepared("sweep_damaged");
    table(&folder, "rows.csv", &[]);
    let path = folder.join("rows.csv.journal");
    let text = fs::read_to_string(&path).expect("the journal");
    fs::write(&path, text.replacen("\"seed\":3", "\"seed\":9", 1)).expect("it can be written");
    let output = starl(&folder, &with(&["--out", "rows.csv"]));
    assert_eq!(status(&output), 2);
    assert!(
        stderr(&output).contains("is damaged; delete that line"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn faults_of_a_profile_are_drawn_from_the_seed() {
    let folder = prepared("sweep_profile");
    let digests = |table: &[u8]| -> Vec<String> {
        rows(table)
            .iter()
            .map(|row| row["digest"].to_string())
            .collect()
    };
    let calm = digests(&table(&folder, "calm.jsonl", &[]));
    let chaos = table(
        &folder,
        "chaos.jsonl",
        &["--profile", "chaos", "--threads", "1"],
    );
    let again = table(
        &folder,
        "again.jsonl",
        &["--profile", "chaos", "--threads", "4"],
    );
    assert!(chaos == again);
    let differ = calm
        .iter()
        .zip(digests(&chaos))
        .filter(|(calm, chaos)| *calm != chaos);
    assert!(differ.count() >= 8, "half of the runs have faults");
    assert_eq!(rows(&chaos)[0]["profile"], "chaos");
}

#[test]
fn programs_and_their_parameters_are_axes() {
    let folder = folder("sweep_programs");
    let program = "program Waiter\n\nparam pause: Int in 1..9\n\nwait()\n    pre true for 1s * pause\n    eff finish()\n";
    file(&folder, "waiter.starl", program);
    file(
        &folder,
        "twice.starl",
        &program.replace("Waiter", "Twice").replace("1s", "2s"),
    );
    let scenario = support::SMALL.replacen("\"race\"", "\"waiter.starl\"", 1);
    file(&folder, "small.toml", &scenario);
    let output = starl(
        &folder,
        &[
            "sweep",
            "small.toml",
            "--set",
            "program=waiter.starl,twice.starl",
            "--set",
            "parameters.pause=1..3:2",
            "--seeds",
            "1",
            "--out",
            "rows.jsonl",
        ],
    );
    assert_eq!(status(&output), 0, "{}", stderr(&output));
    let rows = rows(&fs::read(folder.join("rows.jsonl")).expect("the table"));
    let times = rows.iter().map(|row| {
        row["time_to_goal_seconds"]
            .as_f64()
            .expect("reached")
            .round()
    });
    assert_eq!(times.collect::<Vec<_>>(), [1.0, 3.0, 2.0, 6.0]);
    assert_eq!(rows[2]["program"], "twice.starl");
}

#[test]
fn the_first_run_that_violates_a_property_is_named_with_the_command_that_repeats_it() {
    let folder = folder("sweep_violation");
    let program = "program Waiter\n\nparam pause: Int in 1..9\n\nwait()\n    pre true for 1s * pause\n    eff finish()\n\neventually soon: forall r: r.finished within 2s\n";
    file(&folder, "waiter.starl", program);
    let scenario = support::SMALL.replacen("\"race\"", "\"waiter.starl\"", 1);
    file(&folder, "small.toml", &scenario);
    let sweep = [
        "sweep",
        "small.toml",
        "--set",
        "parameters.pause=1..3:2",
        "--set",
        "fleet=2,3",
        "--set",
        "network.loss=10%",
        "--seeds",
        "7..8",
        "--out",
        "rows.jsonl",
    ];
    for profile in [&[][..], &["--profile", "lossy"]] {
        let report = json(&starl(
            &folder,
            &[&sweep[..], profile, &["--json"]].concat(),
        ));
        let failures = report["failures"].as_array().expect("a list");
        assert_eq!(failures.len(), 1, "{failures:?}");
        let failure = &failures[0];
        assert_eq!(failure["violated"], serde_json::json!(["Waiter.soon"]));
        assert_eq!(
            (&failure["number"], &failure["seed"]),
            (&4.into(), &7.into())
        );
        let replay = failure["replay"].as_str().expect("a text");
        let words: Vec<&str> = replay.split(' ').skip(1).chain(["--json"]).collect();
        let again = json(&starl(&folder, &words));
        let rows = rows(&fs::read(folder.join("rows.jsonl")).expect("it was written"));
        match profile.is_empty() {
            true => assert_eq!(again["digest"], rows[4]["digest"], "{replay}"),
            false => assert_eq!(again["targets"][0]["profiles"][0]["violated"], 1, "{again}"),
        }
        fs::remove_file(folder.join("rows.jsonl")).expect("it was there");
        fs::remove_file(folder.join("rows.jsonl.journal")).expect("it was there");
    }
}

#[test]
fn the_plot_has_axes_and_a_line_for_each_value_of_the_second_axis() {
    let folder = prepared("sweep_plot");
    let arguments = with(&["--plot", "plot.svg", "--metric", "messages_sent,goal"]);
    let output = starl(&folder, &arguments);
    assert_eq!(status(&output), 0, "{}", stderr(&output));
    let plot = fs::read_to_string(folder.join("plot.svg")).expect("the plot");
    for text in [
        "messages sent",
        "network.loss in %",
        "fleet = 3",
        "fleet = 2",
        "95 % intervals",
    ] {
        assert!(
            plot.contains(&format!("{text}</text>")),
            "no {text:?} in the plot"
        );
    }
    assert_eq!(
        plot.matches("fill-opacity").count(),
        2,
        "a band for each line"
    );
    let header = stdout(&output);
    assert!(
        header.contains("network.loss  fleet  runs  messages_sent"),
        "{header}"
    );
}

#[test]
fn the_summary_has_the_mean_and_the_share_with_their_intervals() {
    let folder = prepared("sweep_summary");
    let rows = rows(&table(&folder, "rows.jsonl", &[]));
    let report = json(&starl(&folder, &with(&["--out", "rows.jsonl", "--json"])));
    let combinations = report["combinations"].as_array().expect("combinations");
    assert_eq!(combinations.len(), 4);
    for (combination, rows) in combinations.iter().zip(rows.chunks(4)) {
        let sent: f64 = rows
            .iter()
            .filter_map(|row| row["messages_sent"].as_f64())
            .sum();
        let mean = &combination["metrics"]["messages_sent"];
        assert_eq!(mean["estimate"].as_f64(), Some(sent / 4.0));
        assert!(mean["low"].as_f64() <= Some(sent / 4.0));
        let reached = rows
            .iter()
            .filter(|row| row["goal_reached"] == true)
            .count();
        assert_eq!(combination["reached"], reached);
        assert_eq!(combination["values"]["fleet"], rows[0]["fleet"].to_string());
    }
}

#[test]
fn bad_input_is_refused_with_one_message() {
    let folder = prepared("sweep_bad");
    let cases: [(&[&str], &str); 15] = [
        (
            &["--set", "network.loss=0..1.5:4"],
            "error: --set network.loss: 1.5 is not a probability",
        ),
        (
            &["--set", "network.lost=0,1"],
            "error: --set network.lost: there is no such field; did you mean `loss`?",
        ),
        (
            &["--set", "network.delay=1,2"],
            "error: --set network.delay: 1 has no unit",
        ),
        (
            &["--set", "network.delay=1ms..2m:2"],
            "error: --set network.delay: the ends of",
        ),
        (
            &["--set", "fleet=2,many"],
            "error: --set fleet: many is not a number of robots",
        ),
        (
            &["--set", "fleet=2,3", "--robots", "create=2"],
            "error: --set fleet: it contradicts --robots",
        ),
        (
            &["--set", "fleet=2", "--set", "robots.0.count=3"],
            "error: --set fleet: it contradicts robots.0.count",
        ),
        (
            &["--set", "duration=9s,10s", "--duration", "3s"],
            "error: --set duration: it contradicts --duration",
        ),
        (
            &["--set", "network.loss=0,1", "--set", "network.loss=0,1"],
            "error: --set network.loss: this axis is given twice",
        ),
        (
            &["--set", "seed=1,2"],
            "error: --set seed: the seed cannot be an axis",
        ),
        (&["--seeds", "0"], "error: --seeds 0: these are not seeds"),
        (
            &["--profile", "lossi"],
            "error: --profile lossi: there is no such profile; did you mean `lossy`?",
        ),
        (
            &["--metric", "distance"],
            "error: --metric distance: there is no such metric; did you mean `distance_m`?",
        ),
        (
            &["--out", "rows.xlsx"],
            "error: --out rows.xlsx: the name must end in .parquet, .csv or .jsonl",
        ),
        (
            &["--plot", "plot.svg"],
            "error: --plot: there is no axis to draw against",
        ),
    ];
    for (more, message) in cases {
        let output = starl(&folder, &[&["sweep", "small.toml"], more].concat());
        let text = stderr(&output);
        assert!(text.starts_with(message), "{more:?}: {text}");
        assert_eq!(text.lines().count(), 1, "{text}");
        assert_eq!(
            (status(&output), stdout(&output)),
            (2, String::new()),
            "{more:?}"
        );
    }
    assert_eq!(names(&folder), ["small.toml"]);
}

#[test]
fn the_scenario_is_not_overwritten() {
    let folder = prepared("sweep_overwrite");
    fs::rename(folder.join("small.toml"), folder.join("small.csv")).expect("it is there");
    let output = starl(&folder, &["sweep", "small.csv", "--out", "small.csv"]);
    assert_eq!(status(&output), 2);
    assert!(
        stderr(&output).contains("the run reads this file"),
        "{}",
        stderr(&output)
    );
}

#[cfg(unix)]
#[test]
fn two_sweeps_do_not_write_to_one_journal() {
    let folder = prepared("sweep_two");
    let path = folder.join("rows.csv.journal");
    let arguments = with(&["--out", "rows.csv", "--seeds", "100000"]);
    let mut first = command(&folder, &arguments)
        .spawn()
        .expect("the command was built");
    while journal(&path).is_empty() {
        assert!(
            first.try_wait().expect("it can be asked").is_none(),
            "it ended by itself"
        );
        std::thread::sleep(std::time::Duration::from_millis(2));
    }
    let second = starl(&folder, &arguments);
    first.kill().expect("it runs");
    first.wait().expect("it ends");
    assert_eq!(status(&second), 2);
    assert!(
        stderr(&second).contains("another sweep is writing this journal"),
        "{}",
        stderr(&second)
    );
}

#[test]
fn a_single_value_sets_a_field() {
    let folder = prepared("sweep_fixed");
    let out = [
        "--set",
        "network.loss=50%",
        "--seeds",
        "3..3",
        "--out",
        "rows.jsonl",
    ];
    let output = starl(&folder, &[&["sweep", "small.toml"], &out[..]].concat());
    assert_eq!(status(&output), 0, "{}", stderr(&output));
    let rows = rows(&fs::read(folder.join("rows.jsonl")).expect("the table"));
    assert_eq!(rows.len(), 1);
    let run = ["small.toml", "--set", "network.loss=50%", "--seed", "3"];
    assert_eq!(rows[0]["digest"], digest(&folder, &run).as_str());
}
