//! `starl lsp` knows the files beside a program: open ones as they are typed, others as they are on disk.

use crate::lsp_support::*;
use crate::support::{file, folder};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

const TOOLS: &str = "library tools\nconst one = 1\nfunction twice(a: Int) -> Int = a + a\n";
const PROGRAM: &str = "program P\nimport tools\nx: Int = tools.twice(tools.one)\ngo()\n    pre x < 9\n    eff x = tools.twice(a = x)\n";

struct Place {
    editor: Editor,
    tools: PathBuf,
    program: PathBuf,
}

fn place(test: &str) -> Place {
    let folder = folder(test);
    let folder = folder.canonicalize().expect("the folder is there");
    Place {
        tools: file(&folder, "tools.starl", TOOLS),
        program: file(&folder, "p.starl", PROGRAM),
        editor: Editor::ready(),
    }
}

fn codes(problems: &[Value]) -> Vec<&str> {
    problems
        .iter()
        .filter_map(|problem| problem["code"].as_str())
        .collect()
}

fn name_of(path: &Path) -> String {
    uri(path)
}

#[test]
fn a_library_is_read_from_the_folder() {
    let mut place = place("lsp_folder");
    let program = name_of(&place.program);
    place.editor.open(&program, PROGRAM);
    assert_eq!(
        codes(&place.editor.problems(&program, 1)),
        Vec::<&str>::new()
    );
    let found = place
        .editor
        .at("textDocument/definition", &program, (2, 17));
    let found = found.expect("an answer");
    assert_eq!(found["uri"], json!(name_of(&place.tools)));
    assert_eq!(found["range"]["start"], json!({"line": 2, "character": 9}));
}

#[test]
fn a_library_that_is_open_counts_as_it_is_typed() {
    let mut place = place("lsp_open");
    let (program, tools) = (name_of(&place.program), name_of(&place.tools));
    place.editor.open(&program, PROGRAM);
    assert!(place.editor.problems(&program, 1).is_empty());
    place.editor.open(&tools, TOOLS);
    assert!(place.editor.problems(&tools, 1).is_empty());
    // `one` becomes `oe`.
    place.editor.change(&tools, 2, [1, 7, 1, 8], "");
    let problems = place.editor.problems(&program, 1);
    assert_eq!(codes(&problems), ["E0201"], "{problems:?}");
    let closed = json!({"textDocument": {"uri": tools}});
    place.editor.tell("textDocument/didClose", closed);
    assert!(
        place.editor.problems(&program, 1).is_empty(),
        "the file was not changed"
    );
}

#[test]
fn a_file_that_changes_on_disk_counts_once_the_editor_says_so() {
    let mut place = place("lsp_disk");
    let program = name_of(&place.program);
    place.editor.open(&program, PROGRAM);
    assert!(place.editor.problems(&program, 1).is_empty());
    std::fs::write(&place.tools, "library tools\n").expect("it can be written");
    let changes = json!({"changes": [{"uri": name_of(&place.tools), "type": 2}]});
    place
        .editor
        .tell("workspace/didChangeWatchedFiles", changes);
    let problems = place.editor.problems(&program, 1);
    assert_eq!(codes(&problems), ["E0201"; 3], "{problems:?}");
}

#[test]
fn uses_of_declarations_in_a_library_are_found_in_all_programs() {
    let mut place = place("lsp_uses");
    let (program, tools) = (name_of(&place.program), name_of(&place.tools));
    place.editor.open(&tools, TOOLS);
    let mut params = position(&tools, (2, 10));
    params["context"] = json!({"includeDeclaration": true});
    let found = place
        .editor
        .ask("textDocument/references", params)
        .expect("an answer");
    let found: Vec<(&str, u64)> = (found.as_array().expect("a list").iter())
        .filter_map(|place| {
            Some((
                place["uri"].as_str()?,
                place["range"]["start"]["line"].as_u64()?,
            ))
        })
        .collect();
    assert_eq!(found, [(&*program, 2), (&*program, 5), (&*tools, 2)]);
}

#[test]
fn a_library_and_its_programs_are_renamed_together() {
    let mut place = place("lsp_rename");
    let (program, tools) = (name_of(&place.program), name_of(&place.tools));
    for (name, text, at) in [(&tools, TOOLS, (2, 16)), (&program, PROGRAM, (5, 25))] {
        place.editor.open(name, text);
        let mut params = position(name, at);
        params["newName"] = json!("number");
        let renamed = place
            .editor
            .ask("textDocument/rename", params)
            .expect("it is renamed");
        let library = applied(TOOLS, &renamed["changes"][&tools]);
        assert_eq!(
            library,
            TOOLS.replace(
                "(a: Int) -> Int = a + a",
                "(number: Int) -> Int = number + number"
            )
        );
        let user = applied(PROGRAM, &renamed["changes"][&program]);
        assert_eq!(user, PROGRAM.replace("a = x", "number = x"));
        place.editor.tell(
            "textDocument/didClose",
            json!({"textDocument": {"uri": name}}),
        );
    }
}

#[test]
fn names_of_the_standard_library_cannot_be_renamed() {
    let mut place = place("lsp_standard");
    let program = name_of(&place.program);
    let text = "program P\nimport geometry\nx: Point = geometry.midpoint(position, position)\n";
    place.editor.open(&program, text);
    let refused = place
        .editor
        .at("textDocument/prepareRename", &program, (2, 22));
    let refused = refused.expect_err("it may not");
    assert_eq!(
        refused["message"],
        "`midpoint` is part of the standard library"
    );
    let found = place
        .editor
        .at("textDocument/definition", &program, (2, 22));
    let found = found.expect("an answer");
    assert_eq!(found["uri"], "starl-library:/geometry.starl");
}

#[test]
fn libraries_beside_are_suggested() {
    let mut place = place("lsp_suggest");
    let program = name_of(&place.program);
    place.editor.open(&program, "program P\nimport \n");
    let list = place.editor.at("textDocument/completion", &program, (1, 7));
    let list = list.expect("an answer");
    let items = list["items"].as_array().expect("a list");
    let labels: Vec<&str> = items
        .iter()
        .filter_map(|item| item["label"].as_str())
        .collect();
    assert!(
        labels.contains(&"geometry") && labels.contains(&"tools"),
        "{labels:?}"
    );
    assert!(!labels.contains(&"p"), "a program is no library");
}

#[test]
fn a_library_that_is_added_later_is_found() {
    let mut place = place("lsp_later");
    let program = name_of(&place.program);
    let later = place.tools.with_file_name("later.starl");
    place
        .editor
        .open(&program, "program P\nimport later\nx: Int = later.one\n");
    let problems = place.editor.problems(&program, 1);
    assert_eq!(codes(&problems), ["E0210"], "{problems:?}");
    place
        .editor
        .open(&name_of(&later), "library later\nconst one = 1\n");
    let codes_now = place.editor.problems(&program, 1);
    assert!(
        codes(&codes_now).iter().all(|code| code.starts_with('W')),
        "{codes_now:?}"
    );
}
