//! `starl check` reports all problems of programs, and exits with 0, 1 or 2.

use crate::support::*;

/// One warning: a variable that is never read.
const IDLE: &str = "program Idle\n\ncount: Int = 0\n\nstep()\n    eff count += 1\n";
/// Two errors, in different actions.
const BROKEN: &str = "program Broken\n\nfirst()\n    eff emit(nothing)\n\nsecond()\n    pre 1 + 1\n    eff log(\"second\")\n";
const GOOD: &str = "program Good\n\nstep()\n    eff log(\"step\")\n";

#[test]
fn a_good_program_has_no_problems() {
    let folder = folder("check_good");
    file(&folder, "good.starl", GOOD);
    let output = starl(&folder, &["check", "good.starl"]);
    assert_eq!(stdout(&output), "1 file: no problems\n");
    assert_eq!((status(&output), stderr(&output)), (0, String::new()));
}

#[test]
fn all_errors_are_shown_with_their_place() {
    let folder = folder("check_errors");
    file(&folder, "broken.starl", BROKEN);
    let output = starl(&folder, &["check", "broken.starl"]);
    let text = stdout(&output);
    assert_eq!(status(&output), 1, "{text}{}", stderr(&output));
    for expected in [
        "error[E0201]",
        "broken.starl:4:14",
        "error[E0220]",
        "broken.starl:7:9",
        "1 file: 2 errors\n",
    ] {
        assert!(text.contains(expected), "no {expected:?} in\n{text}");
    }
    assert!(!text.contains('\u{1b}'), "no colours without a terminal");
}

#[test]
fn warnings_are_allowed_unless_denied() {
    let folder = folder("check_warnings");
    file(&folder, "idle.starl", IDLE);
    let allowed = starl(&folder, &["check", "idle.starl"]);
    assert!(stdout(&allowed).contains("warning[W0205]"));
    assert!(stdout(&allowed).ends_with("1 file: 1 warning\n"));
    assert_eq!(status(&allowed), 0);
    let denied = starl(&folder, &["check", "--deny-warnings", "idle.starl"]);
    assert_eq!(status(&denied), 1);
}

#[test]
fn a_folder_means_the_programs_in_it() {
    let folder = folder("check_folder");
    let inner = folder.join("all/inner");
    std::fs::create_dir_all(&inner).expect("a folder can be made");
    std::fs::create_dir_all(folder.join("all/.hidden")).expect("a folder can be made");
    file(&folder, "all/good.starl", GOOD);
    file(&folder, "all/notes.txt", BROKEN);
    file(&folder, "all/.hidden/broken.starl", BROKEN);
    file(&inner, "idle.starl", IDLE);
    let output = starl(&folder, &["check", "all", "all/good.starl"]);
    assert!(stdout(&output).contains("all/inner/idle.starl:3:1"));
    assert!(stdout(&output).ends_with("2 files: 1 warning\n"));
    assert_eq!(status(&output), 0);
}

#[test]
fn standard_input_is_checked_too() {
    let folder = folder("check_input");
    let output = starl_reading(&folder, &["check", "-"], BROKEN);
    assert!(stdout(&output).contains("standard input:4:14"));
    assert_eq!(status(&output), 1);
}

#[test]
fn libraries_are_found_beside_the_file_and_in_the_standard_library() {
    let folder = folder("check_libraries");
    let inner = folder.join("inner");
    std::fs::create_dir_all(&inner).expect("a folder can be made");
    file(
        &inner,
        "own.starl",
        "library own\n\nfunction two() -> Int = 2\n",
    );
    let program = "program Uses\nimport own\nimport geometry\n\nstep()\n    eff log(\"{} {}\", own.two(), geometry.midpoint(position, position))\n";
    file(&inner, "uses.starl", program);
    let output = starl(&folder, &["check", "inner/uses.starl"]);
    assert_eq!(stdout(&output), "1 file: no problems\n");
}

#[test]
fn errors_of_a_library_are_shown_in_the_library_and_once() {
    let folder = folder("check_broken_library");
    file(
        &folder,
        "own.starl",
        "library own\n\nfunction two() -> Int = 2.0\n",
    );
    for name in ["a.starl", "b.starl"] {
        let program = "program Uses\nimport own\n\nstep()\n    eff log(\"{}\", own.two())\n";
        file(&folder, name, program);
    }
    let output = starl(&folder, &["check", "a.starl", "b.starl"]);
    let text = stdout(&output);
    assert_eq!(text.matches("own.starl:3:25").count(), 1, "{text}");
    assert!(text.ends_with("2 files: 3 errors\n"), "{text}");
    assert_eq!(status(&output), 1);
}

#[test]
fn unreadable_files_are_reported_and_the_rest_checked() {
    let folder = folder("check_unreadable");
    file(&folder, "broken.starl", BROKEN);
    std::fs::write(folder.join("latin.starl"), b"program L\n// \xe9\n").expect("it can be written");
    std::fs::create_dir(folder.join("empty")).expect("a folder can be made");
    let arguments = [
        "check",
        "missing.starl",
        "latin.starl",
        "empty",
        "broken.starl",
    ];
    let output = starl(&folder, &arguments);
    assert_eq!(status(&output), 2);
    assert!(stdout(&output).ends_with("1 file: 2 errors\n"));
    let text = stderr(&output);
    for expected in [
        "error: missing.starl: cannot be read: there is no such file; check the path",
        "error: latin.starl:2: is not text in UTF-8",
        "error: empty: there is no `.starl` file in this folder",
    ] {
        assert!(text.contains(expected), "no {expected:?} in\n{text}");
    }
}

#[test]
fn json_output_has_code_position_and_fix() {
    let folder = folder("check_json");
    let text = "program Fix\n\ntarget: Point\n\nstep()\n    eff log(\"{}\", tarjet)\n";
    file(&folder, "fix.starl", text);
    let output = starl(&folder, &["check", "--json", "fix.starl"]);
    assert_eq!(status(&output), 1);
    let report = json(&output);
    assert_eq!(report["files"], 1);
    assert_eq!(report["errors"], 1);
    assert_eq!(report["warnings"], 0);
    let all = report["diagnostics"].as_array().expect("it is a list");
    let problem = all
        .iter()
        .find(|problem| problem["severity"] == "error")
        .expect("there is an error");
    assert_eq!(problem["code"], "E0201");
    assert_eq!(problem["file"], "fix.starl");
    let place = serde_json::json!({"offset": 53, "line": 6, "column": 19});
    assert_eq!(problem["start"], place);
    assert_eq!(problem["fix"]["edits"][0]["text"], "target");
    assert_eq!(problem["fix"]["edits"][0]["start"], place);
}
