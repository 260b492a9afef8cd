//! Every bad input gets one clear message that names it, exit status 2, and no standard output.

use crate::support::*;
use std::path::Path;

fn refused(folder: &Path, arguments: &[&str], expected: &[&str]) {
    let output = starl(folder, arguments);
    let text = stderr(&output);
    assert_eq!(
        (status(&output), stdout(&output)),
        (2, String::new()),
        "{arguments:?}: {text}"
    );
    assert!(text.starts_with("error: "), "{arguments:?}: {text}");
    assert!(!text.contains("panicked"), "{text}");
    for part in expected {
        assert!(
            text.contains(part),
            "no {part:?} in the message on {arguments:?}: {text}"
        );
    }
}

/// A change of the small scenario, and what the message names.
const SCENARIOS: [(&str, &str, &[&str]); 14] = [
    (
        "[network]\nloss",
        "[network]\nlos",
        &["bad.toml:20", "network.los", "loss"],
    ),
    (
        "\"20%\"",
        "1.5",
        &["bad.toml:20", "network.loss", "probability"],
    ),
    ("\"20%\"", "nan", &["bad.toml:20", "network.loss"]),
    ("\"30s\"", "30", &["bad.toml:3", "duration", "unit"]),
    ("\"30s\"", "\"30m\"", &["bad.toml:3", "duration"]),
    (
        "\"5mm\"",
        "\"-5mm\"",
        &["bad.toml:17", "positioning.position_noise", "negative"],
    ),
    (
        "count = 2",
        "count = \"two\"",
        &["bad.toml:13", "robots.0.count"],
    ),
    ("[0, 1]", "[0, 0.1]", &["bad.toml:14", "overlap"]),
    (
        "[0, 1]",
        "[0, nan]",
        &["bad.toml:14", "robots.0.start.1.position"],
    ),
    (
        "\"race\"",
        "\"rice\"",
        &["bad.toml:2", "program", "rice", "race"],
    ),
    (
        "\"holonomic\"",
        "\"holonomc\"",
        &["bad.toml:12", "robots.0.model", "holonomic"],
    ),
    ("name = \"B\"", "name = \"A\"", &["bad.toml:8", "A"]),
    ("[[robots]]", "[[robots]", &["bad.toml:11"]),
    (
        "count = 2",
        "count = 2\nparameters = { vicinty = \"1m\" }",
        &["bad.toml:14", "vicinty", "vicinity,"],
    ),
];

#[test]
fn a_bad_scenario_is_refused_with_line_and_field() {
    let folder = folder("bad_scenario");
    for (from, to, expected) in SCENARIOS {
        assert!(SMALL.contains(from), "{from}");
        file(&folder, "bad.toml", &SMALL.replacen(from, to, 1));
        refused(&folder, &["run", "bad.toml"], expected);
    }
}

#[test]
fn impossible_worlds_are_refused() {
    let folder = folder("bad_world");
    let obstacle = |shape: &str| format!("{SMALL}\n[[world.obstacle]]\n{shape}\n");
    let cases: [(&str, &[&str]); 5] = [
        (
            "circle = { center = [5, 5], radius = \"-1m\" }",
            &["bad.toml:23", "radius", "above zero"],
        ),
        (
            "circle = { center = [5, 5], radius = 1 }",
            &["bad.toml:23", "radius", "unit"],
        ),
        (
            "circle = { center = [0, 0], radius = \"0.5m\" }",
            &["bad.toml:14", "robots.0.start.0.position", "obstacle"],
        ),
        (
            "circle = { center = [2, 2], radius = \"0.3m\" }",
            &["bad.toml:8", "B"],
        ),
        ("circle = { center = [9, 9] }", &["bad.toml:23", "radius"]),
    ];
    for (shape, expected) in cases {
        // The table of waypoints stands inside `world`, so that one more can be added to it.
        file(&folder, "bad.toml", &obstacle(shape));
        refused(&folder, &["run", "bad.toml"], expected);
    }
}

