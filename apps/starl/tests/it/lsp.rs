//! `starl lsp` serves an editor, and no message from the editor ends it.

use crate::lsp_support::*;
use serde_json::{Value, json};

const URI: &str = "untitled:Race";

const RACE: &str = "/// A race.
program Race
enum Location {init, pick}
param vicinity: Float = 75mm
motion = ReachAvoid(vicinity = vicinity)
loc: Location = init
/// Where next.
index: Int = 0
go()
    pre loc == init and not motion.active
    eff
        index += 1
        loc = pick
back()
    pre loc == pick and index < 3
    eff loc = init
";

fn message(problem: &Value) -> &str {
    problem["message"].as_str().unwrap_or_default()
}

fn opened(text: &str) -> Editor {
    let mut editor = Editor::ready();
    editor.open(URI, text);
    editor
}

#[test]
fn a_session_begins_and_ends_as_the_protocol_says() {
    let mut editor = Editor::new();
    let too_early = editor.ask("textDocument/hover", position(URI, (0, 0)));
    assert_eq!(too_early.expect_err("it is too early")["code"], -32002);
    let params = json!({"processId": null, "rootUri": null, "capabilities": {}});
    let answer = editor.ask("initialize", params.clone()).expect("it starts");
    assert_eq!(answer["serverInfo"]["name"], "starl");
    let capabilities = &answer["capabilities"];
    for name in [
        "hoverProvider",
        "completionProvider",
        "definitionProvider",
        "referencesProvider",
        "renameProvider",
        "documentSymbolProvider",
        "documentFormattingProvider",
        "semanticTokensProvider",
        "codeActionProvider",
    ] {
        assert!(!capabilities[name].is_null(), "{name}");
    }
    assert!(editor.ask("initialize", params).is_err(), "it has started");
    assert_eq!(editor.ask("shutdown", Value::Null), Ok(Value::Null));
    let too_late = editor.at("textDocument/hover", URI, (0, 0));
    assert_eq!(too_late.expect_err("it is too late")["code"], -32600);
    editor.tell("exit", Value::Null);
    assert_eq!(editor.wait().code(), Some(0));
}

#[test]
fn an_exit_without_a_shutdown_is_a_failure() {
    let mut editor = Editor::ready();
    editor.tell("exit", Value::Null);
    assert_eq!(editor.wait().code(), Some(1));
    assert_eq!(
        Editor::ready().wait().code(),
        Some(1),
        "so is the end of the input"
    );
}

#[test]
fn problems_are_updated_while_typing() {
    let mut editor = opened(RACE);
    assert_eq!(editor.problems(URI, 1), Vec::<Value>::new());
    // `loc = pick` becomes `loc = pack`.
    editor.change(URI, 2, [12, 15, 12, 16], "a");
    let problems = editor.problems(URI, 2);
    let first = problems.first().expect("there is a problem");
    assert!(message(first).contains("has no variant `pack`"), "{first}");
    assert_eq!(first["code"], "E0216");
    assert_eq!(first["severity"], 1);
    assert_eq!(
        first["range"],
        json!({"start": {"line": 12, "character": 14}, "end": {"line": 12, "character": 18}})
    );
    editor.change(URI, 3, [12, 15, 12, 16], "i");
    assert_eq!(editor.problems(URI, 3), Vec::<Value>::new());
    // All of it at once.
    let whole = json!({
        "textDocument": {"uri": URI, "version": 4},
        "contentChanges": [{"text": "program P\nx: Int = \n"}],
    });
    editor.tell("textDocument/didChange", whole);
    assert!(!editor.problems(URI, 4).is_empty());
    editor.tell(
        "textDocument/didClose",
        json!({"textDocument": {"uri": URI}}),
    );
    assert!(
        editor.at("textDocument/hover", URI, (0, 0)).is_err(),
        "it is closed"
    );
}

