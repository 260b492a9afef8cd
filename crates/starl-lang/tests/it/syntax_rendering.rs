//! Diagnostics as JSON, in colour, and with what a terminal must not see.

use starl_lang::diagnostic::{Code, Colour, LineIndex, Position, closest, json, render};
use starl_lang::syntax::parse;

#[test]
fn json_has_places_and_fixes() {
    let text = "program P\n\nrun()\n    pre é = 1\n    eff f()\n";
    let parsed = json("p.starl", text, parse(text).diagnostics());
    let value: serde_json::Value = serde_json::from_str(&parsed).unwrap();
    let problem = &value[1];
    assert_eq!(problem["code"], "E0110");
    assert_eq!(problem["severity"], "error");
    assert_eq!(problem["file"], "p.starl");
    assert_eq!(
        problem["start"],
        serde_json::json!({"offset": 28, "line": 4, "column": 11})
    );
    assert_eq!(problem["end"]["column"], 12);
    assert_eq!(problem["expected"], serde_json::Value::Null);
    let edit = &problem["fix"]["edits"][0];
    assert_eq!(
        (&edit["text"], &edit["start"]["offset"]),
        (&"==".into(), &28.into())
    );
}

#[test]
fn no_diagnostics_are_an_empty_array() {
    assert_eq!(json("p.starl", "", &[]), "[]");
}

#[test]
fn colours_are_escape_sequences_around_the_same_text() {
    let text = "program P\n\nx: = 1\n";
    let diagnostics = parse(text);
    let plain = render("p.starl", text, diagnostics.diagnostics(), Colour::Off);
    let coloured = render("p.starl", text, diagnostics.diagnostics(), Colour::On);
    assert!(!plain.contains('\u{1b}') && coloured.contains('\u{1b}'));
    let mut stripped = String::new();
    for (index, part) in coloured.split('\u{1b}').enumerate() {
        stripped += if index == 0 {
            part
        } else {
            part.split_once('m').unwrap().1
        };
    }
    assert_eq!(stripped, plain);
}

#[test]
fn terminal_escapes_are_not_shown() {
    let text = "program P\n\nx: \u{1b}[2J\u{9b}\u{202e}Int = \u{7}\n";
    let shown = render("p.starl", text, parse(text).diagnostics(), Colour::Off);
    assert!(
        !shown.contains(['\u{1b}', '\u{9b}', '\u{202e}', '\u{7}']),
        "{shown:?}"
    );
}

#[test]
fn places_count_lines_and_characters_from_one() {
    let text = "aé\nb";
    let lines = LineIndex::new(text);
    assert_eq!(lines.position(text, 0), Position { line: 1, column: 1 });
    assert_eq!(lines.position(text, 3), Position { line: 1, column: 3 });
    assert_eq!(lines.position(text, 5), Position { line: 2, column: 2 });
}

#[test]
fn the_name_that_was_meant_is_found() {
    let names = ["done", "doneFlag", "active", "currentIndex"];
    assert_eq!(closest("doneflag", names), Some("doneFlag"));
    assert_eq!(closest("currentIdnex", names), Some("currentIndex"));
    assert_eq!(closest("actve", names), Some("active"));
    assert_eq!(closest("target", names), None);
    assert_eq!(closest("", names), None);
}

#[test]
fn numbers_of_codes_are_their_own_and_have_titles() {
    let mut numbers: Vec<&str> = Code::ALL.iter().map(|code| code.number()).collect();
    let count = numbers.len();
    numbers.sort_unstable();
    numbers.dedup();
    assert_eq!(numbers.len(), count);
    assert!(Code::ALL.iter().all(|code| code.title().ends_with('.')));
}