#[test]
fn bad_options_are_refused() {
    let folder = folder("bad_options");
    file(&folder, "small.toml", SMALL);
    file(
        &folder,
        "faults.toml",
        "[[fault]]\nat = \"2s\"\nkind = \"crush\"\nrobots = [\"holonomic0\"]\n",
    );
    let cases: [(&[&str], &[&str]); 20] = [
        (&["--set", "network.loss"], &["--set network.loss", "value"]),
        (
            &["--set", "network.lost=0.1"],
            &["--set network.lost", "loss"],
        ),
        (
            &["--set", "network.loss=2"],
            &["--set network.loss", "probability"],
        ),
        (&["--seed", "-1"], &["--seed"]),
        (&["--seed", "one"], &["--seed"]),
        (&["--duration", "0s"], &["--duration"]),
        (&["--duration", "120"], &["--duration", "unit"]),
        (&["--robots", "create"], &["--robots create"]),
        (
            &["--robots", "horse=2"],
            &["--robots horse=2", "horse", "create"],
        ),
        (&["--robots", "create=0"], &["--robots create=0", "empty"]),
        (&["--faults", "none.toml"], &["none.toml", "no such file"]),
        (
            &["--faults", "faults.toml"],
            &["faults.toml:3", "crush", "crash"],
        ),
        (&["--plot", "a.pdf"], &["--plot a.pdf", ".svg", ".png"]),
        (
            &["--plot", "none/a.svg"],
            &["none/a.svg", "cannot be written"],
        ),
        (
            &["--trace", "none/a.mcap"],
            &["none/a.mcap", "cannot be written"],
        ),
        (&["--trace", "."], &["."]),
        (&["--threads", "0"], &["--threads", "'0'", "from 1 to 1024"]),
        (
            &["--threads", "two"],
            &["--threads", "'two'", "from 1 to 1024"],
        ),
        (
            &["--set", "parameters.planner=rtr"],
            &["--set parameters.planner", "give one of auto, rrt"],
        ),
        (&["--speed", "2"], &["--speed"]),
    ];
    for (options, expected) in cases {
        refused(
            &folder,
            &[&["run", "small.toml"], options].concat(),
            expected,
        );
    }
    assert_eq!(
        names(&folder),
        ["faults.toml", "small.toml"],
        "nothing half-written is left"
    );
}

#[test]
fn bad_parameters_are_refused() {
    let folder = folder("bad_parameters");
    let range = "parameters.entries: -1 is out of range; give a whole number, without unit or point, from 1 to";
    for (options, expected) in [
        (&["--set", "parameters.entries=-1"][..], range),
        (
            &["--set", "parameters.entries", "-1"],
            "--set parameters.count=-1",
        ),
        (
            &["--set", "entries=1"],
            "--set entries: there is no such field; is it a parameter of the program, `parameters.entries`?",
        ),
        (
            &["--set", "parameters.Entries=1"],
            "did you mean `entries`?",
        ),
    ] {
        refused(&folder, &[&["run", "mutex"], options].concat(), &[expected]);
    }
}

#[test]
fn other_files_are_rejected_as_scenarios_and_traces() {
    let folder = folder("bad_files");
    file(&folder, "empty", "");
    file(&folder, "words", "these are only words");
    std::fs::write(folder.join("bytes"), [0x80, 0xff, 0x00]).expect("the folder can be written to");
    refused(
        &folder,
        &["run", "rcae"],
        &[
            "rcae",
            "no example or scenario file",
            "did you mean `race`?",
        ],
    );
    refused(&folder, &["run", "nosuch"], &["nosuch", "starl list"]);
    refused(&folder, &["run", "."], &["folder"]);
    refused(&folder, &["run", "empty"], &["empty:1", "robots"]);
    refused(&folder, &["run", "words"], &["words:1"]);
    refused(&folder, &["run", "bytes"], &["bytes:1", "UTF-8"]);
    refused(&folder, &["replay", "none"], &["none", "no such file"]);
    refused(&folder, &["replay", "empty"], &["empty"]);
    refused(&folder, &["replay", "words"], &["words", "not a trace"]);
    refused(&folder, &["replay", "."], &[".: is a folder"]);
}

#[test]
fn commands_that_do_not_exist_are_refused() {
    let folder = folder("bad_commands");
    for arguments in [
        &["walk"][..],
        &["run"],
        &["replay"],
        &["bench"],
        &["bench", "walk"],
    ] {
        let output = starl(&folder, arguments);
        assert_eq!(status(&output), 2, "{arguments:?}");
        assert!(!stderr(&output).is_empty(), "{arguments:?}");
    }
}