#[test]
fn a_problem_has_its_fix() {
    let text = RACE.replace("loc = pick\n", "loc = pack\n");
    let mut editor = opened(&text);
    let problems = editor.problems(URI, 1);
    let params = json!({
        "textDocument": {"uri": URI},
        "range": problems[0]["range"],
        "context": {"diagnostics": problems},
    });
    let actions = editor
        .ask("textDocument/codeAction", params)
        .expect("an answer");
    assert_eq!(actions[0]["title"], "Did you mean `pick`?");
    let edits = &actions[0]["edit"]["changes"][URI];
    assert_eq!(applied(&text, edits), RACE);
}

#[test]
fn a_name_shows_its_declaration() {
    let (text, place) = cursor(&RACE.replace("index += 1", "in$0dex += 1"));
    let mut editor = opened(&text);
    let shown = editor
        .at("textDocument/hover", URI, place)
        .expect("an answer");
    assert_eq!(
        shown["contents"]["value"],
        "```starl\nindex: Int = 0\n```\n\nWhere next."
    );
    assert_eq!(shown["range"]["start"], json!({"line": 11, "character": 8}));
    assert_eq!(
        editor
            .at("textDocument/hover", URI, (1, 9))
            .map(|shown| shown.is_null()),
        Ok(false)
    );
    assert_eq!(
        editor.at("textDocument/hover", URI, (99, 99)),
        Ok(Value::Null)
    );
}

#[test]
fn columns_count_units_of_utf_16() {
    let text = "program P\nx: Int = 0\ngo()\n    eff emit(\"\u{e4}\u{1f600}\", a = x$0)\n";
    let (text, place) = cursor(text);
    assert_eq!(place.1, 25);
    let mut editor = opened(&text);
    let shown = editor
        .at("textDocument/hover", URI, place)
        .expect("an answer");
    assert_eq!(shown["range"]["start"], json!({"line": 3, "character": 24}));
    editor.change(URI, 2, [3, 15, 3, 17], "");
    let edits = editor.ask(
        "textDocument/formatting",
        json!({"textDocument": {"uri": URI}, "options": {"tabSize": 4, "insertSpaces": true}}),
    );
    let after = text.replace("\u{1f600}", "");
    let laid_out = applied(&after, &edits.expect("an answer"));
    assert!(
        laid_out.contains("eff emit(\"\u{e4}\", a = x)"),
        "{laid_out}"
    );
}

#[test]
fn completions_are_suggested() {
    let (text, place) = cursor(&RACE.replace("index += 1", "motion.$0"));
    let mut editor = opened(&text);
    let list = editor
        .at("textDocument/completion", URI, place)
        .expect("an answer");
    let items = list["items"].as_array().expect("a list");
    let labels: Vec<&str> = items
        .iter()
        .filter_map(|item| item["label"].as_str())
        .collect();
    let expected = [
        "active",
        "along",
        "done",
        "drive_lane",
        "failed",
        "follow",
        "free",
        "reach_avoid",
        "reason",
        "stood",
        "stop",
        "target",
    ];
    assert_eq!(labels, expected);
    let item = |label: &str| {
        let index = labels.iter().position(|found| *found == label);
        &items[index.expect("it is suggested")]
    };
    assert_eq!(
        item("reach_avoid")["textEdit"]["newText"],
        "reach_avoid($0)"
    );
    assert_eq!(item("reach_avoid")["insertTextFormat"], 2);
    assert_eq!(item("stop")["textEdit"]["newText"], "stop()");
    assert_eq!(item("active")["detail"], "ReachAvoid.active: Bool");
}

#[test]
fn a_call_shows_its_parameters() {
    let (text, place) = cursor(&RACE.replace("index += 1", "motion.reach_avoid(position, $0)"));
    let mut editor = opened(&text);
    let help = editor
        .at("textDocument/signatureHelp", URI, place)
        .expect("an answer");
    let signature = &help["signatures"][0];
    let label = signature["label"].as_str().expect("a text");
    assert_eq!(
        label,
        "ReachAvoid.reach_avoid(target: Point, unsafe: Obstacles)"
    );
    assert_eq!(help["activeParameter"], 1);
    assert_eq!(signature["parameters"][1]["label"], json!([38, 55]));
    assert_eq!(&label[38..55], "unsafe: Obstacles");
}

