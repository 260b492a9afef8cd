//! Every rule of the checker has a case in `diagnostics/check_*.md`: a program and its messages.
//!
//! A case is a heading, the program in a `starl` block, and the messages in a `text` block, which is empty or missing
//! if there are none. Libraries that it imports precede it, in blocks `starl name`. `BLESS=1` rewrites the messages.
#![allow(clippy::disallowed_methods, reason = "the cases are files")]

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;

use starl_lang::check::{Checked, Libraries, check};
use starl_lang::diagnostic::{Code, Colour, render};

struct Case {
    heading: String,
    libraries: BTreeMap<String, String>,
    program: String,
    expected: String,
}

/// The libraries of a case.
struct Beside<'a>(&'a BTreeMap<String, String>);

impl Libraries for Beside<'_> {
    fn source(&self, name: &str) -> Option<String> {
        self.0.get(name).cloned()
    }

    fn names(&self) -> Vec<String> {
        self.0.keys().cloned().collect()
    }
}

/// The blocks of a file, each with its heading, what stands after its fence, and its text.
fn cases(text: &str) -> Vec<Case> {
    let mut cases: Vec<Case> = Vec::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        if let Some(heading) = line.strip_prefix("## ") {
            cases.push(Case {
                heading: heading.into(),
                libraries: BTreeMap::new(),
                program: String::new(),
                expected: String::new(),
            });
        } else if let Some(kind) = line.strip_prefix("```") {
            let inside = lines.by_ref().take_while(|line| *line != "```");
            let block: String = inside.map(|line| format!("{line}\n")).collect();
            let case = cases.last_mut().expect("a block stands under a heading");
            match kind.split_once(' ') {
                None if kind == "starl" => case.program = block,
                Some(("starl", name)) => drop(case.libraries.insert(name.into(), block)),
                _ => case.expected = block,
            }
        }
    }
    cases
}

fn said(case: &Case) -> String {
    let checked = check(&case.program, &Beside(&case.libraries));
    let mut said = String::new();
    for file in &checked.files {
        let name = format!("{}.starl", file.name.to_lowercase());
        said += &render(&name, &file.source, &file.diagnostics, Colour::Off);
    }
    let said: Vec<&str> = said.trim().lines().map(str::trim_end).collect();
    said.join("\n")
}

fn files() -> Vec<PathBuf> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/diagnostics");
    let entries = fs::read_dir(folder).expect("the folder is there");
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| {
        let name = path.file_name().unwrap().to_str().unwrap();
        name.starts_with("check_") && name.ends_with(".md")
    });
    files.sort();
    files
}

#[test]
fn each_case_has_its_messages() {
    let write = std::env::var_os("BLESS").is_some();
    let mut wrong = String::new();
    for path in files() {
        let text = fs::read_to_string(&path).unwrap();
        let mut rewritten = text.split("\n## ").next().unwrap().trim_end().to_string();
        for case in cases(&text) {
            let said = said(&case);
            if said != case.expected.trim() {
                let name = path.file_name().unwrap().display();
                writeln!(wrong, "{name}: {}\n{said}\n", case.heading).unwrap();
            }
            write!(rewritten, "\n\n## {}\n", case.heading).unwrap();
            for (name, library) in &case.libraries {
                write!(rewritten, "\n```starl {name}\n{library}```\n").unwrap();
            }
            write!(rewritten, "\n```starl\n{}```\n", case.program).unwrap();
            if !said.is_empty() {
                write!(rewritten, "\n```text\n{said}\n```\n").unwrap();
            }
            rewritten.truncate(rewritten.trim_end().len());
        }
        if write {
            fs::write(&path, rewritten + "\n").unwrap();
        }
    }
    assert!(write || wrong.is_empty(), "{wrong}");
}

#[test]
fn each_code_of_the_checker_has_a_case() {
    let texts: String = (files().iter())
        .map(|path| fs::read_to_string(path).unwrap())
        .collect();
    let missing: Vec<&str> = (Code::ALL.iter())
        .map(|code| code.number())
        .filter(|number| number[1..].starts_with("02"))
        .filter(|number| !texts.contains(&format!("[{number}]")))
        .collect();
    assert!(missing.is_empty(), "{missing:?}");
}

#[test]
fn suggested_fixes_solve_the_problem() {
    for path in files() {
        for case in cases(&fs::read_to_string(&path).unwrap()) {
            let libraries = Beside(&case.libraries);
            let checked = check(&case.program, &libraries);
            for diagnostic in checked.diagnostics() {
                let Some(fix) = &diagnostic.fix else {
                    continue;
                };
                let same = |checked: &Checked| {
                    let all = checked.diagnostics().iter();
                    all.filter(|other| {
                        (other.code, &other.message) == (diagnostic.code, &diagnostic.message)
                    })
                    .count()
                };
                let fixed = check(&fix.apply(&case.program), &libraries);
                let remains = same(&fixed) >= same(&checked);
                assert!(!remains, "{}: {}", case.heading, fix.message);
            }
        }
    }
}