#[test]
#[cfg(unix)]
fn special_files_are_rejected() {
    let folder = folder("special_files");
    let pipe = folder.join("pipe");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    assert!(made.is_ok_and(|status| status.success()));
    for special in ["/dev/zero", "pipe"] {
        let message = "not an ordinary file";
        refused(&folder, &["run", special], &[special, message]);
        let text = format!(
            "program = \"race\"\nworld.files = [\"{special}\"]\n[[robots]]\nmodel = \"create\"\n"
        );
        file(&folder, "special.toml", &text);
        refused(
            &folder,
            &["run", "special.toml"],
            &["special.toml:2", message],
        );
    }
}

#[test]
#[cfg(unix)]
fn a_pipe_as_trace_is_not_waited_for() {
    let folder = folder("pipe_as_trace");
    let pipe = folder.join("pipe");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    assert!(made.is_ok_and(|status| status.success()));
    for command in ["verify", "replay"] {
        refused(
            &folder,
            &[command, "pipe"],
            &["pipe", "not an ordinary file"],
        );
    }
}

/// The run waited for a reader for ever.
#[test]
#[cfg(unix)]
fn a_pipe_without_a_reader_cannot_be_an_output() {
    let folder = folder("pipe_as_output");
    for (option, name) in [("--trace", "pipe"), ("--plot", "pipe.svg")] {
        let made = std::process::Command::new("mkfifo")
            .arg(folder.join(name))
            .status();
        assert!(made.is_ok_and(|status| status.success()));
        refused(
            &folder,
            &["run", "race", option, name],
            &[name, "no program reads"],
        );
    }
}

#[test]
fn control_characters_of_paths_are_escaped() {
    let folder = folder("control_characters");
    let text = "program = \"race\"\nworld.files = [\"a\\u001b[31m.wpt\"]\n[[robots]]\nmodel = \"create\"\n";
    file(&folder, "control.toml", text);
    let file_name = ["a\\u{1b}[31m.wpt"];
    refused(&folder, &["run", "control.toml"], &file_name);
    let option = ["run", "race", "--trace", "none/a\u{1b}[31m.wpt"];
    refused(&folder, &option, &file_name);
    let output = starl(&folder, &option);
    assert!(!stderr(&output).contains('\u{1b}'), "{}", stderr(&output));
}

#[test]
fn fields_without_the_field_that_they_need_are_pointed_out() {
    let folder = folder("idle_fields");
    let said = |set: &str| {
        stderr(&starl(
            &folder,
            &["run", "mutex", "--duration", "1s", "--set", set],
        ))
    };
    for (set, field, needed) in [
        ("network.queue=2s", "network.queue", "network.bandwidth"),
        (
            "network.reordering_delay=1s",
            "network.reordering_delay",
            "network.reordering",
        ),
        (
            "network.resolution=1s",
            "network.resolution",
            "physics.step",
        ),
        ("trace.pose_period=1ms", "trace.pose_period", "physics.step"),
        ("wind.steady=[3,0]", "wind", "no robot of the fleet flies"),
        ("wind.gust_period=3s", "wind.gust_period", "wind.gust"),
        (
            "motion.noise_period=1s",
            "motion.noise_period",
            "motion.speed_noise",
        ),
        ("storage.loss=1", "storage.loss", "storage.kept"),
        (
            "fault_rates.restart_after=3s",
            "fault_rates.restart_after",
            "fault_rates.crash",
        ),
        (
            "fault_rates.heal_after=3s",
            "fault_rates.heal_after",
            "fault_rates.partition",
        ),
        (
            "fault_rates.repair_after=3s",
            "fault_rates.repair_after",
            "fault_rates.stuck_motor",
        ),
    ] {
        let text = said(set);
        assert!(
            text.contains(&format!("warning: {field}: ")),
            "{set}: {text}"
        );
        assert!(text.contains(needed), "{set}: {text}");
    }
    for set in [
        "network.loss=0.1",
        "fault_rates.crash=0.1/s",
        "network.queue=1s",
    ] {
        assert_eq!(said(set), "", "{set}");
    }
}

