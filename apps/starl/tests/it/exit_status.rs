//! The exit status shows scripts the result of a run: 0 the goal was reached, 1 it was not.

use crate::support::*;

#[test]
fn a_run_that_reaches_its_goal_succeeds() {
    let folder = folder("exit_reached");
    file(&folder, "small.toml", SMALL);
    let output = starl(&folder, &["run", "small.toml"]);
    assert_eq!(status(&output), 0, "{}{}", stdout(&output), stderr(&output));
    assert!(
        stdout(&output).contains("goal reached"),
        "{}",
        stdout(&output)
    );
    assert_eq!(
        stderr(&output),
        "",
        "without a terminal there is no progress bar"
    );
}

#[test]
fn a_run_that_times_out_does_not() {
    let folder = folder("exit_timed_out");
    file(&folder, "small.toml", SMALL);
    let output = starl(&folder, &["run", "small.toml", "--duration", "1s"]);
    assert_eq!(status(&output), 1);
    assert!(
        stdout(&output).contains("goal not reached within 1.0 s; 0 of 2 robots"),
        "{}",
        stdout(&output)
    );
}

#[test]
fn a_violation_fails_the_run_and_says_how_to_see_it_again() {
    let folder = folder("exit_violated");
    // Nothing is broadcast and delivered within a nanosecond.
    file(&folder, "small.toml", SMALL);
    let arguments = [
        "run",
        "small.toml",
        "--set",
        "properties.broadcast_bound=1ns",
        "--seed",
        "7",
    ];
    let output = starl(&folder, &arguments);
    assert_eq!(status(&output), 1, "{}", stdout(&output));
    let text = stdout(&output);
    for expected in [
        "violated: broadcast.delivery at ",
        " by holonomic",
        "starl run small.toml --seed 7 --set properties.broadcast_bound=1ns",
    ] {
        assert!(text.contains(expected), "no {expected:?} in {text}");
    }
}

#[test]
fn quiet_prints_nothing_of_a_good_run() {
    let folder = folder("exit_quiet");
    file(&folder, "small.toml", SMALL);
    let output = starl(&folder, &["run", "small.toml", "--quiet"]);
    assert_eq!(
        (status(&output), stdout(&output), stderr(&output)),
        (0, String::new(), String::new())
    );
}

#[test]
fn the_summary_fits_80_columns() {
    let folder = folder("exit_columns");
    for robots in ["create=2,drone=2", "create=20"] {
        let output = starl(
            &folder,
            &["run", "race", "--robots", robots, "--duration", "2s"],
        );
        assert!(
            stdout(&output).contains("waypoints"),
            "{}{}",
            stdout(&output),
            stderr(&output)
        );
        for line in stdout(&output).lines() {
            assert!(line.chars().count() <= 80, "{line}");
        }
    }
}

#[test]
fn race_runs_in_any_folder() {
    let folder = folder("exit_race");
    let output = starl(&folder, &["run", "race", "--json"]);
    let report = json(&output);
    assert_ne!(report["outcome"], "failed", "{report}");
    assert_eq!(report["progress"]["finished"], 4, "{report}");
    assert!(
        names(&folder).is_empty(),
        "nothing is written that was not asked for"
    );
}