#[test]
fn a_name_leads_to_its_declaration_and_its_other_uses() {
    let (text, place) = cursor(&RACE.replace("loc = pick\n", "loc = pi$0ck\n"));
    let mut editor = opened(&text);
    let found = editor
        .at("textDocument/definition", URI, place)
        .expect("an answer");
    assert_eq!(found["uri"], URI);
    assert_eq!(found["range"]["start"], json!({"line": 2, "character": 21}));
    let mut params = position(URI, place);
    for (with_declaration, count) in [(true, 3), (false, 2)] {
        params["context"] = json!({"includeDeclaration": with_declaration});
        let found = editor.ask("textDocument/references", params.clone());
        assert_eq!(
            found.expect("an answer").as_array().map(Vec::len),
            Some(count)
        );
    }
    let marked = editor.at("textDocument/documentHighlight", URI, place);
    assert_eq!(marked.expect("an answer").as_array().map(Vec::len), Some(3));
}

#[test]
fn built_in_libraries_can_be_read() {
    let (text, place) = cursor("program P\nside: Si$0de? = bumped\n");
    let mut editor = opened(&text);
    let found = editor
        .at("textDocument/definition", URI, place)
        .expect("an answer");
    assert_eq!(found["uri"], "starl-library:/prelude.starl");
    let prelude = editor
        .ask("starl/library", json!({"uri": found["uri"]}))
        .expect("an answer");
    let line = found["range"]["start"]["line"].as_u64().expect("a number") as usize;
    let line = prelude.as_str().and_then(|text| text.lines().nth(line));
    assert_eq!(line.map(|line| line.starts_with("enum Side")), Some(true));
}

#[test]
fn a_name_is_changed_everywhere_or_not_at_all() {
    let (text, place) = cursor(&RACE.replace("index < 3", "ind$0ex < 3"));
    let mut editor = opened(&text);
    let may = editor
        .at("textDocument/prepareRename", URI, place)
        .expect("it may");
    assert_eq!(may["placeholder"], "index");
    let mut params = position(URI, place);
    params["newName"] = json!("count");
    let renamed = editor
        .ask("textDocument/rename", params.clone())
        .expect("it is renamed");
    assert_eq!(
        applied(&text, &renamed["changes"][URI]),
        RACE.replace("index", "count")
    );
    params["newName"] = json!("loc");
    let refused = editor
        .ask("textDocument/rename", params)
        .expect_err("it is taken");
    assert_eq!(refused["code"], -32803);
    assert_eq!(
        message(&refused),
        "`index` cannot become `loc`: the name `loc` is taken (line 8)"
    );
    let (_, motion) = cursor(&RACE.replace("motion.active", "motion.act$0ive"));
    let refused = editor
        .at("textDocument/prepareRename", URI, motion)
        .expect_err("it may not");
    assert_eq!(message(&refused), "this is a name that every program has");
}

#[test]
fn a_text_is_formatted() {
    let untidy = RACE
        .replace("    pre", "  pre")
        .replace("    eff\n", "  eff\n")
        .replace(" = ", "=");
    let mut editor = opened(&untidy);
    let params =
        json!({"textDocument": {"uri": URI}, "options": {"tabSize": 4, "insertSpaces": true}});
    let edits = editor
        .ask("textDocument/formatting", params)
        .expect("an answer");
    let tidy = applied(&untidy, &edits);
    assert_eq!(tidy, starl_editor::format::format(&untidy));
    assert!(
        tidy.contains("    pre loc == init and not motion.active\n    eff\n"),
        "{tidy}"
    );
}

