//! Each code has a page in `docs/errors/`, and the page is true: its wrong example gets the message that the page
//! shows, and its fixed example gets none.
//!
//! A page is a title, prose, the wrong example in a block of `starl`, the message in a block of `text`, and the fixed
//! example in another block of `starl`. A library that an example imports precedes it in a block `starl name`. `BLESS=1
//! cargo test -p starl-lang --test it errors_pages` rewrites the messages and the tables of the index.
#![allow(clippy::disallowed_methods, reason = "a test reads its pages")]

use std::fs;
use std::path::PathBuf;

use crate::page_files::PageFiles;
use starl_lang::check::{Checked, CheckedFile, check};
use starl_lang::compile::compile;
use starl_lang::diagnostic::{Code, Colour, render};

/// A part of a page: a line outside of blocks, or a block with what stands after its fence.
enum Part {
    Line(String),
    Block(String, String),
}

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../docs/errors")
}

fn parts(page: &str) -> Vec<Part> {
    let mut parts = Vec::new();
    let mut lines = page.lines();
    while let Some(line) = lines.next() {
        parts.push(match line.strip_prefix("```") {
            Some(kind) => {
                let inside = lines.by_ref().take_while(|line| *line != "```");
                let block = inside.map(|line| format!("{line}\n")).collect();
                Part::Block(kind.into(), block)
            }
            None => Part::Line(line.into()),
        });
    }
    parts
}

fn written(parts: &[Part]) -> String {
    let text = |part: &Part| match part {
        Part::Line(line) => format!("{line}\n"),
        Part::Block(kind, block) => format!("```{kind}\n{block}```\n"),
    };
    parts.iter().map(text).collect()
}

/// An example as it is checked. That of a file which is too long continues where the page says so.
fn example(block: &str) -> String {
    let goes_on = "// and so on, for 16 MiB\n";
    if block.ends_with(goes_on) {
        block.to_string() + &goes_on.repeat((16 << 20) / goes_on.len() + 1)
    } else {
        block.into()
    }
}

/// The problems of a program: the checker's for each file, or the compiler's if the checker finds none.
struct Found {
    codes: Vec<Code>,
    said: String,
}

fn found(program: &str, libraries: &PageFiles) -> Found {
    let mut checked = check(program, libraries);
    if checked.files.iter().all(|file| file.diagnostics.is_empty()) {
        let problems = compile(&checked).err().unwrap_or_default();
        checked.files[0].diagnostics = problems;
    }
    let of_file = |file: &CheckedFile| {
        let name = format!("{}.starl", file.name.to_lowercase());
        render(&name, &file.source, &file.diagnostics, Colour::Off)
    };
    let said: String = checked.files.iter().map(of_file).collect();
    let lines = said.trim_end().lines().map(str::trim_end);
    let all = checked.files.iter().flat_map(|file| &file.diagnostics);
    Found {
        codes: all.map(|diagnostic| diagnostic.code).collect(),
        said: lines.map(|line| format!("{line}\n")).collect(),
    }
}

/// Reads a page and holds it to what it says; gives the page with the message that the wrong example
/// gets now.
fn hold(code: Code, page: &str) -> Result<String, String> {
    let mut parts = parts(page);
    let title = format!("# {code}: {}", code.title().trim_end_matches('.'));
    if !matches!(parts.first(), Some(Part::Line(line)) if *line == title) {
        return Err(format!("the title is not {title:?}"));
    }
    let mut libraries = PageFiles::default();
    let mut wrong = None;
    let mut fixed = false;
    for part in &mut parts {
        let Part::Block(kind, block) = part else {
            continue;
        };
        if let Some(name) = kind.strip_prefix("starl ") {
            libraries.0.insert(name.into(), block.clone());
        } else if kind == "text" {
            *block = wrong.take().ok_or("a message stands before its example")?;
        } else if kind != "starl" {
            return Err(format!("there is a block of {kind:?}"));
        } else if wrong.is_none() && !fixed {
            let found = found(&example(block), &libraries);
            let own = |other: &Code| *other == code || *other == Code::BrokenLibrary;
            let only_own = code == Code::BrokenLibrary || found.codes.iter().all(own);
            if !found.codes.contains(&code) || !only_own {
                return Err(format!("the wrong example gets\n{}", found.said));
            }
            wrong = Some(found.said);
            fixed = true;
        } else {
            let found = found(block, &libraries);
            if !found.codes.is_empty() {
                return Err(format!("the fixed example gets\n{}", found.said));
            }
            fixed = false;
        }
    }
    if wrong.is_some() || fixed {
        return Err("a page has a wrong example, its message and a fixed example".into());
    }
    Ok(written(&parts))
}