#[test]
fn a_fleet_beyond_the_limit_is_refused_before_it_is_placed() {
    let folder = folder("huge_fleet");
    let group = "[[robots]]\nmodel = \"create\"\ncount = 10000000\n";
    let text = format!("program = \"race\"\n{}", group.repeat(1000));
    file(&folder, "huge.toml", &text);
    let message = "the fleet has 10000000000 robots";
    refused(&folder, &["run", "huge.toml"], &[message]);
}

#[test]
fn a_delay_that_cannot_act_is_pointed_out() {
    let folder = folder("short_delay");
    let said = |sets: &[&str]| {
        let sets = sets.iter().flat_map(|set| ["--set", *set]);
        let arguments: Vec<&str> = ["run", "race", "--json"].into_iter().chain(sets).collect();
        let output = starl(&folder, &arguments);
        assert_eq!(status(&output), 0);
        stderr(&output)
    };
    let (short, none) = ("network.delay=0.5ms", "network.jitter=0ms");
    let warning = said(&[short, none]);
    assert!(warning.starts_with("warning: network.delay: "), "{warning}");
    assert!(warning.contains("network.resolution"), "{warning}");
    assert_eq!(said(&[short, none, "network.resolution=0.1ms"]), "");
    assert_eq!(said(&["network.delay=0ms", none]), "");
    assert_eq!(said(&[]), "");
}

#[test]
fn a_robot_whose_name_would_leave_its_folder_is_refused() {
    let folder = folder("bad_names");
    for name in ["../up", "a\\u0000b"] {
        let text =
            format!("program = \"race\"\n[[robots]]\nmodel = \"create\"\nname = \"{name}\"\n");
        file(&folder, "name.toml", &text);
        let message = "cannot be the name of a robot";
        refused(&folder, &["run", "name.toml"], &["name.toml:4", message]);
    }
}

/// Each message names the option that was given.
#[test]
fn options_are_named_as_given() {
    let folder = folder("options_as_given");
    let cases: [(&[&str], &str); 7] = [
        (&["run", "race", "--threads", "-3"], "--threads=-3"),
        (
            &["diagram", "race", "--out", "d.svg", "--last", "-3s"],
            "--last=-3s",
        ),
        (
            &["run", "race", "--set", "parameters.count", "-1"],
            "--set parameters.count=-1",
        ),
        (
            &["compare", "race", "--set-b", "network.loss=x"],
            "--set-b network.loss: ",
        ),
        (&["explore", "mutex", "--time", "5s"], "--tick"),
        (&["explore", "mutex", "--skew", "2"], "--tick"),
        (
            &["test", "race", "--seeds", "1", "--out", "/proc/none"],
            "the folder cannot be created: there is no such file or folder; choose another path",
        ),
    ];
    for (arguments, expected) in cases {
        refused(&folder, arguments, &[expected]);
    }
}

/// The many kinds of events are listed, since an unknown kind resembles none of them.
#[test]
fn an_unknown_kind_of_event_lists_the_kinds() {
    let folder = folder("unknown_event");
    file(
        &folder,
        "event.toml",
        "[[event]]\nat = \"1s\"\nkind = \"volcano\"\n",
    );
    let run = ["run", "race", "--faults", "event.toml"];
    refused(
        &folder,
        &run,
        &["choose one of: crash", "set_thing", "leave"],
    );
}

#[test]
fn a_scenario_where_a_program_or_a_fleet_belongs() {
    let folder = folder("misplaced_scenario");
    let text = "program = \"race\"\n[[robots]]\nmodel = \"create\"\n";
    file(&folder, "town.toml", text);
    let refuse = |arguments: &[&str], expected: &str| {
        let output = starl(&folder, arguments);
        assert_eq!(status(&output), 2);
        assert_eq!(stderr(&output), format!("error: town.toml{expected}\n"));
    };
    let program = ": is a scenario, not a program; `starl run` reads and checks it";
    refuse(&["check", "town.toml"], program);
    refuse(&["fmt", "town.toml"], program);
    if cfg!(feature = "fleet") {
        let fleet = ":1: this is a scenario, which `starl run` runs; a fleet file names it by `scenario = \"town.toml\"`";
        refuse(&["fleet", "status", "town.toml"], fleet);
    }
}
