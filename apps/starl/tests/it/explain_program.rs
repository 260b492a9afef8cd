//! `starl explain` draws the state machine of a program.

use crate::support::*;

const DOOR: &str = include_str!("../../../../crates/starl-editor/tests/drawings/door.starl");
const MERMAID: &str = include_str!("../../../../crates/starl-editor/tests/drawings/door.mmd");
const DOT: &str = include_str!("../../../../crates/starl-editor/tests/drawings/door.dot");

#[test]
fn a_program_is_drawn_for_mermaid_or_graphviz() {
    let folder = folder("explain_formats");
    file(&folder, "door.starl", DOOR);
    for (arguments, expected) in [
        (&["explain", "door.starl"][..], MERMAID),
        (&["explain", "door.starl", "--format", "dot"], DOT),
        (&["explain", "door.starl", "--variable", "state"], MERMAID),
    ] {
        let output = starl(&folder, arguments);
        assert_eq!(stdout(&output), expected, "{arguments:?}");
        assert_eq!((status(&output), stderr(&output)), (0, String::new()));
    }
    let output = starl_reading(&folder, &["explain", "-"], DOOR);
    assert_eq!(stdout(&output), MERMAID);
}

#[test]
fn examples_are_drawn_by_their_names() {
    let folder = folder("explain_examples");
    for (example, step) in [
        ("race", "    pick --> wait: pick\n"),
        ("search", "    rest --> search: enter\n"),
    ] {
        let output = starl(&folder, &["explain", example]);
        assert!(stdout(&output).contains(step), "{}", stdout(&output));
        assert_eq!((status(&output), stderr(&output)), (0, String::new()));
    }
}

#[test]
fn the_recipe_shows_race_as_it_is() {
    let recipe = include_str!("../../../../docs/how-to/check-a-program.md");
    let output = starl(&folder("explain_recipe"), &["explain", "race"]);
    let block = format!("```text\n{}```\n", stdout(&output));
    assert!(recipe.contains(&block), "{block}");
}

#[test]
fn the_drawing_goes_to_a_file_in_the_language_of_its_suffix() {
    let folder = folder("explain_output");
    file(&folder, "door.starl", DOOR);
    for (name, expected) in [("door.dot", DOT), ("door.gv", DOT), ("door.mmd", MERMAID)] {
        let output = starl(&folder, &["explain", "door.starl", "--output", name]);
        assert_eq!((status(&output), stdout(&output)), (0, String::new()));
        let written = std::fs::read_to_string(folder.join(name)).expect("it is there");
        assert_eq!(written, expected, "{name}");
    }
}

#[test]
fn a_code_is_explained_by_its_page() {
    let folder = folder("explain_code");
    for code in ["E0201", "w0205"] {
        let output = starl(&folder, &["explain", code]);
        let title = format!("# {}: ", code.to_uppercase());
        assert!(stdout(&output).starts_with(&title), "{}", stdout(&output));
        assert_eq!(status(&output), 0);
    }
}

#[test]
fn a_program_with_errors_is_not_drawn() {
    let folder = folder("explain_errors");
    file(&folder, "bad.starl", "program Bad\n\nx: Int = true\n");
    let output = starl(&folder, &["explain", "bad.starl"]);
    assert_eq!((status(&output), stdout(&output)), (1, String::new()));
    assert!(stderr(&output).contains("error[E0220]"));
    assert!(stderr(&output).contains("bad.starl: has errors, and is not drawn"));
}

#[test]
fn other_programs_are_rejected_with_a_reason() {
    let folder = folder("explain_refused");
    file(&folder, "door.starl", DOOR);
    file(&folder, "plain.starl", "program Plain\n");
    file(&folder, "own.starl", "library own\n");
    for (arguments, expected) in [
        (
            &["explain", "plain.starl"][..],
            "no variable of an enum type",
        ),
        (&["explain", "own.starl"], "a library has no state machine"),
        (
            &["explain", "door.starl", "--variable", "waited"],
            "there is no variable `waited` of an enum type or of type Bool; there are: role, state",
        ),
        (
            &["explain", "missing.starl"],
            "missing.starl: cannot be read: there is no such file",
        ),
        (&["explain", "raze"], "race"),
        (&["explain", "."], "is a folder"),
    ] {
        let output = starl(&folder, arguments);
        assert_eq!(status(&output), 2, "{arguments:?}");
        assert!(
            stderr(&output).contains(expected),
            "{arguments:?}: {}",
            stderr(&output)
        );
    }
}
