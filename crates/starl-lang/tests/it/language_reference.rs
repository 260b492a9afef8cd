//! The language reference is true: its programs have no errors, and its tables of built-in names are those of the
//! checker. `BLESS=1 cargo test -p starl-lang --test language_reference` rewrites the tables.
#![allow(clippy::disallowed_methods, reason = "a test reads its page")]

use std::fs;
use std::path::PathBuf;

use crate::page_files::PageFiles;
use starl_lang::check::{BUILTINS, METHODS, PRELUDE, PRIMITIVES, Purity, check};
use starl_lang::diagnostic::{Colour, render};

fn path() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../docs/reference/language.md")
}

fn page() -> String {
    fs::read_to_string(path()).expect("the page")
}

fn place(purity: Purity) -> &'static str {
    match purity {
        Purity::Pure => "anywhere",
        Purity::Query => "not in functions",
        Purity::Effect => "effects",
        Purity::Property => "properties",
    }
}

fn row(cells: [&str; 3]) -> String {
    format!("| {} | {} | {} |\n", cells[0], cells[1], cells[2])
}

fn code(text: &str) -> String {
    format!("`{text}`")
}

fn builtins() -> String {
    let rows = BUILTINS.iter().map(|builtin| {
        let (name, place) = (code(builtin.text()), place(builtin.purity()));
        row([&name, place, builtin.documentation()])
    });
    "| name | where | what it is |\n| --- | --- | --- |\n".to_string() + &rows.collect::<String>()
}

fn methods() -> String {
    let rows = METHODS.iter().map(|method| {
        let changes = if method.changes() { "yes" } else { "" };
        row([&code(method.text()), changes, method.documentation()])
    });
    let head = "| method | changes it | what it does |\n| --- | --- | --- |\n";
    head.to_string() + &rows.collect::<String>()
}

fn primitives() -> String {
    let mut table =
        "| primitive, and what it has | where | what it does |\n| --- | --- | --- |\n".to_string();
    for primitive in PRIMITIVES {
        let about = format!("**{}**", primitive.documentation);
        table += &row([&code(primitive.constructor), "", &about]);
        for member in primitive.members {
            let place = place(member.purity);
            table += &row([
                &code(&format!(".{}", member.text)),
                place,
                member.documentation,
            ]);
        }
        for event in primitive.events {
            let name = code(&format!("on .{}", event.text));
            table += &row([&name, "", event.documentation]);
        }
    }
    table
}

fn prelude() -> String {
    // The header says nothing to a program.
    let declarations = PRELUDE
        .split_once("library prelude\n")
        .map_or(PRELUDE, |parts| parts.1);
    let mut shown = String::new();
    for part in declarations.trim().split("\n\n") {
        // Of a function with a block only what it takes and gives.
        let lines: Vec<&str> = part.lines().collect();
        let end = lines.iter().position(|line| line.starts_with("function "));
        let end = end.map_or(lines.len(), |line| line + 1);
        shown += &format!("{}\n\n", lines[..end].join("\n"));
    }
    format!("```text\n{}\n```\n", shown.trim_end())
}

/// The page with each generated part replaced: from its mark to the next line that does not belong to it.
fn with_tables(page: &str) -> String {
    let parts: [(&str, String); 4] = [
        ("<!-- built-in names and functions -->", builtins()),
        ("<!-- the prelude -->", prelude()),
        ("<!-- methods -->", methods()),
        ("<!-- primitives -->", primitives()),
    ];
    let mut written = page.to_string();
    for (mark, part) in parts {
        let start = written.find(mark).expect("the mark of a part") + mark.len() + 1;
        let rest = &written[start..];
        let length = if part.starts_with("```") {
            rest.strip_prefix("```text\n")
                .and_then(|inside| inside.find("\n```\n"))
                .map_or(0, |end| "```text\n".len() + end + "\n```\n".len())
        } else {
            let rows = rest.lines().take_while(|line| line.starts_with('|'));
            rows.map(|line| line.len() + 1).sum()
        };
        written.replace_range(start..start + length, &part);
    }
    written
}

#[test]
fn the_tables_are_those_of_the_checker() {
    let now = with_tables(&page());
    if std::env::var_os("BLESS").is_some() {
        fs::write(path(), &now).expect("a page that can be written");
    }
    assert!(now == page(), "BLESS=1 writes the tables anew:\n{now}");
}

#[test]
fn the_programs_have_nothing_wrong_with_them() {
    let page = page();
    let mut files = PageFiles::default();
    let mut count = 0;
    for part in page.split("\n```starl").skip(1) {
        let (name, rest) = part.split_once('\n').expect("a block");
        let (source, _) = rest.split_once("\n```").expect("the end of a block");
        let source = format!("{source}\n");
        if let Some(name) = name.strip_prefix(' ') {
            files.0.insert(name.into(), source);
            continue;
        }
        let checked = check(&source, &files);
        for file in &checked.files {
            let said = render(&file.name, &file.source, &file.diagnostics, Colour::Off);
            assert!(said.is_empty(), "{said}");
        }
        count += 1;
    }
    assert!(count >= 5, "there are only {count} programs");
}