#[test]
fn every_page_is_true() {
    let bless = std::env::var_os("BLESS").is_some();
    let mut problems = String::new();
    for code in Code::ALL {
        let path = folder().join(format!("{code}.md"));
        let Ok(page) = fs::read_to_string(&path) else {
            problems += &format!("{code}: there is no page\n");
            continue;
        };
        match hold(*code, &page) {
            Err(problem) => problems += &format!("{code}: {problem}\n"),
            Ok(now) if now == page => {}
            Ok(now) if bless => fs::write(&path, now).expect("a page that can be written"),
            Ok(now) => problems += &format!("{code}: BLESS=1 writes it again:\n{now}\n"),
        }
    }
    assert!(problems.is_empty(), "\n{problems}");
}

#[test]
fn the_fix_of_a_page_solves_one_problem() {
    for code in Code::ALL.iter().filter(|code| **code != Code::TooLong) {
        let path = folder().join(format!("{code}.md"));
        let mut libraries = PageFiles::default();
        let parts = parts(&fs::read_to_string(path).expect("a page"));
        let blocks = parts.iter().filter_map(|part| match part {
            Part::Block(kind, block) => Some((kind, block)),
            Part::Line(_) => None,
        });
        for (kind, block) in blocks.take_while(|(kind, _)| *kind != "text") {
            if let Some(name) = kind.strip_prefix("starl ") {
                libraries.0.insert(name.into(), block.clone());
                continue;
            }
            let before = check(block, &libraries);
            for fix in before
                .diagnostics()
                .iter()
                .filter_map(|one| one.fix.as_ref())
            {
                let text = fix.apply(block);
                let after = check(&text, &libraries);
                let count = |checked: &Checked| {
                    let all = checked.diagnostics().iter();
                    all.filter(|one| one.code == *code).count()
                };
                assert!(
                    count(&after) < count(&before),
                    "{code}: {}\n{text}",
                    fix.message
                );
            }
        }
    }
}

#[test]
fn every_page_has_a_code() {
    let entries = fs::read_dir(folder()).expect("the folder of pages");
    for entry in entries {
        let name = entry.expect("a page").file_name();
        let name = name.to_string_lossy();
        let is_code = |code: &Code| name == format!("{code}.md");
        assert!(
            name == "README.md" || Code::ALL.iter().any(is_code),
            "{name} is the page of no code"
        );
    }
}

#[test]
fn the_index_lists_every_page() {
    let path = folder().join("README.md");
    let page = fs::read_to_string(&path).expect("the index");
    let is_row = |line: &&str| line.starts_with("| [");
    let mut now = String::new();
    for line in page.lines().filter(|line| !is_row(line)) {
        now += &format!("{line}\n");
        // The table of a heading such as `## E01: ...` begins here.
        if line.starts_with("| ---") {
            let heading = now.rsplit("## ").next().unwrap_or_default();
            let prefix = heading.get(..3).unwrap_or_default().to_string();
            for code in Code::ALL
                .iter()
                .filter(|code| code.number().starts_with(&prefix))
            {
                let title = code.title().trim_end_matches('.');
                now += &format!("| [{code}]({code}.md) | {title} |\n");
            }
        }
    }
    if std::env::var_os("BLESS").is_some() {
        fs::write(&path, &now).expect("an index that can be written");
    }
    assert_eq!(now.lines().filter(is_row).count(), Code::ALL.len());
    assert_eq!(now, fs::read_to_string(&path).expect("the index"));
}