#[test]
fn the_outline_and_the_folds_follow_the_text() {
    let mut editor = opened(RACE);
    let params = json!({"textDocument": {"uri": URI}});
    let outline = editor
        .ask("textDocument/documentSymbol", params.clone())
        .expect("an answer");
    let names: Vec<&str> = (outline.as_array().expect("a list").iter())
        .filter_map(|entry| entry["name"].as_str())
        .collect();
    assert_eq!(
        names,
        [
            "Location", "vicinity", "motion", "loc", "index", "go", "back"
        ]
    );
    assert_eq!(outline[0]["children"][1]["name"], "pick");
    let folds = editor
        .ask("textDocument/foldingRange", params)
        .expect("an answer");
    assert_eq!(folds[0], json!({"startLine": 8, "endLine": 12}));
}

#[test]
fn every_word_has_its_colour() {
    let mut editor = opened("program P\nx: Int = 2 // \u{e4}\ny: Int = x\n");
    let params = json!({"textDocument": {"uri": URI}});
    let tokens = editor
        .ask("textDocument/semanticTokens/full", params)
        .expect("an answer");
    let data: Vec<u64> = (tokens["data"].as_array().expect("a list").iter())
        .filter_map(Value::as_u64)
        .collect();
    let words: Vec<&[u64]> = data.chunks(5).collect();
    // Line and column from the word before, length, kind, and what is said of it besides.
    assert_eq!(words[0], [0, 0, 7, 0, 0], "program");
    assert_eq!(words[2], [1, 0, 1, 11, 1], "x, declared");
    assert_eq!(words[3], [0, 3, 3, 8, 4], "Int, which every program has");
    assert_eq!(words[4], [0, 6, 1, 2, 0], "2");
    assert_eq!(words[5], [0, 2, 4, 1, 0], "the comment");
    assert_eq!(words.len(), 9);
    let params = json!({
        "textDocument": {"uri": URI},
        "range": {"start": {"line": 2, "character": 0}, "end": {"line": 2, "character": 1}},
    });
    let part = editor
        .ask("textDocument/semanticTokens/range", params)
        .expect("an answer");
    assert_eq!(part["data"], json!([2, 0, 1, 11, 1]));
}

#[test]
fn nothing_that_an_editor_sends_ends_the_server() {
    let mut editor = opened(RACE);
    editor.send_bytes(b"Content-Length: 7\r\n\r\n{\"id\": ");
    editor.send_bytes(b"nonsense\r\n\r\n");
    for message in [
        json!([1, 2, 3]),
        json!(null),
        json!({"jsonrpc": "2.0", "id": {"no": "id"}}),
        json!({"jsonrpc": "2.0", "id": 900, "result": null}),
        json!({"jsonrpc": "2.0", "method": "textDocument/didChange", "params": 7}),
        json!({"jsonrpc": "2.0", "method": "textDocument/didOpen"}),
        json!({"jsonrpc": "2.0", "method": "$/cancelRequest", "params": {"id": 1}}),
        json!({"jsonrpc": "2.0", "method": "no/such/thing", "params": {}}),
    ] {
        editor.send(&message);
    }
    editor.change(URI, 2, [7, 4_000_000_000, 9, 1], "\u{1f600}");
    editor.change(URI, 3, [900, 0, 3, 0], "(");
    editor.change("untitled:Unknown", 1, [0, 0, 0, 0], "x");
    let unknown = editor
        .ask("no/such/request", json!({}))
        .expect_err("there is none");
    assert_eq!(unknown["code"], -32601);
    let shapeless = editor.ask("textDocument/hover", json!({"position": "here"}));
    assert_eq!(shapeless.expect_err("it has no shape")["code"], -32602);
    assert!(
        editor
            .at("textDocument/hover", "untitled:Unknown", (0, 0))
            .is_err()
    );
    assert!(editor.ask("textDocument/hover", Value::Null).is_err());
    let params = json!({"textDocument": {"uri": URI}});
    assert!(
        editor.ask("textDocument/documentSymbol", params).is_ok(),
        "it still serves"
    );
    assert_eq!(editor.ask("shutdown", Value::Null), Ok(Value::Null));
    editor.tell("exit", Value::Null);
    assert_eq!(editor.wait().code(), Some(0));
}
