//! An editor's view of programs in memory.

use crate::support::ask;
use serde_json::{Value, json};
use starl_catalog::service::Service;

const LIBRARY: &str =
    "library tools\n\n/// Twice a number.\nfunction twice(n: Int) -> Int = n + n\n";
const PROGRAM: &str = "program Counter\n\nimport tools\n\n/// How often it has ticked \u{1F600}.\ncount: Int = 0\n\ntick()\n    pre count < 8\n    eff log(\"\u{1F600}\"); count = tools.twice(count) + 1\n\nstop()\n    pre count >= 8\n    eff finish()\n";

fn request(name: &str, program: &str, more: Value) -> Result<Value, Value> {
    let mut parameters = json!({
        "files": {"lab/counter.starl": program, "lab/tools.starl": LIBRARY},
        "path": "lab/counter.starl",
    });
    let members = parameters.as_object_mut().expect("an object");
    members.extend(more.as_object().expect("an object").clone());
    ask(&mut Service::default(), &json!({ name: parameters }))
}

/// The place of the cursor `|`, in lines and UTF-16 units, and the text without it.
fn cursor(text: &str) -> (String, Value) {
    let (before, after) = text.split_once('|').expect("the text has a cursor");
    let line = before.matches('\n').count();
    let column = before
        .rsplit('\n')
        .next()
        .map_or(0, |line| line.encode_utf16().count());
    (
        format!("{before}{after}"),
        json!({"line": line, "character": column}),
    )
}

