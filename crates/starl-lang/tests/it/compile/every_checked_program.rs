//! Every program in the tests that the checker accepts compiles and loads, or has a diagnostic.
#![allow(clippy::disallowed_methods, reason = "the cases are files")]

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use starl_lang::check::{STANDARD, check};
use starl_lang::compile::compile;
use starl_lang::machine::{Import, Program, assemble, disassemble};

use crate::common::{EVERY_FORM, LISTINGS};

/// Compiles a program that the checker takes; whether it does.
fn hold(name: &str, source: &str, libraries: &BTreeMap<String, String>) -> bool {
    let checked = check(source, &|name: &str| libraries.get(name).cloned());
    let compiled = compile(&checked);
    if checked.has_errors() {
        assert!(compiled.is_err(), "{name} has errors and compiles");
        return false;
    }
    match compiled {
        Ok(bytecode) => {
            let text = disassemble(&bytecode);
            let again = assemble(&text).unwrap_or_else(|error| panic!("{name}: {error}\n{text}"));
            assert_eq!(again, bytecode, "{name}");
            let loaded = Program::load(bytecode, &|_: &Import| Some(0));
            loaded.unwrap_or_else(|error| panic!("{name}: {error}\n{source}\n{text}"));
        }
        Err(problems) => {
            let codes = problems.iter().map(|problem| problem.code.number());
            assert!(codes.clone().all(|code| code.starts_with("E03")), "{name}");
            assert!(codes.count() > 0, "{name}");
        }
    }
    true
}

#[test]
fn of_the_checkers_cases() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/diagnostics");
    let mut count = 0;
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let text = fs::read_to_string(&path).unwrap();
        let mut libraries = BTreeMap::new();
        let mut heading = String::new();
        let mut lines = text.lines();
        while let Some(line) = lines.next() {
            if let Some(name) = line.strip_prefix("## ") {
                heading = name.into();
                libraries.clear();
            }
            let Some(kind) = line.strip_prefix("```") else {
                continue;
            };
            let inside = lines.by_ref().take_while(|line| *line != "```");
            let block: String = inside.map(|line| format!("{line}\n")).collect();
            if let Some(name) = kind.strip_prefix("starl ") {
                count += usize::from(hold(&heading, &block, &libraries));
                libraries.insert(name.into(), block);
            } else if kind == "starl" {
                count += usize::from(hold(&heading, &block, &libraries));
            }
        }
    }
    assert!(count > 50, "only {count} programs have no errors");
}

#[test]
fn of_the_listings() {
    for (name, source) in LISTINGS.iter().copied().chain([("every_form", EVERY_FORM)]) {
        hold(name, source, &BTreeMap::new());
    }
}

#[test]
fn of_the_standard_library() {
    for (name, source) in STANDARD {
        assert!(hold(name, source, &BTreeMap::new()), "{name}");
    }
}

#[test]
fn without_unsupported_parts() {
    // Every form of the language but `mux.failed` as an event, which there is none of.
    let geometry = "library geometry\nrecord Line {a: Point, b: Point}\n";
    let libraries = BTreeMap::from([("geometry".to_string(), geometry.to_string())]);
    let without: String = EVERY_FORM
        .lines()
        .filter(|line| !line.contains("mux"))
        .map(|line| format!("{line}\n"))
        .collect();
    hold("every_form", &without, &libraries);
}

#[test]
fn deep_and_long_programs_end_in_a_diagnostic_or_in_code() {
    let function = |body: &str| {
        format!("library L\nrecord R {{x: Int}}\nfunction f(a: Int, r: R?) -> Int\n{body}\n")
    };
    for (start, link) in [("a", " + 1"), ("1", " + a"), ("a", " - (a)")] {
        let text = format!("    return {start}{}", link.repeat(180));
        assert!(hold(link, &function(&text), &BTreeMap::new()), "{link}");
    }
    let nestings = [
        ("-(", ")"),
        ("(a + ", ")"),
        ("max(1, ", ")"),
        ("if a > 1 then 1 else (", ")"),
        ("f(", ", r)"),
        ("[", "].sum()"),
        ("(if not (a == 1 and a < ", ") then 1 else 2)"),
    ];
    for (open, close) in nestings {
        // Those that are nested more deeply than the checker allows have errors.
        for depth in [20, 40, 60, 80, 120, 195] {
            let text = format!("    return {}a{}", open.repeat(depth), close.repeat(depth));
            let is_right = hold(open, &function(&text), &BTreeMap::new());
            assert!(is_right || depth > 20, "{open}");
        }
    }
    let branches = "    elif a > 1\n        return 1\n".repeat(3000);
    let text = format!("    if a > 2\n        return 2\n{branches}    return 3");
    assert!(hold("elif", &function(&text), &BTreeMap::new()));
    for depth in [40, 90, 190] {
        let nested: String = (0..depth)
            .map(|depth| format!("{}if a > 1\n", "    ".repeat(depth + 1)))
            .collect();
        let text = format!("{nested}{}return 1\n    return 3", "    ".repeat(depth + 1));
        assert!(hold("if", &function(&text), &BTreeMap::new()) || depth > 90);
    }
}
