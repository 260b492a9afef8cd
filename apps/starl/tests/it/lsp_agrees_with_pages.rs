//! A page and an editor show the same problems at the same places.

use crate::lsp_support::Editor;
use serde_json::Value;
use starl_catalog::programs::Registry;
use starl_catalog::session::{Diagnostic, Files, check};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// A problem: its place in lines and UTF-16 units from 0, its severity, its number, and everything that it says.
type Problem = ((u64, u64), (u64, u64), u64, String, String);

/// Every program in the pages of errors: those with the error, and those without.
fn programs() -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/errors");
    let pages = fs::read_dir(folder).expect("the pages are there");
    let mut programs = Vec::new();
    for page in pages {
        let text = fs::read_to_string(page.expect("a page").path()).expect("a text");
        let parts = text.split("```starl\n").skip(1);
        programs.extend(parts.map(|part| {
            let end = part.find("```").expect("the program ends");
            part[..end].to_string()
        }));
    }
    programs
}

fn shown_by_server(problem: &Value) -> Problem {
    let number = |value: &Value| value.as_u64().expect("a number");
    let text = |value: &Value| value.as_str().expect("a text").to_string();
    let place = |place: &Value| (number(&place["line"]), number(&place["character"]));
    (
        place(&problem["range"]["start"]),
        place(&problem["range"]["end"]),
        number(&problem["severity"]),
        text(&problem["code"]),
        text(&problem["message"]),
    )
}

fn shown_by_page(text: &str, found: &Diagnostic) -> Problem {
    let place = |line: u32, column: u32| {
        let own = text.split('\n').nth(line as usize - 1).unwrap_or_default();
        let before = own.chars().take(column as usize - 1);
        let units: usize = before.map(char::len_utf16).sum();
        (u64::from(line - 1), units as u64)
    };
    let mut message = vec![found.message.clone()];
    message.extend(found.notes.iter().cloned());
    (
        place(found.extent.line, found.extent.column),
        place(found.extent.end_line, found.extent.end_column),
        if found.severity == "error" { 1 } else { 2 },
        found
            .code
            .expect("problems of programs have numbers")
            .to_string(),
        message.join("\n"),
    )
}

#[test]
fn check_and_the_language_server_report_the_same() {
    let mut editor = Editor::ready();
    let mut codes = BTreeSet::new();
    for (number, text) in programs().iter().enumerate() {
        let uri = format!("untitled:Program-{number}");
        editor.open(&uri, text);
        let problems = editor.problems(&uri, 1);
        let mut told: Vec<Problem> = problems.iter().map(shown_by_server).collect();
        let files = Files::from_iter([("program.starl".to_string(), text.clone().into_bytes())]);
        let found = check(&files, &Registry::default());
        let mut found: Vec<Problem> = found
            .iter()
            .map(|found| shown_by_page(text, found))
            .collect();
        told.sort();
        // `check` says once what two places of the checker say alike.
        told.dedup();
        found.sort();
        assert_eq!(told, found, "{text}");
        codes.extend(found.into_iter().map(|problem| problem.3));
    }
    // Among them is what only the compiler finds.
    assert!(codes.contains("E0303"), "{codes:?}");
    assert!(codes.len() > 50, "{codes:?}");
}