/// Asks at a cursor.
fn at(name: &str, text: &str) -> Value {
    let (program, position) = cursor(text);
    let answer = request(name, &program, json!({"position": position}));
    answer.unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn range(line: u32, from: u32, to: u32) -> Value {
    json!({"start": {"line": line, "character": from}, "end": {"line": line, "character": to}})
}

#[test]
fn a_name_shows_its_declaration() {
    let shown = at("hover", &PROGRAM.replace("twice(count)", "twice(c|ount)"));
    let markdown = "```starl\ncount: Int = 0\n```\n\nHow often it has ticked \u{1F600}.";
    assert_eq!(shown["markdown"], markdown);
    let column = "    eff log(\"xx\"); count = tools.twice(".len() as u32;
    assert_eq!(shown["range"], range(9, column, column + 5));
    assert_eq!(
        at("hover", &PROGRAM.replace("program", "|program"))["range"],
        range(0, 0, 7)
    );
    assert_eq!(
        at("hover", &PROGRAM.replace("\n\nimport", "\n|\nimport")),
        Value::Null
    );
}

#[test]
fn a_name_leads_to_its_declaration() {
    let found = at(
        "definition",
        &PROGRAM.replace("twice(count)", "twice(c|ount)"),
    );
    assert_eq!(
        found,
        json!({"path": "lab/counter.starl", "range": range(5, 0, 5), "text": null})
    );
    let found = at("definition", &PROGRAM.replace("twice", "tw|ice"));
    assert_eq!(found["path"], "lab/tools.starl");
    assert_eq!(found["range"], range(3, 9, 14));
    assert_eq!(found["text"], Value::Null);
    assert_eq!(
        at("definition", &PROGRAM.replace("finish()", "fini|sh()")),
        Value::Null
    );
}

#[test]
fn a_name_of_the_standard_library_leads_to_its_text() {
    let program =
        "program Far\n\nimport geometry\n\nstop()\n    pre geometry.|CALL\n    eff finish()\n";
    let (offered, position) = cursor(&program.replace("CALL", ""));
    let offered = request("complete", &offered, json!({"position": position})).expect("an answer");
    let function = offered.as_array().expect("a list").iter();
    let function = function.clone().find(|item| item["kind"] == "function");
    let name = function.expect("a function")["label"]
        .as_str()
        .expect("a text");
    let found = at("definition", &program.replace("CALL", name));
    assert_eq!(found["path"], "starl-library:/geometry.starl");
    let text = found["text"].as_str().expect("the text of the library");
    let start = &found["range"]["start"];
    let line = text
        .lines()
        .nth(start["line"].as_u64().expect("a number") as usize);
    let column = start["character"].as_u64().expect("a number") as usize;
    assert!(
        line.is_some_and(|line| line[column..].starts_with(name)),
        "{line:?}"
    );
}

#[test]
fn completions_have_their_insertions() {
    let offered = at(
        "complete",
        &PROGRAM.replace("tools.twice(count)", "tools.tw|"),
    );
    let column = "    eff log(\"xx\"); count = tools.".len() as u32;
    assert_eq!(
        offered,
        json!([{
            "label": "twice",
            "kind": "function",
            "detail": "function twice(n: Int) -> Int",
            "documentation": "Twice a number.",
            "insert": "twice()",
            "cursor": 6,
            "range": range(9, column, column + 2),
        }])
    );
    let offered = at(
        "complete",
        &PROGRAM.replace("tools.twice(count)", "tools.tw|(count)"),
    );
    assert_eq!(
        (&offered[0]["insert"], &offered[0]["cursor"]),
        (&json!("twice"), &json!(5))
    );
    let offered = at("complete", &PROGRAM.replace("import tools", "import |"));
    let offered = offered.as_array().expect("a list");
    let labels: Vec<_> = offered.iter().map(|item| &item["label"]).collect();
    assert!(labels.contains(&&json!("tools")), "{labels:?}");
    assert!(labels.contains(&&json!("geometry")), "{labels:?}");
    assert!(!labels.contains(&&json!("counter")), "{labels:?}");
}

#[test]
fn an_outline_has_the_parts_of_the_text() {
    let outline = request("outline", PROGRAM, json!({})).expect("an outline");
    let parts = outline.as_array().expect("a list").iter();
    let parts: Vec<_> = parts.map(|part| (&part["name"], &part["kind"])).collect();
    assert_eq!(
        json!(parts),
        json!([
            ["count", "variable"],
            ["tick", "action"],
            ["stop", "action"]
        ])
    );
    assert_eq!(outline[0]["name_range"], range(5, 0, 5));
    assert_eq!(outline[0]["detail"], "Int");
    assert_eq!(
        outline[1]["range"]["start"],
        json!({"line": 7, "character": 0})
    );
}

#[test]
fn a_text_is_formatted_as_by_the_command() {
    let untidy = PROGRAM
        .replace("count: Int = 0", "count:Int=0")
        .replace("    pre", "  pre");
    let formatted = ask(
        &mut Service::default(),
        &json!({"format": {"text": untidy}}),
    );
    assert_eq!(formatted, Ok(json!(starl_editor::format::format(&untidy))));
    assert!(formatted.is_ok_and(|text| text.to_string().contains("count: Int = 0")));
}

#[test]
fn problems_bring_their_fixes_and_other_places() {
    let broken = PROGRAM.replace("pre count < 8", "pre cuont < 8");
    let files = json!({"counter.starl": broken, "tools.starl": LIBRARY});
    let found = ask(&mut Service::default(), &json!({"check": {"files": files}}));
    let found = found.expect("a list");
    assert_eq!(
        found[0]["edits"],
        json!([{"line": 9, "column": 9, "end_line": 9, "end_column": 14, "text": "count"}])
    );
    let twice = format!("{PROGRAM}\ntick()\n    pre false\n    eff finish()\n");
    let files = json!({"counter.starl": twice, "tools.starl": LIBRARY});
    let found = ask(&mut Service::default(), &json!({"check": {"files": files}}));
    let found = found.expect("a list");
    let related = &found[0]["related"][0];
    assert_eq!(
        (&related["line"], &related["column"]),
        (&json!(8), &json!(1)),
        "{found}"
    );
    let files = json!({"counter.starl": PROGRAM.replace("tools.twice(count)", "count"), "tools.starl": LIBRARY});
    let found = ask(&mut Service::default(), &json!({"check": {"files": files}}));
    let found = found.expect("a list");
    assert_eq!(
        (&found[0]["line"], &found[0]["unnecessary"]),
        (&json!(3), &json!(true))
    );
}

#[test]
fn unknown_files_are_rejected() {
    let place = json!({"line": 0, "character": 0});
    for (path, words) in [
        ("lab/none.starl", "no such file"),
        ("lab/scenario.toml", ".starl"),
    ] {
        let refused = request("hover", PROGRAM, json!({"path": path, "position": place}));
        let refused = refused.expect_err("it is no program");
        assert!(refused["message"].to_string().contains(words), "{refused}");
    }
    let beyond = json!({"position": {"line": 4_000_000, "character": 7}});
    assert_eq!(request("hover", PROGRAM, beyond), Ok(Value::Null));
}
